#pragma once

#include <vibrocontact/contact/laws/law_parameter.h>

#include <array>
#include <functional>

namespace vibrocontact
{
  /// Friction: the tangential force on body 1 opposes the slip s and is bounded by the disc of radius mu N,
  ///
  ///   T = Proj_disc(mu(|s|) N) (T - rho s)   for any rho > 0                   (doc/theory.md, "Laws")
  ///
  /// Stick: s = 0, |T| <= mu_rest N. Slip: T = -mu(|s|) N s / |s|. disc(0) = {0}. A law is its coefficient over the slip
  /// speed, which may jump at zero slip.
  class FrictionLaw
  {
  public:
    struct Coefficient
    {
      /// mu [-], dmu/d|s| [s/m]
      double value, slope;
    };

    virtual ~FrictionLaw() = default;
    virtual LawDescription description() const = 0;
    /// of sliding at a speed >= 0 [m/s]; at zero its limit
    virtual Coefficient coefficient(double speed) const = 0;
    /// by how much a point at rest holds more than slow sliding carries [-], >= 0
    virtual double jump() const { return 0; }
    double at_rest() const { return coefficient(0).value + jump(); }
    virtual bool depends_on_speed() const { return true; }

    /// Of a point that sticks or slides; sticking points may move by what the slip speed of the law does not see.
    double coefficient(const double speed, const bool sticks) const
    {
      return coefficient(speed).value + (sticks ? jump() : 0.);
    }
  };

  using Vector2 = std::array<double, 2>;

  struct DiscProjection
  {
    Vector2 force;
    /// derivative with respect to the trial force T - rho s, row by row
    std::array<Vector2, 2> by_trial;
    /// derivative with respect to the radius mu N
    Vector2 by_radius;
    bool sticks;
  };

  /// Projection of a trial force [N] onto the disc of the given radius [N] >= 0.
  DiscProjection project_on_disc(const Vector2 &trial, double radius);

  /// One row of the table of friction laws.
  struct FrictionLawEntry
  {
    /// in the parameter file, and a sentence
    std::string name, help;
    std::vector<LawParameter> parameters;
    /// from the numbers of the parameters; @throws InputError
    std::function<std::shared_ptr<const FrictionLaw>(const std::vector<double> &)> make;
  };

  /// Contact/Friction coefficient: the first number of laws that are scaled by it.
  LawParameter friction_coefficient();
  /// no coefficient is larger [-]
  constexpr double most_friction = 10;
} // namespace vibrocontact

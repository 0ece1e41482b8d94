#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A contact law for the normal force N >= 0 (compression) and the gap g >= 0 (open), written as a
  /// projection
  ///
  ///   N = P(N, g; rho)   for any rho > 0                                        (Lai et al. 2018, Eq. 3)
  ///
  /// so that every solver sees one equation per point, whatever the law.
  class NormalLaw
  {
  public:
    /// Value of P and its derivatives with respect to the force and to the gap.
    struct Projection
    {
      /// [N]
      double force;
      /// dP/dN [-], dP/dg [N/m]; both zero where the point is open and stays so to first order
      double by_force, by_gap;
    };

    /// What create_normal_law() needs to make the law again.
    struct Description
    {
      std::string name;
      double amplitude, exponent;
    };

    virtual ~NormalLaw() = default;
    virtual Description description() const = 0;
    virtual Projection project(double force, double gap, double rho) const = 0;
    /// energy that the law itself stores at a gap [J]
    virtual double potential(double gap) const = 0;
  };

  /// Signorini: g >= 0, N >= 0, g N = 0  <=>  N = max(N - rho g, 0).
  ///
  /// Graph: the corner of the two half-axes. It has no stiffness of its own.
  class SignoriniLaw : public NormalLaw
  {
  public:
    Description description() const override { return {"signorini", 0., 0.}; }
    Projection project(double force, double gap, double rho) const override;
    double potential(double) const override { return 0; }
  };

  /// A law whose force is a function of the gap: a spring behind the surface, open gaps without force.
  class SpringLaw : public NormalLaw
  {
  public:
    /// f(g) [N], its stiffness -df/dg [N/m] zero where it is open
    virtual double force(double gap) const = 0;
    virtual double stiffness(double gap) const = 0;
  };

  /// One-sided linear spring N = k max(-g, 0).
  class LinearSpringLaw : public SpringLaw
  {
  public:
    /// @param stiffness k [N/m], positive; @throws InputError
    explicit LinearSpringLaw(double stiffness);
    Description description() const override { return {"linear spring", k, 1.}; }
    Projection project(double force, double gap, double rho) const override;
    double force(double gap) const override { return gap < 0 ? -k * gap : 0.; }
    double stiffness(double gap) const override { return gap < 0 ? k : 0.; }
    double potential(double gap) const override { return gap < 0 ? 0.5 * k * gap * gap : 0.; }

  private:
    double k;
  };

  /// Exponential penalty of the axial-bar paper: N = f(g) = a (exp(alpha d) - 1), d = max(-g, 0)  (Jones &
  /// Legrand 2014).
  ///
  /// Graph: zero for open gaps, then a curve that leaves the origin with slope a * alpha. Beyond alpha d = 2
  /// it is continued linearly, so that a wild iterate cannot overflow. It tends to Signorini as a grows, the
  /// penetration being N / (a alpha) to first order.
  ///
  /// Its projection is the resolvent: the point (N', g') of the graph with N' - rho g' = N - rho g. A plain
  /// N' = f(g) would satisfy the same law, but a fixed point on it diverges once the law is stiffer than the
  /// bodies. Tangent: dP/dN = f' / (f' + rho), which tends to Signorini's one.
  class ExponentialPenaltyLaw : public SpringLaw
  {
  public:
    /// @param amplitude a [N], @param exponent alpha [1/m]; both positive
    ExponentialPenaltyLaw(double amplitude, double exponent);
    Description description() const override { return {"exponential penalty", amplitude, exponent}; }
    Projection project(double force, double gap, double rho) const override;
    double force(double gap) const override;
    double stiffness(double gap) const override;
    /// energy stored at the gap g, a ((exp(alpha d) - 1) / alpha - d) up to the linear continuation [J]
    double potential(double gap) const override;

  private:
    double amplitude, exponent;
  };

  /// Coulomb friction: the tangential force on body 1 opposes the slip s and is bounded by the disc of radius
  /// mu N,
  ///
  ///   T = Proj_disc(mu N) (T - rho s)   for any rho > 0                         (doc/theory.md, "Laws")
  ///
  /// Stick: s = 0, |T| <= mu N. Slip: T = -mu N s / |s|. disc(0) = {0}.
  struct CoulombLaw
  {
    using Vector2 = std::array<double, 2>;

    struct Projection
    {
      Vector2 force;
      /// derivative with respect to the trial force T - rho s, row by row
      std::array<Vector2, 2> by_trial;
      /// derivative with respect to the radius mu N
      Vector2 by_radius;
      bool sticks;
    };

    /// Projection of a trial force [N] onto the disc of the given radius [N] >= 0.
    static Projection project(const Vector2 &trial, double radius);
  };

  /// One entry of the table of normal laws: the name in the parameter file, a sentence of help.
  struct NormalLawEntry
  {
    std::string name, help;
  };

  /// All normal laws by name, for the parameter pattern and for tests that create every member.
  const std::vector<NormalLawEntry> &normal_laws();

  /// Creates a law by its name; amplitude [N] and exponent [1/m] are those of the exponential penalty, the stiffness of the
  /// linear spring is their product, the penalty's at touch.
  /// @throws InputError naming the known laws
  std::shared_ptr<const NormalLaw> create_normal_law(const std::string &name, double amplitude,
                                                     double exponent);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/numerics/piecewise_polynomial.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Road`: what body 1 rolls over, and how fast.
  struct RoadParameters
  {
    /// flat, expression, table or ISO 8608
    std::string profile = "flat";
    /// height [m] as an expression of the position s along the road [m]
    std::string expression;
    /// CSV: position_m, height_m
    std::string table;
    /// A to H, and the wavenumbers of its waves [1/m]; the defaults are the deterministic road of
    /// doc/theory.md, corrections to the tyre paper
    std::string iso_class = "A";
    double first_wavenumber = 2, last_wavenumber = 50, wavenumber_step = 0.1;
    unsigned int seed = 20110525;

    /// [m/s], or as an expression of the time t, or a CSV: time_s, speed_m_s
    double speed = 0;
    std::string speed_expression, speed_table;
    /// of the contact points over the road, forward; with friction only [m/s]
    double sliding_speed = 0;
    /// how far the road is pressed towards the body [m], reached in the loading time [s]
    double indentation = 0, loading_time = 0;

    void declare_parameters(dealii::ParameterHandler &prm);
    void check() const;
  };

  /// Height of the road under each contact point in time:
  ///
  ///   u_r,i(t) = r(t) [indentation + z(s(t) + x_i)] - shape_i,      s(t) = int_0^t V dt
  ///   r(t) = (1 - cos(pi t / T)) / 2 up to the loading time T, then 1 (T = 0: 1)
  ///
  /// x_i: place of the point [m], forward; shape_i: height of body 1's surface there when it is undeformed [m].
  /// The contact opens where the body's displacement u_i exceeds u_r,i.
  ///
  /// Profiles z: an expression; a table, by its natural cubic spline, since a rigid contact would feel kinks as
  /// impacts; ISO 8608 (2016) classes A to H, Phi(n) = 4^(1 + number) 4e-6 m^3 (n / 0.1 1/m)^-2 with A = 0: the sum of
  /// waves a_k cos(2 pi n_k x + phi_k), a_k = sqrt(2 Phi(n_k) dn), phi_k = 2 pi s_k / 2^32 by the generator
  /// s_k = (1664525 s_(k-1) + 1013904223) mod 2^32, s_(-1) = seed, the same on every machine.
  class Road
  {
  public:
    /// @param places, shapes [m], one per contact point; @param end_time the road has to reach [s]
    /// @throws InputError if it does not, or an entry cannot be read. Collective.
    Road(const RoadParameters &parameters, const std::vector<double> &places,
         const std::vector<double> &shapes, double end_time);

    /// u_r with its two derivatives in time [m, m/s, m/s^2]
    PiecewisePolynomial::Value at(unsigned int point, double t) const;
    double height(unsigned int point, double t) const;
    /// of one point at n ascending times [m]
    void heights(unsigned int point, const double *t, unsigned int n, double *result) const;
    /// All points at once [m]; n_points.
    void heights(double t, double *result) const;
    unsigned int n_points() const { return places.size(); }
    /// of the contact points over the road [m/s]
    double sliding_speed() const { return sliding; }
    /// The next time > t at which the acceleration of the heights may jump (end of the loading, a kink of the speed's
    /// table); infinite if there is none.
    double next_jump(double t) const;
    /// [m]
    double distance(double t) const { return travelled.empty() ? speed * t : travelled.value(t); }

  private:
    void make_speed(const RoadParameters &parameters, double end_time);
    void make_profile(const RoadParameters &parameters, double begin, double end);
    double loading(double t) const;

    const std::vector<double> places, shapes;
    const double speed, indentation, loading_time, sliding;
    /// empty: flat; constant speed
    PiecewisePolynomial profile, travelled;
    /// ascending [s]
    std::vector<double> jumps;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/scene/road.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// Motion of a body between events (propagators/event_located.h) on a piece of time, as Taylor series in
  /// x = (t - begin) / length, summed to rounding for length <= 2 / max |lambda|.
  ///
  /// Open points have no force; at closed ones u_i = u_r,i, whose second derivative gives the forces order by order:
  ///
  ///   q_C = G1_CC^-1 (u_r'' - 2 Re right (lambda^2 z + lambda load))_C,      z' = lambda z + left q + load
  ///
  /// u_r'' is interpolated in Chebyshev points.
  class PieceSeries
  {
  public:
    using Complex = std::complex<double>;

    PieceSeries(const BodyInContact &model, const Road &road);

    /// @param state z at the beginning; n_poles
    /// @param closed points, m of them; @param closed_inverse G1_CC^-1, m square, by rows
    /// @param at_any_rate also if the road is not smooth enough for the interpolation
    /// @return the factor by which the length could change for that; nothing is expanded if it is below 1
    double expand(const std::vector<Complex> &state, double begin, double length,
                  const std::vector<unsigned int> &closed, const std::vector<double> &closed_inverse,
                  bool at_any_rate);

    double begin() const { return begin_time; }
    double length() const { return duration; }
    /// coefficients of x^k of displacement [m] and force [N] of a point; n_orders
    const double *displacement(const unsigned int i) const { return &u[i * most_orders]; }
    const double *force(const unsigned int i) const { return &q[i * most_orders]; }
    unsigned int n_orders() const { return orders; }
    /// z at x
    void state(double x, std::vector<Complex> &z) const;
    /// of a point from 0 to x [N s]
    double impulse(unsigned int i, double x) const;

  private:
    static constexpr unsigned int most_orders = 64;

    double interpolate_road(const std::vector<unsigned int> &closed);

    const BodyInContact &model;
    const Road &road;
    const unsigned int n, n_poles;
    double begin_time = 0, duration = 0;
    unsigned int orders = 0;
    /// states, order by order; lambda z + load of one order; 2 right lambda by rows
    std::vector<std::vector<Complex>> series;
    std::vector<Complex> rate, bent;
    std::vector<double> u, q;
    /// coefficients of u_r'' of the closed points; what their forces have to balance
    std::vector<double> acceleration, unbalanced;
  };
} // namespace vibrocontact

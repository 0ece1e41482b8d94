#pragma once

#include <vibrocontact/analyses/periodic/forced_body.h>
#include <vibrocontact/base/dense.h>

#include <vector>

namespace vibrocontact
{
  /// Motion of one mode, q'' + 2 a q' + w^2 q = p, a = zeta w, in time t without force:
  ///
  ///   q(t) = qq q(0) + qv v(0),   v(t) = vq q(0) + vv v(0),   qv = (e^(s t) - e^(f t)) / (s - f)
  ///
  /// s, f the slow and the fast root; qv(t) and vv(t) are the answers to a unit impulse. Closed forms for any damping
  /// ratio, critical damping and rigid modes included.
  struct FreeMode
  {
    double qq, qv, vq, vv;
  };
  FreeMode free_mode(double omega, double zeta, double t);

  /// s Gauss points on [0, 1] and what polynomials through them need, independent of the length of a step.
  struct GaussRule
  {
    explicit GaussRule(unsigned int s);
    unsigned int s;
    /// nodes, weights; s
    std::vector<double> node, weight;
    /// value of the j-th Lagrange polynomial at x [s]
    std::vector<double> lagrange(double x) const;
    /// derivatives 0..s-1 of all Lagrange polynomials at x: entry k s + j
    std::vector<double> derivatives(double x) const;
  };

  /// Answers of a body at the time t = x h to a contact force that is a polynomial on [0, h] given by its values at the Gauss
  /// points,
  ///
  ///   q(t) += - trace int_0^t qv(t - tau) f(tau) dtau,   v(t) += - trace int_0^t vv(t - tau) f(tau) dtau,
  ///   r(t) += - S / beta int_0^t e^(-(t - tau) / beta) f(tau) dtau
  ///
  /// integrated by Gauss points where the mode is slow against t and by parts, exactly, where it is fast. One
  /// contact point.
  struct ForceAnswer
  {
    /// free motion of the modes over t; decay of r
    std::vector<FreeMode> free;
    double relaxation = 0;
    /// of displacement and velocity per force, without the trace: n_modes x s, row by row [s^2], [s]; of the residual
    /// without S: s [-]
    std::vector<double> displacement, velocity, residual;
  };
  /// @param beta relaxation of the residual, 0: it is no state
  ForceAnswer answer_to_force(const ForcedBody &body, const GaussRule &rule, double h, double x, double beta);
} // namespace vibrocontact

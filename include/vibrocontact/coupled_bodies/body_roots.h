#pragma once

#include <vibrocontact/coupled_bodies/answer_of_rest.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>
#include <vibrocontact/reduction/damped_wheel.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Body 1 without its dampers, at rest in its contact.
  struct BareBody
  {
    /// [rad/s]; Phi^T H Phi [1/s^2]; amplitudes of the patch shapes, rank x n_modes [1/sqrt(kg)]
    std::vector<double> omega;
    DenseMatrix loss, amplitudes;
    std::vector<std::string> labels;
  };

  /// The roots of a linearised contact near the modes of body 1 and its dampers, with hysteretic loss,
  ///
  ///   (s^2 + diag(w^2) + j H + A^T T(s) A + fixed masses m s^2 b b^T) q + sum k (1 + j eta) b (b^T q - x) = 0
  ///   m s^2 x + k (1 + j eta) (x - b^T q) = 0
  ///
  /// A: amplitudes of the patch shapes. T does not know the dampers: its equilibrium has none of their forces. For every band of
  /// frequencies in which own motions lie, the modes far from it follow at s what is near,
  ///
  ///   (s^2 + diag(lambda) + V_l P(s) V_r) v = 0,     v = (q near, sqrt(m) x),     P = C (1 + G C)^-1,   C = diag(T, k, m s^2),
  ///
  /// G their receptance, and P hardly depends on s. All eigenvalues with P at the band's middle are found at once, so that none
  /// near it is missed; those nearest to instability are then iterated with P at the root. Other roots (of what body 1 hardly
  /// moves in) are not looked for.
  /// @param nearly what the roots are chosen by, such as poles of a rail whose exact receptance costs much; may be `rest`
  /// @param body with the loss of its layers
  /// @return at most n_wanted, those with the largest divergence rates, and all that grow; without those that decay by more than
  /// 5e-3 of their angular frequency and do not settle
  /// @throws ConvergenceError if there is none, or another does not settle
  std::vector<StabilityRoot> roots_of_body(AnswerOfRest &nearly, AnswerOfRest &rest, const BareBody &body,
                                           const std::vector<AttachedMass> &masses,
                                           unsigned int n_wanted = 12);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/bodies/body_in_contact.h>

#include <vector>

namespace vibrocontact
{
  /// Whether a body by poles takes energy from every force, at all frequencies and not on a grid of them.
  struct PassivityTest
  {
    /// where an eigenvalue of Im G may pass zero, ascending [rad/s]
    std::vector<double> crossings;
    /// one for each interval between them, below and beyond them in which an eigenvalue of Im G is positive [rad/s]
    std::vector<double> active;

    bool is_passive() const { return active.empty(); }
  };

  /// The Hamiltonian test. Of real matrices with G(s) = C (s - A)^-1 B + D, D symmetric, an eigenvalue of
  /// Im G(j w) = (G(j w) - G(-j w)^T) / 2 j is zero where s = j w is an eigenvalue of the pencil
  ///
  ///   A x + B f = s x,     -A^T z + C^T f = s z,     C x + B^T z = 0,
  ///
  /// found by inversion about a real shift (Grivet-Talocia & Gustavsen 2015, Passive Macromodeling, section 9.4, with f kept
  /// as unknown since Re (s G) vanishes at infinity). Between neighbours no eigenvalue of Im G changes its sign, so that one
  /// frequency tells of each interval; eigenvalues near the axis are taken for such on it, which only adds intervals.
  /// @pre no modes, no pole on the axis, a symmetric residual
  /// @throws ConvergenceError if LAPACK finds no eigenvalues
  PassivityTest test_passivity(const BodyInContact &body);
} // namespace vibrocontact

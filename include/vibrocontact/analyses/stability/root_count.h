#pragma once

#include <vibrocontact/coupled_bodies/linearised_contact.h>

namespace vibrocontact
{
  /// Roots in the right half-plane, counted without any eigenvalue.
  struct RootCount
  {
    /// pairs with growth > 0 count two
    int unstable = 0;
    /// what the winding misses to a whole number [-], determinants evaluated
    double remainder = 0;
    unsigned int evaluations = 0;
    /// wall time [s]
    double seconds = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &unstable &remainder &evaluations &seconds;
    }
  };

  /// The argument principle on the contact's own equations in the frequency domain: the receptance of both
  /// bodies at the contact, H(s) = W~ + Psi diag(1 / (s^2 + 2 zeta w s + w^2)) Psi^T, closed gaps and sliding
  /// friction, R = E_N N + E_z z,
  ///
  ///   F(s) (N, z) = 0:      n: H_n R = 0 (hub fixed; force given: H_n R = const, sum dN = 0)
  ///                         b: (V d/dx + s) H_b R + z / c_b = 0
  ///
  /// Rests that relax stand in H with W / (1 + beta s). No state matrix appears, so that its assembly is checked too. det F
  /// has its zeros at the roots, its poles at the free modes (all of them damped: none on the right) and at -1 / beta, and
  /// grows as s^n_z; each slip that only relaxing rests give way to takes one from this power, and so does each such gap (but
  /// for one of them if the force is given). Hence
  ///
  ///   unstable roots = -1/pi [arg det F(i w) - n_z arg(i w + a)], w from 0 to infinity, a > 0.
  ///
  /// The frequencies lie densely round each free mode and each expected root and are halved where the
  /// argument moves by more than 0.5. The expected roots only say where to look: without them two roots of
  /// little damping far from all free modes could turn the argument by 2 pi unseen; wrong ones do no harm.
  /// For the consistent linearisation.
  /// @throws InputError if a mode is undamped; ConvergenceError if a root lies on the axis
  RootCount count_unstable_roots(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium,
                                 const std::vector<StabilityRoot> &expected);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/coupled_bodies/stability_roots.h>

namespace vibrocontact
{
  /// Roots that grow, counted without any eigenvalue.
  struct RootCount
  {
    /// pairs with growth > 0 count two; with hysteretic loss each root one
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

  /// The argument principle on det F of the contact's own equations (coupled_bodies/contact_receptance.h), in which no state
  /// matrix appears, so that its assembly is checked too. det F has its zeros at the roots, its poles at the free modes (all of
  /// them damped: none on the right) and at -1 / beta of rests that relax, and grows as s^p, p = ContactReceptance::power():
  /// the number n_z of slips, less one for each that only relaxing rests give way to and one for each such gap (but for one of
  /// them if the force is given).
  ///
  /// Viscous damping: F(conj s) = conj F(s), and the contour round the right half-plane is the imaginary axis and an arc,
  ///
  ///   unstable roots = -1/pi [arg det F(i w) - p arg(i w + a)], w from 0 to infinity, a > 0.
  ///
  /// Hysteretic loss holds for Im s > 0 alone (coupled_bodies/hysteretic_loss.h), so that the contour is that of the quadrant
  /// Re s > 0, Im s > 0: along the real axis outwards, on the arc s = r e^(i phi), phi from 0 to pi/2, where arg det F turns by
  /// p pi/2, and down the imaginary axis,
  ///
  ///   2 pi (unstable roots) = [arg det F(x)]_0^inf + p pi/2 - [arg det F(i w)]_0^inf
  ///                         = [arg det F(x) - p arg(x + a)]_0^inf - [arg det F(i w) - p arg(i w + a)]_0^inf.
  ///
  /// arg(x + a) is zero, and arg(i w + a) turns by pi/2. No pole lies in the quadrant: with modal amplitudes q there,
  /// the imaginary part of q^H (s^2 + s C + K + j H) q = 0 would be a sum of positive terms, 2 Re s Im s |q|^2 + Im s q^H C q
  /// + q^H H q. Each root counts one, as its conjugate belongs to K - j H. On the real axis F is complex, since K + j H is.
  ///
  /// The frequencies lie densely round each free mode and each expected root and are halved where the
  /// argument moves by more than 0.5. The expected roots only say where to look: without them two roots of
  /// little damping far from all free modes could turn the argument by 2 pi unseen; wrong ones do no harm.
  /// For the consistent linearisation.
  /// @param loss of the pair, or null
  /// @throws InputError if a mode is undamped; ConvergenceError if a root lies on the contour
  RootCount count_unstable_roots(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium,
                                 const std::vector<StabilityRoot> &expected,
                                 const HystereticLoss *loss = nullptr);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/reduction/modes.h>

#include <vector>

namespace vibrocontact
{
  /// Lowest modes from the flexibility: G M phi = phi / w^2, G by the factorisation that the static problem
  /// needs anyway (shift 0). A free body's G has the rigid modes in its kernel: they are put in front exactly
  /// and never disturb the others.
  ///
  /// - Completeness: one more factorisation, of K - s M without keeping factors, counts the modes below s
  ///   (Sylvester's law of inertia): before the solution at the frequency limit, which also tells how many
  ///   modes to ask for, or after it in the gap behind the last mode kept.
  /// - A Krylov sequence of blocks sees an exactly multiple frequency as often as a block has columns: what the
  ///   count misses is sought again, deflating the modes found.
  /// - A pair (frequencies within 1e-3) is never split: the partner of the last mode is kept too.
  /// - Pairs within 1e-6 are turned until one mode is symmetric and the other antisymmetric to the plane
  ///   x = 0.
  /// - Signs: the projection of the shape on a fixed field of no symmetry is positive; they do not depend on
  ///   ranks.
  /// @throws ConvergenceError with numbers if modes miss, are not orthonormal or leave a residual
  Modes compute_modes(const SecondOrderSystem &system, Flexibility &flexibility,
                      const ModeParameters &parameters);

  /// Modal damping ratios from the hysteretic loss: zeta = phi^T K'' phi / (2 w^2); 0 for rigid modes and
  /// lossless bodies.
  std::vector<double> strain_energy_damping(const SecondOrderSystem &system, const Modes &modes);

  /// A viscous damping C seen by modes.
  struct ModalDamping
  {
    /// c_ii / (2 w_i), c = Phi^T C Phi; 0 for rigid modes; n_modes or, without damping, empty [-]
    std::vector<double> ratio;
    /// largest |c_ij| / sqrt(c_ii c_jj) of two elastic modes, at most 1: what ratios leave out; 0 if C is diagonal in the
    /// modes, as that of Rayleigh is [-]
    double coupling = 0;
  };
  /// @throws InputError if C feeds energy into a mode or resists a rigid motion
  ModalDamping modal_damping(const SecondOrderSystem &system, const Modes &modes);

  /// Both together, one per mode [-].
  std::vector<double> damping_ratios(const SecondOrderSystem &system, const Modes &modes);

  /// phi_i^T K'' phi_j of the hysteretic loss; empty if it couples no modes (to 1e-6 of its diagonal): the body has one loss
  /// factor or none [1/s^2]
  DenseMatrix coupling_loss(const SecondOrderSystem &system, const Modes &modes);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/bodies/reduced_body.h>
#include <vibrocontact/reduction/flexibility.h>

namespace vibrocontact
{
  /// Begins the names of residual attachment modes.
  constexpr const char *residual_label = "residual ";

  /// P_c G M G P_c^T, the mass matrix of the attachment responses G P_c^T, 3 n square [m s^2/N], symmetric;
  /// two solves per contact row. Replicated. Collective.
  DenseMatrix attachment_mass(const SecondOrderSystem &system, Flexibility &flexibility);

  /// Gives the residual attachment responses back the inertia that Eq. 12 drops (Lai et al. 2018; Rubin's
  /// reduction). With the residual responses G~ P^T of G~ = G - Phi_e diag(w_e^-2) Phi_e^T,
  ///
  ///   U = Phi q + G~ P^T r,     M_r = P G~ M G~ P^T = P G M G P^T - Psi_e diag(w_e^-4) Psi_e^T
  ///   M_r r'' + W~ r = W~ R,    P U = Psi q + W~ r
  ///
  /// r is coupled to no mode, since Phi^T M G~ = Phi^T K G~ = 0. The eigenvectors X of W~ x = nu^2 M_r x, X^T
  /// M_r X = I, make r another set of modes: frequencies nu, traces W~ X. They are appended to the body's
  /// own (named "residual 1", ...; damping ratio of the last mode kept), and its residual flexibility becomes
  /// zero: the static response is exactly the same. Directions in which W~ is less than 1e-10 of the largest
  /// static compliance have no residual response and are left out.
  /// @param mass attachment_mass()
  ReducedBody with_attachment_inertia(ReducedBody body, const DenseMatrix &mass);
} // namespace vibrocontact

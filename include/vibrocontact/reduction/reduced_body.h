#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/scene/contact_grid.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A body as the contact sees it: free-interface modes plus residual attachment responses
  /// (Lai et al. 2018, Eqs 8-14; doc/theory.md, "Meshed bodies and their reduction").
  ///
  ///   q'' + diag(2 zeta w) q' + diag(w^2) q = Phi^T F + Psi^T R,    Psi = P_c Phi
  ///   P_c U = lifting * u_hub + Psi q + W~ R + residual load response
  ///
  /// with the residual flexibility W~ = P_c K^-1 P_c^T - Psi_e diag(w_e^-2) Psi_e^T over the elastic modes
  /// kept (inertia-relief flexibility in place of K^-1 if the body is free). R acts on this body, global
  /// axes. Half-spaces have no modes; their W~ is never formed (see half_space.h). Replicated on all ranks.
  struct ReducedBody
  {
    std::string name;
    /// of several contacts the first; their points follow each other in all rows
    ContactGrid grid;
    /// dofs of the finite-element model behind it; 0 for a half-space
    unsigned int n_dofs = 0;

    /// leading modes that are rigid motions, omega = 0
    unsigned int n_rigid_modes = 0;
    /// angular frequencies [rad/s] and damping ratios [-], ascending; n_modes
    std::vector<double> omega, damping_ratio;
    /// e.g. axial(0,2); n_modes
    std::vector<std::string> labels;
    /// Psi, rows as contact_row(); 3 n x n_modes, mass-normalised shapes [1/sqrt(kg)]
    DenseMatrix modal_trace;
    /// Phi^T F [N/sqrt(kg)]; n_modes
    std::vector<double> modal_load;

    /// Phi^T M e of unit translations e of the whole body along x, y, z; n_modes x 3 [sqrt(kg)]; empty
    /// without modes
    DenseMatrix participation;

    /// W~, symmetric positive semi-definite; 3 n square [m/N]
    DenseMatrix residual_flexibility;
    /// contact displacement for a unit vertical hub (held boundary) displacement; 3 n [-]
    std::vector<double> lifting;
    /// residual static contact displacement under the body's loads; 3 n [m]
    std::vector<double> residual_load_response;
    /// mean height of the undeformed surface over each cell, relative to the nominal contact point; n [m]
    std::vector<double> surface_height;
  };

  /// Adds Psi diag(w^-2) Psi^T, what modes answer to static forces [m/N]; trace 3 n x n_modes.
  /// @throws InputError naming `body` and the directions if a mode is rigid: nothing carries static forces
  void add_modal_compliance(DenseMatrix &compliance, const DenseMatrix &trace,
                            const std::vector<double> &omega, const std::string &body);

  /// P_c K^-1 P_c^T = W~ + Psi diag(w^-2) Psi^T, 3 n square [m/N].
  /// @throws InputError if the body has rigid modes: it has no static compliance.
  DenseMatrix static_compliance(const ReducedBody &body);
} // namespace vibrocontact

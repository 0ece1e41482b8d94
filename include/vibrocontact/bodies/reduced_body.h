#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/scene/contact_grid.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct FlowReduction;
  struct RevolvedShapes;

  /// The hub of a body as an interface that is rigid.
  struct HubInertia
  {
    /// its middle, about which it turns, from the nominal contact point [m]
    std::array<double, 3> centre;
    /// of the whole body for translations along x, y, z and rotations about them; 6 square [kg], [kg m], [kg m^2]
    DenseMatrix mass;
  };

  /// A body at its contact points, three rows each as contact_row(), in global axes, under forces on it: free-interface
  /// modes plus residual attachment responses (Lai et al. 2018, Eqs 8-14; doc/theory.md, "Meshed bodies and their
  /// reduction"), or what else it is known by.
  ///
  ///   q'' + diag(2 zeta w) q' + diag(w^2) q = Phi^T F + Psi^T R,    Psi = P_c Phi
  ///   P_c U = lifting * u_hub + Psi q + W~ R + residual load response
  ///
  /// trace Psi, ascending frequencies; residual W~ = P_c K^-1 P_c^T - Psi_e diag(w_e^-2) Psi_e^T over the elastic
  /// modes kept (inertia-relief flexibility in place of K^-1 if the body is free), symmetric positive semi-definite.
  /// Participation and gradient are along the global x, which points backwards, and y and z.
  /// Half-spaces have no modes; their W~ is never formed (see half_space.h). Replicated on all ranks.
  struct ReducedBody : BodyInContact
  {
    std::string name;
    /// of several contacts the first; their points follow each other in all rows
    ContactGrid grid;
    /// dofs of the finite-element model behind it; 0: there is none
    unsigned int n_dofs = 0;
    /// leading modes that are rigid motions, omega = 0
    unsigned int n_rigid_modes = 0;
    /// contact displacement for a unit vertical hub (held boundary) displacement; 3 n [-]
    std::vector<double> lifting;
    /// mean height of the undeformed surface over each cell, relative to the nominal contact point; n [m]
    std::vector<double> surface_height;
    /// of a body that turns past its contact points, with modes (bodies/rolling_modes.h); null: it does not
    std::shared_ptr<const FlowReduction> flow = nullptr;
    /// of a body of revolution by harmonics, with modes (reduction/revolved_shapes.h); null: any other body
    std::shared_ptr<const RevolvedShapes> section = nullptr;
    /// amplitudes of the modes of its reduction per amplitude of its modes, n x n_modes; empty: they are the same
    DenseMatrix mixing = DenseMatrix();
    /// Phi^T H Phi of the hysteretic loss H = sum of eta_e K_e, n_modes square, if loss factors differ and so couple the modes;
    /// empty: diagonal, 2 zeta w^2 [1/s^2]
    DenseMatrix loss = DenseMatrix();
    /// what the damping ratios leave out of a viscous damping, see ModalDamping::coupling [-]
    double damping_coupling = 0;
    /// of a body whose participation has rotations
    std::optional<HubInertia> hub = {};
  };

  /// Adds Psi diag(w^-2) Psi^T, what modes answer to static forces [m/N]; trace 3 n x n_modes.
  /// @throws InputError naming `body` and the directions if a mode is rigid: nothing carries static forces
  void add_modal_compliance(DenseMatrix &compliance, const DenseMatrix &trace,
                            const std::vector<double> &omega, const std::string &body);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/analyses/hub.h>
#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/contact/interface.h>
#include <vibrocontact/reduction/reduced_body.h>
#include <vibrocontact/scene/body.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Two reduced bodies as one contact sees them: the jump of the contact displacements (body 1 minus body 2)
  /// and the modes of both,
  ///
  ///   du = Psi q + W~ R + load_jump,      q'' + 2 zeta w q' + w^2 q = Psi^T R + load
  ///
  /// R: forces on body 1; a given force on body 1 at its contact point along z adds its force_participation and
  /// force_response. The opposite force on body 2 and its share of the jump are in the sign of its
  /// columns of Psi, so that nothing after this distinguishes the bodies (Lai et al. 2018, Eqs 8-14).
  struct ContactPair
  {
    ContactInterface interface;
    /// angular frequencies [rad/s], damping ratios [-], names as body:label; bodies (1 or 2); modes of body 1
    /// first
    std::vector<double> omega, damping_ratio;
    std::vector<std::string> labels;
    std::vector<unsigned int> body;
    /// Psi: +Psi_1, -Psi_2; 3 n x n_modes [1/sqrt(kg)]
    DenseMatrix modal_trace;
    /// modal loads [N/sqrt(kg)]; n_modes
    std::vector<double> modal_load;
    /// phi^T M e of unit translations of the mode's body along x, y, z; n_modes x 3 [sqrt(kg)]
    DenseMatrix participation;
    /// residual displacements of the contact per force on body 1 at its first contact point along z [m/N]; 3 n, empty: none
    std::vector<double> force_residual;
    /// W~ of both bodies: residual flexibilities (or what Contact/Local flexibility puts in their place), the
    /// whole compliance of half-spaces, nothing of rigid bodies; 3 n square [m/N]
    DenseMatrix residual_flexibility;
    /// null: the hub of body 1 moves as the approach does
    std::shared_ptr<const SuspendedHub> hub;

    /// modal force per Drive::hub_acceleration: Gamma_z of body 1's modes on a held hub, or the unsprung mass times
    /// what they move a suspended one; 0 for others and if unknown [sqrt(kg)]
    double hub_participation(const unsigned int mode) const
    {
      if (hub)
        return -hub->mass * hub->motion(2, mode);
      return body[mode] == 1 && mode < participation.m() ? participation(mode, 2) : 0.;
    }

    /// of a mode [1/sqrt(kg)] and of a row of the contact's residual displacements [m/N] per given force on body 1
    double force_participation(const unsigned int mode) const
    {
      return body[mode] == 1 ? modal_trace(0, mode) : 0.;
    }
    double force_response(const unsigned int row) const
    {
      return force_residual.empty() ? 0. : force_residual[row];
    }

    unsigned int n_points() const { return interface.grid.n_points(); }
    unsigned int n_modes() const { return omega.size(); }
  };

  /// One body of the scene as the contact needs it: half-spaces and rigid bodies by their parameters, any
  /// other reduced.
  struct ContactBody
  {
    const BodyParameters *parameters;
    /// null for half-spaces and rigid bodies
    const ReducedBody *reduced;
  };

  /// Elastic constants of a body without mesh, infinite stiffness of a rigid one.
  HalfSpaceMaterial half_space_material(const BodyParameters &body);

  /// Grid, undeformed gap and loads of body 1 (above) on body 2 (below).
  /// @throws InputError if body 1 cannot be moved by its hub or the quadrature does not suit the bodies
  ContactInterface contact_interface(const ContactBody &body_1, const ContactBody &body_2,
                                     const ContactGrid &grid);

  /// Brings two bodies together. A meshed body's compliance is that of its own elements only, unless
  /// `contact` asks for half-spaces: these replace W~ of solid bodies, whose modes, undeformed surface and
  /// answer to loads stay. Without normal-tangential coupling W~'s blocks between the directions are zero.
  ContactPair contact_pair(const ContactBody &body_1, const ContactBody &body_2,
                           const ContactParameters &contact, const ContactGrid &grid);

  /// W~ + Psi diag(w^-2) Psi^T: what a static analysis sees; 3 n square [m/N].
  /// @throws InputError if a body can move freely
  DenseMatrix static_compliance(const ContactPair &pair);

  /// The interface of a static analysis, in whose load_jump the modes answer the constant loads at rest.
  ContactInterface static_interface(const ContactPair &pair);
} // namespace vibrocontact

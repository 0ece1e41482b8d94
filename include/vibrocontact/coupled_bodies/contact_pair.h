#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/bodies/reduced_body.h>
#include <vibrocontact/contact/contact_operator.h>
#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/contact/interface.h>
#include <vibrocontact/coupled_bodies/hub.h>
#include <vibrocontact/scene/body.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Two half-spaces, or one and a rigid body, in the only contact of a scene: what they answer depends on the distance
  /// between points alone, and no matrix of the whole grid is stored.
  struct HalfSpaces
  {
    HalfSpacePair pair;
    /// W~ by its kernels [m/N]
    HalfSpaceOperator flexibility;

    HalfSpaces(const HalfSpacePair &pair, const ContactGrid &grid) : pair(pair), flexibility(grid, pair, {1.})
    {
    }
  };

  /// The share that a body damped by C = beta K has in W~ of a scene. It follows forces by its rate, as a Kelvin-Voigt element,
  ///
  ///   beta r' + r = W R,     or     r = W s,   beta s' + s = R
  struct RelaxingRest
  {
    /// counted from 1 in the order of Bodies
    unsigned int body = 1;
    /// beta [s]
    double relaxation = 0;
    /// W at the rows of the contacts; 3 n square [m/N]
    DenseMatrix flexibility;
  };

  /// The bodies of a scene as one, whose rows are the jump of the contact displacements (first body of each contact minus
  /// the second; 3 n rows) and whose states are those of all,
  ///
  ///   du = Psi q + 2 Re right z + W~ R + load_jump,      q'' + 2 zeta w q' + w^2 q = Psi^T R + load
  ///                                                       z' = lambda z + left^T R + load
  ///
  /// R: forces on the first body; a given force on body 1 at its contact point along z adds its force_participation and
  /// force_response. The opposite force on the second body and its share of the jump are in the sign of its
  /// rows of Psi, so that nothing after this distinguishes the bodies (Lai et al. 2018, Eqs 8-14). A body in several
  /// contacts couples them: by its modes, and by its blocks of W~ between their points.
  ///
  /// trace Psi; residual W~: the residual flexibilities of all bodies (or what Contact/Local flexibility puts in their
  /// place), the whole compliance of half-spaces, nothing of rigid bodies. It is empty where half-spaces are alone: they have
  /// their kernels. Modes and poles of body 1 first, labels as
  /// body:label. Gradients are those of the bodies that bring some, less the differences between points that V d/dx is
  /// otherwise.
  struct ContactPair : BodyInContact
  {
    ContactInterface interface;
    /// W~ of half-spaces that nothing else is in contact with, null: W~ is the residual
    std::shared_ptr<const HalfSpaces> half_spaces;
    /// of each mode and of each pole its body, counted from 1 in the order of Bodies
    std::vector<unsigned int> body, body_of_pole;
    /// the highest frequency of modes and poles of a pair with bodies of elements [Hz]: above, its motions are made by what these leave
    /// out. Infinite: there are none that leave anything out
    double modes_reach = std::numeric_limits<double>::infinity();
    /// residual displacements of the contacts per force on body 1 at its first contact point along the normal [m/N]; 3 n, empty: none
    std::vector<double> force_residual;
    /// what of W~ relaxes; what it leaves of the residual follows forces at once
    std::vector<RelaxingRest> relaxing;
    /// of body 1, if it is known to turn: then participation has rotations
    std::optional<HubInertia> hub_inertia;
    /// null: the hub of body 1 moves as the approach does
    std::shared_ptr<const SuspendedHub> hub;

    /// modal force per Drive::hub_acceleration: Gamma_z of body 1's modes on a held hub, or the mass of all
    /// that moves with a suspended hub or an axle times what they move the hub; 0 for others and if unknown [sqrt(kg)]
    double hub_participation(const unsigned int mode) const
    {
      if (hub)
        return -hub->mass * hub->motion(2, mode);
      return body[mode] == 1 && mode < participation.m() ? participation(mode, 2) : 0.;
    }

    /// of a mode [1/sqrt(kg)] and of a row of the contact's residual displacements [m/N] per given force on body 1
    double force_participation(const unsigned int mode) const
    {
      return body[mode] == 1 ? trace(0, mode) : 0.;
    }
    /// Of a pole, as force_participation() of a mode.
    std::complex<double> force_into_pole(const unsigned int pole) const
    {
      return body_of_pole[pole] == 1 ? left(0, pole) : 0.;
    }
    double force_response(const unsigned int row) const
    {
      return force_residual.empty() ? 0. : force_residual[row];
    }

    unsigned int n_points() const { return interface.contacts.n_points(); }
    /// Frequencies [rad/s] of the modes, then of the poles: what the shapes of roots are amplitudes of.
    std::vector<double> frequencies() const;
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

  /// Contacts and undeformed gaps of the bodies of a scene, in its order.
  /// @throws InputError if the quadrature does not suit the bodies
  ContactInterface contact_interface(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                                     const PlacedContacts &contacts);

  /// Brings the bodies of a scene together. A meshed body's compliance is that of its own elements only, unless
  /// `contact` asks for half-spaces: these replace W~ of solid bodies, whose modes, undeformed surface and
  /// answer to loads stay. Without normal-tangential coupling W~'s blocks between the directions are zero.
  ContactPair contact_pair(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                           const PlacedContacts &contacts);
  /// What body b (from 0) brings to W~, its own flexibility or that which Contact/Local flexibility puts in its place;
  /// 3 n square [m/N].
  DenseMatrix brought_flexibility(const std::vector<ContactBody> &bodies, unsigned int b,
                                  const ContactSections &sections, const PlacedContacts &contacts);
  /// W~ over a step of h, in which rests relax by the backward difference (doc/theory.md, "Damping of what the modes leave
  /// out"): sum of h W / (h + beta) and of what follows at once, r(h) = this R + sum of beta W s(0) / (h + beta); 3 n
  /// square [m/N]. For h = 0 what follows at once alone.
  DenseMatrix rest_over_step(const ContactPair &pair, double h);

  /// Whether half-spaces are alone in the scene.
  bool are_half_spaces_alone(const std::vector<ContactBody> &bodies, const PlacedContacts &contacts);
  /// What they are to each other. @pre they are alone
  HalfSpacePair half_space_pair(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                                const PlacedContacts &contacts);

  /// Two bodies in one contact.
  inline ContactPair contact_pair(const ContactBody &body_1, const ContactBody &body_2,
                                  const ContactParameters &contact, const ContactGrid &grid)
  {
    return contact_pair({body_1, body_2}, contact, grid);
  }

  /// W~ as a matrix, that of half-spaces too; 3 n square [m/N].
  DenseMatrix residual_flexibility(const ContactPair &pair);
  /// result += W R, 3 n [m]. @param alone half-spaces, whose kernels stand in place of W; or null
  void add_residual_displacement(const DenseMatrix &W, const HalfSpaces *alone, const DenseVector &R,
                                 DenseVector &result);
  /// Of several forces at once, so that W is read once.
  void add_residual_displacements(const DenseMatrix &W, const HalfSpaces *alone,
                                  const std::vector<const DenseVector *> &R,
                                  const std::vector<DenseVector *> &results);

  /// W~ + Psi diag(w^-2) Psi^T - 2 Re right diag(1 / lambda) left^T: what a static analysis sees; 3 n square [m/N].
  /// @throws InputError if a body can move freely
  DenseMatrix static_compliance(const ContactPair &pair);

  /// The gradients of the poles at rest and of W~, 3 n square [1/N]; empty without any.
  DenseMatrix static_gradient(const ContactPair &pair);

  /// A of steady rolling: static_compliance() and static_gradient() in slip rows.
  std::shared_ptr<const ContactOperator> static_operator(const ContactPair &pair, const CreepScheme &scheme,
                                                         double speed);

  /// The interface of a static analysis, in whose load_jump the modes answer the constant loads at rest.
  ContactInterface static_interface(const ContactPair &pair);
} // namespace vibrocontact

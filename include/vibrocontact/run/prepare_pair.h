#pragma once

#include <vibrocontact/bodies/road_rows.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/hysteretic_loss.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <memory>
#include <optional>
#include <vector>

namespace vibrocontact
{
  /// The bodies of a scene as their contacts see them.
  struct PreparedPair
  {
    std::vector<ReducedBody> reduced;
    /// in the order of the scene; they refer to the others and to the parameters
    std::vector<ContactBody> bodies;
  };

  /// Body `number` of the scene as its contacts see it; nothing for a half-space or a rigid body. What is known between its
  /// own points alone (an oscillator, a ring) becomes what it is on a road, see road_body() and contact_rows().
  /// @param meshed its reduction if it has a mesh, with its damping as section Modes scales it
  std::optional<ReducedBody> body_of_contact(const Parameters &parameters, std::optional<ReducedBody> meshed,
                                             const std::optional<MeasuredData> &measured,
                                             unsigned int number);

  /// Of its periodic rails, in the rows of the contacts; they refer to `bodies`.
  /// @param with_poles beside TrackBody::moving(), from whose poles roots are sought; false: beside TrackBody::at_rest()
  std::vector<ExactReceptance> exact_receptances(const MeshedBodies &bodies, const PlacedContacts &contacts,
                                                 bool with_poles = true);

  /// Reduces the bodies of the scene (or finds them in the cache), with their modes or for a static
  /// analysis. Collective.
  /// @param in_time bands in which periodic rails have to be right in time, see TrackBody::in_time(); null: they have the poles from
  /// which their roots are sought
  std::unique_ptr<const PreparedPair> prepare_pair(const Parameters &parameters, const MeshedBodies &bodies,
                                                   const std::optional<MeasuredData> &measured,
                                                   bool with_modes,
                                                   const std::vector<FrequencyBand> *in_time = nullptr);
} // namespace vibrocontact

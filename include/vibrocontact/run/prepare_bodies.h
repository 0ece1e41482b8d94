#pragma once

#include <vibrocontact/run/meshed_body.h>
#include <vibrocontact/run/parameters.h>
#include <vibrocontact/run/track_body.h>

#include <nlohmann/json.hpp>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// The meshed bodies of a scene in its order, null for the others. Cases of a sweep share those that are equal; their
  /// damping factors, which come in after the reduction, are those of the case's parameters.
  struct MeshedBodies : std::vector<std::shared_ptr<MeshedBody>>
  {
    using std::vector<std::shared_ptr<MeshedBody>>::vector;
    /// periodic rails in contact in the scene's order, null for other bodies; empty: there is none
    std::vector<std::shared_ptr<TrackBody>> tracks;
  };

  /// The key of the reduction of meshed body k of the scene; see body_key().
  std::string reduction_key(const Parameters &parameters, const DeclaredParameters &declared, unsigned int k);

  /// Prepares meshed body k, null if it has no mesh; nothing is made yet. It refers to `parameters`.
  std::unique_ptr<MeshedBody> meshed_body(const Parameters &parameters, const std::string &key,
                                          unsigned int k);

  /// Prepares periodic rail k in its contact, null if it is none or touches nothing; nothing is made yet.
  std::unique_ptr<TrackBody> track_body(const Parameters &parameters, const std::string &key, unsigned int k);

  /// All of them.
  MeshedBodies meshed_bodies(const Parameters &parameters, const DeclaredParameters &declared);

  /// Reduces the bodies or finds them in the cache, so that whoever asks for them later needs no other rank. Collective.
  void reduce_bodies(const MeshedBodies &bodies, bool with_modes);

  /// What comes in after the reduction of a meshed body: the losses of the materials of a wheel by harmonics, Damping factor and
  /// Stiffness damping (by which its rest relaxes), a wheel's dampers, and Coriolis forces, with which it moves by poles.
  void complete_reduction(ReducedBody &body, const BodyParameters &parameters, const ModeParameters &modes,
                          bool with_dampers = true);

  /// The modes of a body without contact, with all that damps it. Collective.
  /// @param parameters of the case that asks; cases that differ by dampers and losses share the reduction
  ReducedBody free_modes(MeshedBody &body, const BodyParameters &parameters);
  /// These modes on its surface, which its dampers' masses are no part of. Collective.
  SurfaceShapes shapes_of_modes(MeshedBody &body, const BodyParameters &parameters);

  /// Makes the meshes and lays the contact grid on them, so that what is wrong there is said before the
  /// expensive steps. Bodies whose reduction is in the cache have passed already and are only made if `all`.
  void check_meshes(const Parameters &parameters, const MeshedBodies &bodies, bool all);

  /// What --check shows. @param picture_folder where the scene is drawn as well; empty: nowhere
  void print_scene(const Parameters &parameters, const MeshedBodies &bodies, const ContactGrid &grid,
                   const std::string &picture_folder);

  /// `reductions` in results.json, an object per meshed body: stages_s (wall seconds of each stage that this
  /// run did, none if all was cached) and ranks[], each with its owned dofs and its peak memory so far.
  /// Of periodic rails `fit`: pairs of poles, errors. Collective.
  nlohmann::ordered_json reductions_json(const MeshedBodies &bodies);

  /// receptance_fit_<body>.csv of each periodic rail that moved in a contact. Rank 0 writes.
  void write_track_fits(const MeshedBodies &bodies, const std::string &folder);
} // namespace vibrocontact

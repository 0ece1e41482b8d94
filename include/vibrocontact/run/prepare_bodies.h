#pragma once

#include <vibrocontact/run/meshed_body.h>
#include <vibrocontact/run/parameters.h>

#include <nlohmann/json.hpp>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// The meshed bodies of a scene in its order, null for the others.
  using MeshedBodies = std::vector<std::unique_ptr<MeshedBody>>;

  /// Prepares the meshed bodies; nothing is made yet. They refer to `parameters` and `grid`.
  MeshedBodies meshed_bodies(Parameters &parameters, const DeclaredParameters &declared,
                             const ContactGrid &grid);

  /// Makes the meshes and lays the contact grid on them, so that what is wrong there is said before the
  /// expensive steps. Bodies whose reduction is in the cache have passed already and are only made if `all`.
  void check_meshes(const Parameters &parameters, const MeshedBodies &bodies, bool all);

  /// What --check shows.
  void print_scene(const Parameters &parameters, const MeshedBodies &bodies, const ContactGrid &grid);

  /// `reductions` in results.json, an object per meshed body: stages_s (wall seconds of each stage that this
  /// run did, none if all was cached) and ranks[], each with its owned dofs and its peak memory so far.
  /// Collective.
  nlohmann::ordered_json reductions_json(const MeshedBodies &bodies);
} // namespace vibrocontact

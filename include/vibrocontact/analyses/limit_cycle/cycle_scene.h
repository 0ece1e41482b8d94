#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_map.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>
#include <vibrocontact/run/parameters.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// What limit cycles are sought about: the bodies, what moves them, the equilibrium of rolling, and how a period is marched.
  struct CycleScene
  {
    /// integrator and thetas alone: what else a march is given belongs to it
    TransientParameters steps;
    /// of the contact of a step, see solver_of_cycles()
    ContactSolverParameters solver;
    ContactSections contacts;
    /// with the hub as it moves
    std::shared_ptr<const ContactPair> pair;
    /// shapes_of_steps() of the pair
    std::shared_ptr<const PatchShapes> shapes;
    Drive drive;
    DynamicState at_rest;
  };

  /// @param held the pair with its hub held @param constants of section Rolling
  /// @param like another scene of the same held pair, which shares with it what is the same; null: none
  /// @throws ConvergenceError if there is no equilibrium, InputError
  CycleScene cycle_scene(const Parameters &parameters, const std::shared_ptr<const ContactPair> &held,
                         const ContactSections &contacts, const RollingCase &constants,
                         const CycleScene *like = nullptr);

  /// The map of a period about it. @param points, n_steps as CycleMap has them; the scene is referred to
  /// @param solver in place of that of the scene
  std::unique_ptr<CycleMap> map_about(const CycleScene &scene, const std::vector<unsigned int> &points,
                                      unsigned int n_steps, const ContactSolverParameters &solver);
  std::unique_ptr<CycleMap> map_about(const CycleScene &scene, const std::vector<unsigned int> &points,
                                      unsigned int n_steps);

  /// Why the machine has too little memory for the derivatives of so many steps; empty: it has enough. Collective.
  std::string shortage_of_derivatives(const CycleScene &scene, unsigned int n_steps);

  /// All roots about the equilibrium. @throws InputError if points stick in it
  std::vector<StabilityRoot> roots_of(const CycleScene &scene);
  /// Those that oscillate and grow, as a stability analysis counts them.
  std::vector<StabilityRoot> unstable_of(const std::vector<StabilityRoot> &roots);
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/cycle_scene.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/coupled_bodies/all_roots.h>
#include <vibrocontact/marching/hub_motion.h>
#include <vibrocontact/marching/initial_state.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// of the contact at rest
    constexpr double rest_contact_tolerance = 1e-11;

    TransientParameters steps_alone(const TransientParameters &transient)
    {
      TransientParameters steps;
      steps.integrator = transient.integrator;
      steps.theta = transient.theta;
      steps.residual_theta = transient.residual_theta;
      steps.reaction = transient.reaction;
      return steps;
    }
  } // namespace

  CycleScene cycle_scene(const Parameters &parameters, const std::shared_ptr<const ContactPair> &held,
                         const ContactSections &contacts, const RollingCase &constants,
                         const CycleScene *const like)
  {
    CycleScene scene;
    scene.steps = steps_alone(parameters.transient);
    scene.solver = solver_of_cycles(parameters.contact_solver);
    scene.contacts = contacts;
    ContactSolverParameters solver = parameters.contact_solver;
    solver.tolerance = std::min(solver.tolerance, rest_contact_tolerance);
    const HubMotion hub =
        hub_motion(parameters.hub(), parameters.rolling, LoadOverTime(), scene.contacts, solver, held,
                   drive_function(scene.steps, constants, parameters.placed_contacts()));
    scene.pair = hub.pair;
    if (!scene.pair->relaxing.empty())
      throw InputError(
          "Body " + std::to_string(scene.pair->relaxing.front().body) +
          " leaves a rest that follows forces with a delay, but in limit cycles what modes and poles "
          "leave out follows at once: take a body without its damping.");
    scene.shapes = like && like->pair == scene.pair
                       ? like->shapes
                       : std::make_shared<const PatchShapes>(shapes_of_steps(*scene.pair));
    scene.drive = hub.drive(0);
    scene.at_rest = initial_state(scene.steps, scene.contacts, solver, *held, hub);
    return scene;
  }

  std::unique_ptr<CycleMap> map_about(const CycleScene &scene, const std::vector<unsigned int> &points,
                                      const unsigned int n_steps, const ContactSolverParameters &solver)
  {
    return std::make_unique<CycleMap>(scene.steps, scene.contacts, solver, *scene.pair, scene.drive,
                                      scene.at_rest.contact.approach, points, n_steps, scene.shapes);
  }

  std::unique_ptr<CycleMap> map_about(const CycleScene &scene, const std::vector<unsigned int> &points,
                                      const unsigned int n_steps)
  {
    return map_about(scene, points, n_steps, scene.solver);
  }

  std::string shortage_of_derivatives(const CycleScene &scene, const unsigned int n_steps)
  {
    const std::size_t n_loaded = loaded_points(scene.at_rest.R, scene.pair->n_points()).size();
    return memory_shortage("the derivatives of " + std::to_string(n_steps) +
                               " steps (a longer Limit cycle/Time step needs fewer)",
                           8. * n_steps * 9 * n_loaded * n_loaded, run_communicator());
  }

  std::vector<StabilityRoot> roots_of(const CycleScene &scene)
  {
    const ContactSolution &contact = scene.at_rest.contact;
    const PlacedContacts &contacts = scene.pair->interface.contacts;
    const auto n_stuck = std::count(contact.status.begin(), contact.status.end(), ContactStatus::stick);
    if (n_stuck > 0)
      throw InputError(
          std::to_string(n_stuck) +
          " points stick in the rolling equilibrium, but limit cycles are sought from one in which "
          "all slide: raise the creepage or the sliding velocity, or lower the friction.");
    return all_roots(*scene.pair, find_creep_scheme(scene.contacts.first().creep_scheme),
                     rolling_equilibrium(contact, friction_law_of_points(scene.contacts, contacts),
                                         normal_law_of_points(scene.contacts, contacts),
                                         scene.drive.creepage.speed, scene.drive.normal_force > 0),
                     LinearisationOptions(), nullptr);
  }

  std::vector<StabilityRoot> unstable_of(const std::vector<StabilityRoot> &roots)
  {
    std::vector<StabilityRoot> unstable;
    for (const StabilityRoot &root : roots)
      if (root.grows() && root.frequency > 0)
        unstable.push_back(root);
    return unstable;
  }
} // namespace vibrocontact

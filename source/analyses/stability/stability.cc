#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/coupled_bodies/all_roots.h>
#include <vibrocontact/coupled_bodies/suspended_pair.h>

#include <algorithm>

namespace vibrocontact
{
  void StabilityParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Model", model,
                      "What moves. reduced: modes, contact points without mass; attachment inertia: the "
                      "residual attachment "
                      "responses keep theirs; finite elements: all dofs, for small scenes. Units: none.",
                      Selection("reduced|attachment inertia|finite elements"));
    prm.add_parameter("Loss", loss,
                      "How bodies of finite elements lose energy. viscous: by the damping ratios that their "
                      "loss factors make of "
                      "each mode, as in time; hysteretic: by the loss factors themselves, which couple the "
                      "modes and damp what they leave out. Units: none.",
                      Selection("viscous|hysteretic"));
    prm.add_parameter("Roots", roots,
                      "all: complete; of body 1: those near modes of a wheel by harmonics and of its dampers "
                      "(Loss = hysteretic), a hundred times faster for variants of the dampers in a Sweep. "
                      "Units: none.",
                      Selection("all|of body 1"));
    prm.add_parameter(
        "Linearisation", linearisation,
        "consistent: slip direction per point, transport V d/dx and the rate of the residual displacements, "
        "as the transient has them; paper: K_c and C_b alone. Units: none.",
        Selection("consistent|paper"));
    prm.add_parameter(
        "Lateral damping", lateral_damping,
        "Keep the damping C_b of sliding friction across the slip (paper's linearisation). Units: none.",
        Bool());
    prm.add_parameter("Convective slip", convection,
                      "Keep V d/dx of the perturbed slip (paper's linearisation). Units: none.", Bool());
    prm.add_parameter(
        "Number of roots", n_roots,
        "Roots of lowest frequency to be found of finite elements with more than 1,500 dofs; below "
        "that all are. Units: none.",
        Integer(1, 1000));
    prm.add_parameter("Upper frequency", upper_frequency,
                      "Roots of higher frequency, which the modes kept may not carry, are counted but not "
                      "listed; 0: all are listed. Units: Hz.",
                      Double(0));
    prm.add_parameter("Linearise sticking points", stick,
                      "Linearise about an equilibrium that is not in full sliding: its sticking points stay "
                      "stuck; false: such "
                      "an equilibrium is refused. Units: none.",
                      Bool());
    prm.add_parameter(
        "Second count", second_count,
        "Count the unstable roots also by the argument principle on the receptances of the "
        "bodies, without eigenvalues (consistent linearisation; some ten seconds for 500 modes). "
        "Units: none.",
        Bool());
    prm.add_parameter("Roots of a sweep", roots_of_sweep,
                      "complete: all roots of each case; followed: all roots of a few cases of each row of "
                      "the sweep, and between them those that grow or may, each from the case before. "
                      "Units: none.",
                      Selection("complete|followed"));
    derivatives.declare_parameters(prm);
  }

  void StabilityParameters::check() const
  {
    if (!is_reduced() && second_count)
      throw InputError("Stability/Model is " + model +
                       ", but Second count is that of the reduced model: set it to reduced or leave it out.");
    if (is_hysteretic() && !is_reduced())
      throw InputError("Stability/Loss is hysteretic, which is that of the reduced model, but Model is " +
                       model + ": set it to reduced, or Loss to viscous.");
    if (is_hysteretic() && !is_consistent())
      throw InputError("Stability/Loss is hysteretic, which the paper's linearisation does not know: set "
                       "Linearisation to consistent, or Loss to viscous.");
    if (are_of_body_1() && (!is_hysteretic() || second_count))
      throw InputError(
          "Stability/Roots is of body 1, which is for Loss = hysteretic without Second count: set Roots "
          "to all, or these.");
    if (are_of_body_1() && follows())
      throw InputError(
          "Stability/Roots is of body 1, which is not followed from case to case: set Roots of a sweep "
          "to complete, or Roots to all.");
    derivatives.check();
    if (derivatives.any() && (!is_reduced() || !is_consistent()))
      throw InputError(
          "Stability/Derivatives are those of the reduced model in its consistent linearisation: "
          "set Model to reduced and Linearisation to consistent.");
    if (follows() && (!is_reduced() || !is_consistent() || second_count))
      throw InputError(
          "Stability/Roots of a sweep is followed, which takes the reduced model in its consistent "
          "linearisation without Second count: set Model to reduced, Linearisation to consistent "
          "and Second count to false, or it to complete.");
    if (upper_frequency > 0 && (follows() || are_of_body_1() || derivatives.any()))
      throw InputError(
          "Stability/Upper frequency is for complete lists of roots: set it to 0, or Roots to all, "
          "Roots of a sweep to complete and Derivatives/Entries to none.");
    if (second_count && !is_consistent())
      throw InputError("Stability/Second count is for the consistent linearisation: set Linearisation to "
                       "consistent, or Second count to false.");
  }

  LinearisationOptions StabilityParameters::options() const
  {
    LinearisationOptions options;
    const bool consistent = is_consistent();
    options.lateral_damping = consistent || lateral_damping;
    options.convection = consistent || convection;
    options.residual_rate = consistent;
    options.stick = stick;
    return options;
  }

  std::vector<const StabilityRoot *> StabilityResult::unstable() const
  {
    std::vector<const StabilityRoot *> result;
    for (const StabilityRoot &root : roots)
      if (root.grows())
        result.push_back(&root);
    return result;
  }

  void StabilityResult::leave_out_above(const double frequency)
  {
    const auto above =
        std::stable_partition(roots.begin(), roots.end(),
                              [frequency](const StabilityRoot &root) { return root.frequency <= frequency; });
    if (above == roots.begin())
      throw ConvergenceError("All " + std::to_string(roots.size()) +
                             " roots are above Stability/Upper frequency: raise it.");
    n_above = roots.end() - above;
    n_growing_above =
        std::count_if(above, roots.end(), [](const StabilityRoot &root) { return root.grows(); });
    roots.erase(above, roots.end());
  }

  const StabilityRoot &StabilityResult::nearest() const
  {
    return *std::max_element(roots.begin(), roots.end(),
                             [this](const StabilityRoot &a, const StabilityRoot &b)
                             {
                               const bool a_carried = a.frequency <= modes_reach,
                                          b_carried = b.frequency <= modes_reach;
                               return a_carried != b_carried ? b_carried
                                                             : a.divergence_rate < b.divergence_rate;
                             });
  }

  std::shared_ptr<const ContactOperator>
  operator_of_stability(const ContactPair &pair, const ContactSections &contact, const double speed)
  {
    return static_operator(pair, find_creep_scheme(contact.first().creep_scheme), speed);
  }

  void stability_equilibria(const RollingParameters &rolling, const ContactSections &contact,
                            const ContactSolverParameters &solver, const ContactPair &pair,
                            const std::shared_ptr<const ContactOperator> &A,
                            const std::function<void(StabilityResult &&, const RollingEquilibrium &)> &found,
                            const FailedCase &failed)
  {
    const HubKind &hub = hub_kind(rolling.hub);
    const auto take = [&](const RollingResult &equilibrium, const ContactProblem &problem)
    {
      try
      {
        if (!equilibrium.solution.converged)
          throw ConvergenceError("The equilibrium did not converge: " +
                                 (equilibrium.failure.empty()
                                      ? "residual " + number_text(equilibrium.solution.residual) + " after " +
                                            std::to_string(equilibrium.solution.iterations) +
                                            " iterations; try less friction, or another load."
                                      : equilibrium.failure));
        StabilityResult result;
        result.rolling_case = equilibrium.rolling_case;
        result.contact_points = equilibrium.contact_points;
        result.stick_points = equilibrium.stick_points;
        result.normal_force = equilibrium.normal_force;
        result.approach = equilibrium.solution.approach;
        result.contacts = equilibrium.contacts;
        result.hub = rolling.hub;
        result.modes_reach = pair.modes_reach;
        found(std::move(result),
              rolling_equilibrium(equilibrium.solution, problem.friction_law, problem.normal_law,
                                  rolling.creepage.speed,
                                  hub.keeps_force || (!hub.exists() && problem.force_given())));
      }
      catch (const ConvergenceError &error)
      {
        if (!failed)
          throw;
        const RollingCase &one = equilibrium.rolling_case;
        failed("Of creepages " + number_text(one.creepage.longitudinal) + " and " +
               number_text(one.creepage.lateral) + ", spin " + number_text(one.creepage.spin) +
               " 1/m and friction " + number_text(one.friction) + ": " + error.what());
      }
    };
    quasi_static_rolling(
        rolling, contact, solver, static_interface(pair),
        [&](const double speed) { return A ? A : operator_of_stability(pair, contact, speed); }, take);
  }

  std::vector<StabilityResult> stability(const StabilityParameters &parameters,
                                         const RollingParameters &rolling, const ContactSections &contact,
                                         const ContactSolverParameters &solver, const ContactPair &pair,
                                         const std::function<void(const StabilityResult &)> &finished,
                                         const RootFinder &roots_about, const HystereticLoss *loss,
                                         const FailedCase &failed)
  {
    const CreepScheme &scheme = find_creep_scheme(contact.first().creep_scheme);
    std::vector<StabilityResult> results;
    // the preload is no part of the linearisation
    std::shared_ptr<const ContactPair> suspended;
    std::optional<HystereticLoss> own_loss;
    if (hub_kind(rolling.hub).has_mass())
    {
      if (loss)
        loss = &own_loss.emplace(*loss);
      suspended = std::make_shared<const ContactPair>(
          suspended_pair(pair, hub_coordinates(rolling, pair), {}, own_loss ? &*own_loss : nullptr));
    }
    const ContactPair &moving = suspended ? *suspended : pair;
    const auto linearise = [&](StabilityResult &&result, const RollingEquilibrium &about)
    {
      const auto begin = WallClock::now();
      result.suspended = suspended;
      if (!parameters.is_reduced())
        result.modes_reach = std::numeric_limits<double>::infinity();
      result.roots =
          roots_about ? roots_about(about) : all_roots(moving, scheme, about, parameters.options(), loss);
      if (result.roots.empty())
        throw ConvergenceError("No root of the linearised contact oscillates or grows: keep more modes.");
      result.seconds = seconds_since(begin);
      if (parameters.second_count)
        result.second_count = count_unstable_roots(pair, scheme, about, result.roots, loss);
      if (parameters.upper_frequency > 0)
        result.leave_out_above(parameters.upper_frequency);
      results.push_back(std::move(result));
      finished(results.back());
    };
    stability_equilibria(rolling, contact, solver, pair, nullptr, linearise, failed);
    return results;
  }
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/marching/step_levels.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// the error of a step is of third order: twice the step has eight times as much
    constexpr double growth_of_error = 8;

    unsigned int count_levels(const TransientParameters &parameters)
    {
      return parameters.adapts_steps()
                 ? 1 + std::ceil(std::log2(parameters.time_step / parameters.shortest_step) - 1e-9)
                 : 1;
    }
  } // namespace

  std::vector<ModalStep> modal_steps(const TransientParameters &parameters, const ContactPair &pair,
                                     const double h)
  {
    const ReactionWeighting weighting = parameters.reacts_at_end_of_step()
                                            ? ReactionWeighting::end_of_step
                                            : ReactionWeighting::as_other_forces;
    std::vector<ModalStep> steps;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      steps.push_back(parameters.propagates_exactly()
                          ? exact_step(pair.omega[k], pair.damping_ratio[k], h, weighting)
                          : theta_step(pair.omega[k], pair.damping_ratio[k], parameters.theta, h, weighting));
    return steps;
  }

  StepWeights pole_steps(const TransientParameters &parameters, const ContactPair &pair, const double h)
  {
    const ForceInterpolation interpolation =
        parameters.reacts_at_end_of_step() ? ForceInterpolation::constant : ForceInterpolation::linear;
    return parameters.propagates_exactly() ? step_weights(pair, h, interpolation)
                                           : theta_weights(pair, h, interpolation, parameters.theta);
  }

  StepLevels::StepLevels(const TransientParameters &parameters, const ContactSections &contact,
                         const ContactSolverParameters &solver, const ContactPair &pair, const double speed)
      : parameters(parameters), contact(contact), solver(solver), pair(pair), speed(speed),
        levels(count_levels(parameters))
  {
    if (n_levels() > 1 && pair.n_modes() == 0)
      throw InputError("Entry Transient/Error tolerance judges the motion of modes, but no body has any: set "
                       "it to 0 and give the Time step.");
    if (n_levels() > 1 && pair.n_poles() > 0)
      throw InputError("Entry Transient/Error tolerance judges the motion of modes, but " +
                       pair.labels[pair.n_modes()] + " is a pole: set it to 0 and give the Time step.");
    shortest_step = std::ldexp(parameters.time_step, 1 - static_cast<int>(n_levels()));
  }

  long long StepLevels::tick(const DynamicState &state) const
  {
    return std::llround(state.time / shortest_step);
  }

  StepLevels::Level &StepLevels::level(const unsigned int k)
  {
    if (!levels[k])
    {
      const double h = std::ldexp(shortest_step, k);
      levels[k].reset(new Level{{pair, find_creep_scheme(contact.first().creep_scheme), contact,
                                 modal_steps(parameters, pair, h), h, speed, pole_steps(parameters, pair, h),
                                 nullptr, parameters.residual_theta},
                                nullptr});
    }
    if (!levels[k]->solver)
      levels[k]->solver = create_contact_solver(solver);
    return *levels[k];
  }

  void StepLevels::start_afresh()
  {
    for (const auto &one : levels)
      if (one)
        one->solver.reset();
  }

  void StepLevels::advance(const DynamicState &state, const DriveFunction &drive, const long long last,
                           DynamicState &next, Drive &then, TransientResult &result)
  {
    const long long now = tick(state);
    unsigned int k = result.level;
    while (k > 0 && (now % (1ll << k) != 0 || now + (1ll << k) > last))
      --k;
    double error = 0;
    for (;; --k, ++result.rejected)
    {
      const double time = (now + (1ll << k)) * shortest_step;
      then = drive(time);
      next = state;
      Level &used = level(k);
      const ContactSolution &solution = used.stepper.advance(next, then, *used.solver);
      next.time = time;
      result.iterations += solution.iterations;
      result.factorisations += solution.factorisations;
      result.fallbacks += solution.fallbacks;
      result.converged = solution.converged;
      error = parameters.adapts_steps() && result.converged ? step_error(parameters, pair, state, next) : 0;
      if (k == 0 || (result.converged && error <= parameters.error_tolerance))
        break;
    }
    result.above_tolerance += result.converged && error > parameters.error_tolerance;
    if (!result.converged)
      result.message =
          std::string("the contact of the next step did not converge; take a smaller Transient/") +
          (n_levels() > 1 ? "Shortest time step" : "Time step");
    result.level = k;
    if (k + 1 < n_levels() && growth_of_error * error <= 0.5 * parameters.error_tolerance)
      ++result.level;
  }

  double step_error(const TransientParameters &parameters, const ContactPair &pair,
                    const DynamicState &before, const DynamicState &after)
  {
    const bool exact = parameters.propagates_exactly();
    const double h = after.time - before.time;
    double error = 0, size = 0;
    const auto dampers = [&](const DynamicState &state)
    { return pair.hub ? pair.hub->damping_force(state.v) : std::vector<double>(); };
    const std::vector<double> dampers_before = dampers(before), dampers_after = dampers(after);
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      const double w = pair.omega[k];
      const auto force = [&](const DynamicState &state)
      {
        return pair.modal_load[k] + pair.hub_participation(k) * state.hub_acceleration +
               pair.force_participation(k) * state.force + state.modal_force[k] -
               (pair.hub ? pair.hub->modal_force(&state == &after ? dampers_after : dampers_before, k) : 0.);
      };
      const auto acceleration = [&](const DynamicState &state)
      { return force(state) - 2 * pair.damping_ratio[k] * w * state.v[k] - w * w * state.q[k]; };
      const double a = acceleration(after);
      double dq = h * h / 12 * std::abs(exact ? force(after) - force(before) : a - acceleration(before));
      if (!exact)
        dq += (parameters.theta - 0.5) * h * std::abs(after.v[k] - before.v[k]);
      error += w * w * dq * dq;
      size += after.v[k] * after.v[k] + (w > 0 ? a * a / (w * w) : 0);
    }
    return size > 0 ? std::sqrt(error / size) : 0;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/step_ladder.h>
#include <vibrocontact/analyses/transient.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  unsigned int perturbed_mode(const TransientParameters &transient, const std::vector<std::string> &labels)
  {
    if (transient.perturbed_mode.empty())
      return labels.size();
    std::string name = transient.perturbed_mode;
    std::replace(name.begin(), name.end(), '/', '#');
    const auto found = std::find(labels.begin(), labels.end(), name);
    if (found != labels.end())
      return found - labels.begin();
    std::vector<std::string> known(labels);
    for (std::string &label : known)
      std::replace(label.begin(), label.end(), '#', '/');
    throw InputError("Transient/Perturbed mode names '" + transient.perturbed_mode +
                     "', but there is no such mode; " + name_suggestion(transient.perturbed_mode, known));
  }

  namespace
  {
    void perturb(const TransientParameters &parameters, const ContactPair &pair, DynamicState &state)
    {
      const unsigned int k = perturbed_mode(parameters, pair.labels);
      if (k == pair.n_modes())
        return;
      double largest = 0;
      for (unsigned int i = 0; i < pair.modal_trace.m(); ++i)
        largest = std::max(largest, std::abs(pair.modal_trace(i, k)));
      if (!(largest > 0))
        throw InputError("Transient/Perturbed mode: '" + parameters.perturbed_mode +
                         "' does not move the contact; name another mode.");
      state.q[k] += parameters.perturbation / largest;
      state.v[k] += parameters.perturbation_velocity / largest;
    }
  } // namespace

  DynamicState initial_state(const TransientParameters &transient, const ContactParameters &contact,
                             const ContactSolverParameters &solver, const ContactPair &pair,
                             const Drive &drive)
  {
    const unsigned int n = pair.n_points(), n_modes = pair.n_modes();
    DynamicState state;
    state.contact.approach = drive.approach;
    state.hub_acceleration = drive.hub_acceleration;
    state.force = drive.force;
    state.q.assign(n_modes, 0.);
    state.v.assign(n_modes, 0.);
    state.R.reinit(3 * n);
    if (transient.initial_state == "undeformed")
    {
      for (unsigned int k = 0; k < n_modes; ++k)
        if (pair.body[k] == 1)
        {
          state.q[k] = pair.participation(k, 2) * transient.initial_gap;
          state.v[k] = pair.participation(k, 2) * transient.initial_velocity;
        }
    }
    else
    {
      const CreepScheme &scheme = find_creep_scheme(contact.creep_scheme);
      ContactProblem problem = rolling_problem(
          rolling_operator(pair.interface.grid, static_compliance(pair), scheme, drive.creepage.speed),
          static_interface(pair), scheme, drive.creepage, contact);
      problem.title = "equilibrium from which the transient starts";
      problem.normal_force = drive.normal_force;
      problem.approach = drive.approach;
      for (unsigned int i = 0; i < drive.gap.size(); ++i)
        problem.b[i] += drive.gap[i];
      for (unsigned int i = 0; i < n && drive.force != 0; ++i)
      {
        problem.b[i] += pair.force_response(i) * drive.force;
        for (unsigned int k = 0; k < n_modes; ++k)
          problem.b[i] += pair.modal_trace(i, k) * pair.force_participation(k) * drive.force /
                          (pair.omega[k] * pair.omega[k]);
      }
      const auto method = create_contact_solver(solver);
      state.contact =
          contact.falling.acts()
              ? solve_with_falling_friction(problem, *method, {}, contact.falling, contact.friction,
                                            [](const ContactSolution &now) { return slip_speed(now.y); })
              : method->solve(problem, {});
      if (!state.contact.converged)
      {
        std::ostringstream text;
        text << "The quasi-static equilibrium from which the transient starts did not converge: residual "
             << state.contact.residual << " after " << state.contact.iterations << " iterations.";
        throw ConvergenceError(text.str());
      }
      if (n > 1)
        check_contact_in_grid(pair.interface.grid, state.contact.status);
      state.R = state.contact.R;
      DenseVector force(n_modes);
      if (n_modes > 0)
        pair.modal_trace.Tvmult(force, state.R);
      for (unsigned int k = 0; k < n_modes; ++k)
        state.q[k] = (force[k] + pair.modal_load[k] + pair.force_participation(k) * drive.force) /
                     (pair.omega[k] * pair.omega[k]);
    }
    perturb(transient, pair, state);
    complete(pair, rigid_slip(pair.interface.grid, find_creep_scheme(contact.creep_scheme), drive.creepage),
             state);
    return state;
  }

  namespace
  {
    double seconds_since(const std::chrono::steady_clock::time_point &begin)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
  } // namespace

  TransientResult transient(const TransientParameters &parameters, const ContactParameters &contact,
                            const ContactSolverParameters &solver, const ContactPair &pair,
                            const DriveFunction &drive, DynamicState &state,
                            const std::function<bool(const DynamicState &, const TransientResult &)> &observe,
                            const TransientResult &before)
  {
    const auto begin = std::chrono::steady_clock::now();
    const unsigned int n = pair.n_points();
    const auto law = contact.law();
    const CreepScheme &scheme = find_creep_scheme(contact.creep_scheme);
    Drive now = drive(state.time);
    StepLadder ladder(parameters, contact, solver, pair, now.creepage.speed);

    TransientResult result = before;
    if (result.steps == 0)
    {
      result.energy.initial = result.energy.stored = stored_energy(pair, *law, state);
      result.rung = ladder.n_rungs() - 1;
    }
    // never beyond the end, where tables may stop
    const long long last = std::floor(parameters.end_time / ladder.shortest() + 1e-6);
    DynamicState next = state;
    Drive then;
    while (ladder.tick(state) < last)
    {
      if (result.steps % steps_between_fresh_starts == 0)
        ladder.start_afresh();
      try
      {
        ladder.advance(state, drive, last, next, then, result);
        if (n > 1)
          check_contact_in_grid(pair.interface.grid, next.contact.status);
      }
      // what was computed so far is kept, whoever gives up
      catch (const InputError &error)
      {
        result.converged = false;
        result.message = error.what();
      }
      catch (const ConvergenceError &error)
      {
        result.converged = false;
        result.message = error.what();
      }
      if (!result.converged)
        break;
      ++result.steps;
      result.time = next.time;
      const double h = next.time - state.time;
      for (unsigned int i = 0; i < n; ++i)
      {
        result.impulse += h * (state.R[i] + next.R[i]) / 2;
        result.smallest_gap = std::min(result.smallest_gap, next.contact.y[i]);
      }
      add_step(result.energy, pair, *law, scheme, state, now, next, then);
      state = next;
      now = then;
      if (result.steps % steps_between_fresh_starts == 0)
        result.seconds = before.seconds + seconds_since(begin);
      if (!observe(state, result))
        break;
    }
    result.seconds = before.seconds + seconds_since(begin);
    return result;
  }
} // namespace vibrocontact

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
  void TransientParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Time step", time_step, "Length of a step. Units: s.", Double(1e-12, 1e3));
    prm.add_parameter(
        "Error tolerance", error_tolerance,
        "0: all steps have the length Time step. Otherwise the step is halved, down to Shortest time "
        "step, while the error of the modes in one step over the size of their vibration is "
        "larger, and doubled again, up to Time step. Units: none.",
        Double(0, 1));
    prm.add_parameter("Shortest time step", shortest_step, "With an Error tolerance. Units: s.",
                      Double(0, 1e3));
    prm.add_parameter("End time", end_time, "The run goes from 0 to this time. Units: s.", Double(0, 1e9));
    prm.add_parameter("Integrator", integrator,
                      "Of the modes: Jean's theta-method, or their exact solution over a step. Units: none.",
                      Selection("theta method|exact propagator"));
    prm.add_parameter(
        "Theta", theta,
        "Of the theta-method: 1/2 has no numerical damping, more subtracts (theta - 1/2) omega^2 h from "
        "the growth rate of every mode. Units: none.",
        Double(0.5, 1));
    prm.add_parameter(
        "Reaction", reaction,
        "The contact force within a step: weighted as other forces (linear for the exact propagator), or "
        "its value at the end of the step alone, as the paper has it. Units: none.",
        Selection("as other forces|end of step"));
    prm.add_parameter(
        "Initial state", initial_state,
        "The equilibrium of section Rolling, or both bodies without stress and apart. Units: none.",
        Selection("quasi-static|undeformed"));
    prm.add_parameter("Initial gap", initial_gap, "Of undeformed bodies. Units: m.", Double(0, 1e6));
    prm.add_parameter("Initial velocity", initial_velocity,
                      "Of body 1 as a whole along z, negative towards body 2; undeformed only. Units: m/s.",
                      Double(-1e6, 1e6));
    prm.add_parameter(
        "Perturbed mode", perturbed_mode,
        "Mode that the initial state is perturbed by, as body:label, for instance wheel:axial(0,2); the "
        "second of a "
        "pair, axial(0,2)#2 in tables, is written axial(0,2)/2, for # begins a comment; empty: none. Units: "
        "none.",
        Anything());
    prm.add_parameter("Perturbation", perturbation,
                      "Largest displacement of this mode in the contact. Units: m.", Double(-1, 1));
    prm.add_parameter("Perturbation velocity", perturbation_velocity,
                      "Largest velocity of this mode in the contact. Units: m/s.", Double(-1e3, 1e3));
    const auto expression = [&](const std::string &name, std::string &value, const std::string &unit)
    {
      prm.add_parameter(name, value,
                        "Expression of the time t that replaces Rolling/" + name +
                            "; empty: constant. Units: " + unit + ".",
                        Anything());
    };
    expression("Longitudinal creepage", longitudinal_creepage, "none");
    expression("Lateral creepage", lateral_creepage, "none");
    expression("Spin", spin, "1/m");
    expression("Normal force", normal_force, "N");
    expression("Hub displacement", hub_displacement, "m");
    prm.add_parameter("Drive table", drive_table,
                      "CSV file with the column time_s and any of longitudinal_creepage, lateral_creepage, "
                      "spin_1_m, normal_force_N, hub_displacement_m, which replace the constants of section "
                      "Rolling; linear in between; it has to cover the run; empty: none. Units: none.",
                      FileName());
    prm.enter_subsection("Roughness");
    roughness.declare_parameters(prm);
    prm.leave_subsection();
    prm.add_parameter("History interval", history_interval,
                      "Distance of the lines of the histories; 0: every step. Units: s.", Double(0, 1e9));
    prm.add_parameter("Checkpoint interval", checkpoint_interval,
                      "Wall time between checkpoints, from which --resume continues; 0: only when the run is "
                      "stopped and at its end. Units: s.",
                      Double(0, 1e9));
  }

  void TransientParameters::check() const
  {
    if (initial_state == "quasi-static" && (initial_gap != 0 || initial_velocity != 0))
      throw InputError(
          "Section Transient gives an initial gap or velocity, but its Initial state is quasi-static: set it "
          "to undeformed.");
    if (!normal_force.empty() && !hub_displacement.empty())
      throw InputError("Section Transient gives expressions of both Normal force and Hub displacement: empty "
                       "one of them.");
    if (error_tolerance > 0 &&
        !(shortest_step > 0 && shortest_step <= time_step && shortest_step >= 1e-6 * time_step))
      throw InputError(
          "Section Transient gives an Error tolerance, for which the Shortest time step has to be "
          "between a millionth of the Time step and the Time step: give it.");
    roughness.check();
    if (perturbed_mode.empty() && (perturbation != 0 || perturbation_velocity != 0))
      throw InputError("Section Transient gives a perturbation, but no Perturbed mode: name one.");
  }

  std::vector<ModalStep> modal_steps(const TransientParameters &parameters, const ContactPair &pair,
                                     const double h)
  {
    const ReactionWeighting weighting = parameters.reaction == "end of step"
                                            ? ReactionWeighting::end_of_step
                                            : ReactionWeighting::as_other_forces;
    std::vector<ModalStep> steps;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      steps.push_back(parameters.integrator == "exact propagator"
                          ? exact_step(pair.omega[k], pair.damping_ratio[k], h, weighting)
                          : theta_step(pair.omega[k], pair.damping_ratio[k], parameters.theta, h, weighting));
    return steps;
  }

  namespace
  {
    void perturb(const TransientParameters &parameters, const ContactPair &pair, DynamicState &state)
    {
      if (parameters.perturbed_mode.empty())
        return;
      std::string name = parameters.perturbed_mode;
      std::replace(name.begin(), name.end(), '/', '#');
      const auto found = std::find(pair.labels.begin(), pair.labels.end(), name);
      if (found == pair.labels.end())
        throw InputError("Entry Transient/Perturbed mode names '" + parameters.perturbed_mode +
                         "', but there is no such mode; " +
                         name_suggestion(parameters.perturbed_mode, pair.labels) + ".");
      const unsigned int k = found - pair.labels.begin();
      double largest = 0;
      for (unsigned int i = 0; i < pair.modal_trace.m(); ++i)
        largest = std::max(largest, std::abs(pair.modal_trace(i, k)));
      if (!(largest > 0))
        throw InputError("Entry Transient/Perturbed mode: '" + parameters.perturbed_mode +
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
      problem.normal_force = drive.normal_force;
      problem.approach = drive.approach;
      for (unsigned int i = 0; i < drive.gap.size(); ++i)
        problem.b[i] += drive.gap[i];
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
        state.q[k] = (force[k] + pair.modal_load[k]) / (pair.omega[k] * pair.omega[k]);
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

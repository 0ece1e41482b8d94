#include <vibrocontact/analyses/transient.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>

#include <deal.II/base/function_parser.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>

namespace vibrocontact
{
  void TransientParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Time step", time_step, "Length of a step. Units: s.", Double(1e-12, 1e3));
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
        "Mode that the initial state is perturbed by, as body:label, for instance wheel:axial(0,2); empty: "
        "none. Units: none.",
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
    if (perturbed_mode.empty() && (perturbation != 0 || perturbation_velocity != 0))
      throw InputError("Section Transient gives a perturbation, but no Perturbed mode: name one.");
  }

  namespace
  {
    /// Nothing reaches standard error while it lives.
    struct QuietErrors
    {
      QuietErrors() : kept(std::cerr.rdbuf(nullptr)) {}
      ~QuietErrors()
      {
        std::cerr.rdbuf(kept);
        std::cerr.clear();
      }
      std::streambuf *const kept;
    };

    std::function<double(double)> function_of_time(const std::string &expression, const std::string &entry,
                                                   const double constant)
    {
      if (expression.empty())
        return [constant](double) { return constant; };
      const auto parser = std::make_shared<dealii::FunctionParser<1>>();
      const QuietErrors quiet; // deal.II prints the parser's words itself
      try
      {
        parser->initialize("t", expression, {{"pi", dealii::numbers::PI}}, false);
        parser->value(dealii::Point<1>(0.));
      }
      catch (const dealii::ExceptionBase &)
      {
        throw InputError("Entry Transient/" + entry + " is '" + expression +
                         "', which is no expression of the time t: write for instance 0.002*min(t/0.01,1).");
      }
      return [parser](const double t) { return parser->value(dealii::Point<1>(t)); };
    }
  } // namespace

  DriveFunction drive_function(const TransientParameters &transient, const RollingCase &constant)
  {
    const auto longitudinal = function_of_time(transient.longitudinal_creepage, "Longitudinal creepage",
                                               constant.creepage.longitudinal),
               lateral = function_of_time(transient.lateral_creepage, "Lateral creepage",
                                          constant.creepage.lateral),
               spin = function_of_time(transient.spin, "Spin", constant.creepage.spin),
               force = function_of_time(transient.normal_force, "Normal force", constant.normal_force),
               hub = function_of_time(transient.hub_displacement, "Hub displacement",
                                      constant.hub_displacement);
    const bool by_force =
        !transient.normal_force.empty() || (transient.hub_displacement.empty() && constant.normal_force > 0);
    return [=, speed = constant.creepage.speed](const double t)
    {
      Drive drive;
      drive.creepage = {speed, longitudinal(t), lateral(t), spin(t)};
      if (by_force)
      {
        drive.normal_force = force(t);
        if (!(drive.normal_force > 0))
        {
          std::ostringstream text;
          text << "Entry Transient/Normal force is " << drive.normal_force << " N at t = " << t
               << " s, but it has to be positive: a contact that opens is moved by Hub displacement.";
          throw InputError(text.str());
        }
      }
      else
        drive.approach = hub(t);
      return drive;
    };
  }

  std::vector<ModalStep> modal_steps(const TransientParameters &parameters, const ContactPair &pair)
  {
    const ReactionWeighting weighting = parameters.reaction == "end of step"
                                            ? ReactionWeighting::end_of_step
                                            : ReactionWeighting::as_other_forces;
    std::vector<ModalStep> steps;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      steps.push_back(parameters.integrator == "exact propagator"
                          ? exact_step(pair.omega[k], pair.damping_ratio[k], parameters.time_step, weighting)
                          : theta_step(pair.omega[k], pair.damping_ratio[k], parameters.theta,
                                       parameters.time_step, weighting));
    return steps;
  }

  namespace
  {
    void perturb(const TransientParameters &parameters, const ContactPair &pair, DynamicState &state)
    {
      if (parameters.perturbed_mode.empty())
        return;
      const auto found = std::find(pair.labels.begin(), pair.labels.end(), parameters.perturbed_mode);
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
      state.contact = create_contact_solver(solver)->solve(problem, {});
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
                            const ContactSolverParameters &solver_parameters, const ContactPair &pair,
                            const DriveFunction &drive, DynamicState &state,
                            const std::function<bool(const DynamicState &, const TransientResult &)> &observe,
                            const TransientResult &before)
  {
    const auto begin = std::chrono::steady_clock::now();
    const CreepScheme &scheme = find_creep_scheme(contact.creep_scheme);
    const double h = parameters.time_step;
    const unsigned int n = pair.n_points();
    std::unique_ptr<ContactSolver> solver;
    Drive now = drive(state.time);
    ContactStepper stepper(pair, scheme, contact, modal_steps(parameters, pair), h, now.creepage.speed);

    TransientResult result = before;
    const auto law = contact.law();
    if (result.steps == 0)
      result.energy.initial = result.energy.stored = stored_energy(pair, *law, state);
    const auto first = std::llround(state.time / h), last = std::llround(parameters.end_time / h);
    DynamicState next = state;
    for (auto step = first; step < last; ++step)
    {
      if (!solver || result.steps % steps_between_fresh_starts == 0)
        solver = create_contact_solver(solver_parameters);
      const Drive then = drive((step + 1) * h);
      const ContactSolution &contact_solution = stepper.advance(next, then, *solver);
      next.time = (step + 1) * h;
      result.iterations += contact_solution.iterations;
      result.factorisations += contact_solution.factorisations;
      result.fallbacks += contact_solution.fallbacks;
      result.converged = contact_solution.converged;
      if (!result.converged)
      {
        result.message = "the contact of the next step did not converge; take a smaller Transient/Time step";
        break;
      }
      try
      {
        if (n > 1)
          check_contact_in_grid(pair.interface.grid, contact_solution.status);
      }
      catch (const InputError &error)
      {
        result.converged = false;
        result.message = error.what();
        break;
      }
      ++result.steps;
      result.time = next.time;
      for (unsigned int i = 0; i < n; ++i)
      {
        result.impulse += h * (state.R[i] + next.R[i]) / 2;
        result.smallest_gap = std::min(result.smallest_gap, contact_solution.y[i]);
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

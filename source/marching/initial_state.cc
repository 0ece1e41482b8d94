#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/label_text.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>
#include <vibrocontact/marching/initial_state.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
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
      label = label_in_a_file(label);
    throw InputError("Transient/Perturbed mode names '" + transient.perturbed_mode +
                     "', but there is no such mode; " + name_suggestion(transient.perturbed_mode, known));
  }

  namespace
  {
    void perturb(const TransientParameters &parameters, const ContactPair &pair, DynamicState &state)
    {
      const unsigned int k = perturbed_mode(parameters, pair.labels_of_modes());
      if (k == pair.n_modes())
        return;
      double largest = 0;
      for (unsigned int i = 0; i < pair.trace.m(); ++i)
        largest = std::max(largest, std::abs(pair.trace(i, k)));
      if (!(largest > 0))
        throw InputError("Transient/Perturbed mode: '" + parameters.perturbed_mode +
                         "' does not move the contact; name another mode.");
      state.q[k] += parameters.perturbation / largest;
      state.v[k] += parameters.perturbation_velocity / largest;
    }
  } // namespace

  void check_theta_keeps_mode(const TransientParameters &parameters, const ContactPair &pair)
  {
    constexpr double most_lost = 0.2;
    const unsigned int k = perturbed_mode(parameters, pair.labels_of_modes());
    if (k >= pair.n_modes() || parameters.adapts_steps())
      return;
    const double omega = pair.omega[k], zeta = pair.damping_ratio[k];
    const double taken = parameters.growth_taken_by_theta(omega, parameters.time_step),
                 least = std::max(zeta * omega, -std::log(1 - most_lost) / parameters.end_time);
    if (taken <= least)
      return;
    throw InputError(
        "Transient/Theta is " + number_text(parameters.theta) + ", so that the steps take " +
        number_text(taken) + " 1/s from the growth of " + parameters.perturbed_mode + " at " +
        number_text(omega / (2 * dealii::numbers::PI)) + " Hz, more than its own damping, " +
        number_text(zeta * omega) +
        " 1/s: set Theta to 0.5 or Integrator to exact propagator, or take a Transient/Time step of " +
        number_text(0.99 * parameters.time_step * least / taken) + " s.");
  }

  ContactSolution transient_equilibrium(const ContactSections &contact, const ContactSolverParameters &solver,
                                        const ContactPair &pair, const Drive &drive)
  {
    const unsigned int n = pair.n_points(), n_modes = pair.n_modes();
    const CreepScheme &scheme = find_creep_scheme(contact.first().creep_scheme);
    ContactProblem problem = rolling_problem(static_operator(pair, scheme, drive.creepage.speed),
                                             static_interface(pair), scheme, drive.creepage, contact);
    problem.title = "equilibrium that the motion starts from";
    problem.normal_force = drive.normal_force;
    problem.approach = drive.approach;
    for (unsigned int i = 0; i < drive.gap.size(); ++i)
      problem.b[i] += drive.gap[i];
    for (unsigned int i = 0; i < n && drive.force != 0; ++i)
    {
      problem.b[i] += pair.force_response(i) * drive.force;
      for (unsigned int k = 0; k < n_modes; ++k)
        problem.b[i] +=
            pair.trace(i, k) * pair.force_participation(k) * drive.force / (pair.omega[k] * pair.omega[k]);
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
        problem.b[i] -= 2 * (pair.right(i, k) * pair.force_into_pole(k) / pair.poles[k]).real() * drive.force;
    }
    const auto method = create_contact_solver(solver);
    ContactSolution solution;
    solve_with_friction_of_speed(problem, *method, solution);
    if (!solution.converged)
    {
      std::ostringstream text;
      text << "The quasi-static equilibrium that the motion starts from did not converge: residual "
           << solution.residual << " after " << solution.iterations
           << " iterations: try less friction, or another load, and see quasi-static rolling alone.";
      throw ConvergenceError(text.str());
    }
    check_contact_in_grid(pair.interface.contacts, contact, drive.creepage.speed, solution.status);
    return solution;
  }

  DynamicState initial_state(const TransientParameters &transient, const ContactSections &contact,
                             const ContactSolverParameters &solver, const ContactPair &pair,
                             const Drive &drive, const ContactSolution *const loaded)
  {
    const unsigned int n = pair.n_points(), n_modes = pair.n_modes();
    DynamicState state;
    state.contact.approach = drive.approach;
    state.hub_acceleration = drive.hub_acceleration;
    state.force = drive.force;
    state.q.assign(n_modes, 0.);
    state.v.assign(n_modes, 0.);
    state.z.assign(pair.n_poles(), 0.);
    state.R.reinit(3 * n);
    if (transient.starts_undeformed())
    {
      state.relaxed.assign(pair.relaxing.size(), DenseVector(3 * n));
      for (unsigned int k = 0; k < n_modes; ++k)
        if (pair.body[k] == 1)
        {
          state.q[k] = pair.participation(k, 2) * transient.initial_gap;
          state.v[k] = pair.participation(k, 2) * transient.initial_velocity;
        }
    }
    else
    {
      // rests have relaxed: complete()
      state.contact = loaded ? *loaded : transient_equilibrium(contact, solver, pair, drive);
      state.R = state.contact.R;
      DenseVector force(n_modes);
      if (n_modes > 0)
        pair.trace.Tvmult(force, state.R);
      for (unsigned int k = 0; k < n_modes; ++k)
        state.q[k] = (force[k] + pair.modal_load[k] + pair.force_participation(k) * drive.force) /
                     (pair.omega[k] * pair.omega[k]);
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
      {
        state.z[k] = pair.pole_load[k] + pair.force_into_pole(k) * drive.force;
        for (unsigned int i = 0; i < 3 * n; ++i)
          state.z[k] += pair.left(i, k) * state.R[i];
        state.z[k] /= -pair.poles[k];
      }
    }
    perturb(transient, pair, state);
    complete(
        pair,
        rigid_slip(pair.interface.contacts, find_creep_scheme(contact.first().creep_scheme), drive.creepage),
        state);
    return state;
  }
} // namespace vibrocontact

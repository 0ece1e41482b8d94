#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/contact/point_rows.h>
#include <vibrocontact/marching/contact_stepper.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// to += from, which deal.II does not take of empty vectors (no modes, no points)
    void add(const DenseVector &from, DenseVector &to)
    {
      if (to.size() > 0)
        to += from;
    }

    /// shapes^T forces of complex shapes, whose parts stand side by side as 2 Re, -2 Im
    std::vector<std::complex<double>> shares(const DenseMatrix &parts, const DenseVector &forces)
    {
      const unsigned int n = parts.n() / 2;
      std::vector<std::complex<double>> result(n);
      if (n == 0)
        return result;
      DenseVector both(2 * n);
      parts.Tvmult(both, forces);
      for (unsigned int k = 0; k < n; ++k)
        result[k] = {both[k] / 2, -both[n + k] / 2};
      return result;
    }
  } // namespace

  ContactStepper::ContactStepper(const ContactPair &pair, const CreepScheme &scheme,
                                 const ContactSections &contact, const std::vector<ModalStep> &steps,
                                 const double h, const double speed, const StepWeights &pole_steps,
                                 const PatchShapes *const shapes, const double residual_theta)
      : pair(pair), scheme(scheme), steps(steps), pole_steps(pole_steps), h(h), speed(speed),
        damper(pair.hub.get(), steps), matrices(step_matrices(scheme, pair, steps, h, speed, pair.hub.get(),
                                                              pole_steps, shapes, residual_theta)),
        proximity(pair, matrices, constant_response, by_approach), q(pair.n_modes()), v(pair.n_modes()),
        z(pair.n_poles())
  {
    for (const RelaxingRest &rest : pair.relaxing)
      kept.push_back(rest.relaxation / (h + rest.relaxation));
    Creepage none;
    none.speed = speed;
    const ContactProblem whole = rolling_problem(nullptr, pair.interface, scheme, none, contact);
    constant_response = whole.b;
    problem.title = "step of the transient";
    normal_laws = whole.normal_law;
    friction_laws = whole.friction_law;
    friction = whole.mu;
    to_force = whole.to_force;
    // a hub that moves slips along a contact whose normal is inclined to it
    by_approach = to_force;
    for (unsigned int row = pair.n_points(); row < by_approach.size(); ++row)
      by_approach[row] /= h;
    for (DenseVector *const x : {&free_displacement, &free_velocity, &displacement, &velocity, &c_n, &c_t})
      x->reinit(matrices.shapes.rank());
  }

  void ContactStepper::set_displacement(const DynamicState &state)
  {
    std::copy(state.q.begin(), state.q.end(), q.begin());
    displacement = 0;
    multiply(matrices.shapes.amplitudes, q, displacement);
    add_poles(state.z, {}, displacement, nullptr);
  }

  void ContactStepper::take_points(const std::vector<unsigned int> &points)
  {
    if (step_operator && step_operator->points() == points)
      return;
    step_operator = std::make_shared<StepOperator>(matrices, points);
    problem.A = step_operator;
    problem.mu.clear();
    for (const unsigned int i : points)
      problem.mu.push_back(friction[i]);
    problem.normal_law = normal_laws.at(points);
    problem.friction_law = friction_laws.at(points);
    problem.by_approach = on_points(by_approach, points);
    problem.to_force = on_points(to_force, points);
    problem.b.reinit(step_operator->n_response_rows());
  }

  void ContactStepper::set_end_of_shapes()
  {
    step_operator->modal_numbers(solution.R, c_n, c_t);
    add(c_t, c_n);
    multiply(matrices.displacement_gain, c_n, displacement);
    multiply(matrices.velocity_gain, c_n, velocity);
    add(free_displacement, displacement);
    add(free_velocity, velocity);
  }

  bool ContactStepper::closes_another(DynamicState &state, const double force)
  {
    if (step_operator->other_points().empty())
      return false;
    proximity.set_gaps(state, displacement, solution.approach, force, gaps);
    proximity.note_motion(state, *step_operator, solution);
    if (!solution.converged || !proximity.may_close_another(state, *step_operator, gaps))
      return false;
    const std::vector<unsigned int> &points = step_operator->points();
    step_operator->residual_gaps_of_others(solution.R, residual_of_others);
    add_kept(state, force, step_operator->other_points(), residual_of_others.begin());
    std::vector<unsigned int> closed =
        proximity.look_at_others(state, *step_operator, residual_of_others, gaps);
    if (closed.empty())
      return false;
    closed.insert(closed.end(), points.begin(), points.end());
    set_displacement(state);
    proximity.search(state, displacement);
    closed.insert(closed.end(), state.nearby.begin(), state.nearby.end());
    std::sort(closed.begin(), closed.end());
    closed.erase(std::unique(closed.begin(), closed.end()), closed.end());
    state.nearby = closed;
    return true;
  }

  const ContactSolution &ContactStepper::advance(DynamicState &state, const Drive &drive,
                                                 ContactSolver &solver)
  {
    if (state.contact.empty())
    {
      state.contact.R = state.R;
      state.contact.y.reinit(3 * pair.n_points());
      state.contact.status.assign(pair.n_points(), ContactStatus::open);
    }
    state.roughness = drive.gap;
    if (proximity.search_is_due(state))
    {
      set_displacement(state);
      proximity.search(state, displacement);
    }

    const DenseVector rigid = rigid_slip(pair.interface.contacts, scheme, drive.creepage);
    SolverCost cost;
    do
    {
      take_points(state.nearby);
      advance_modes(state, drive);
      set_problem(state, drive, rigid);
      if (problem.friction_law.any(&FrictionLaw::depends_on_speed))
        solve_with_modal_slip_in_friction(state, solver);
      else
        solver.solve(problem, solution);
      cost += solution.cost();
      set_end_of_shapes();
    } while (closes_another(state, drive.force));
    solution.cost() = cost;
    take_over(state, rigid);
    state.hub_acceleration = drive.hub_acceleration;
    state.force = drive.force;
    for (unsigned int k = 0; k < kept.size(); ++k)
      state.relaxed[k].sadd(kept[k], 1 - kept[k], forces_on_rest(pair, k, state));
    return state.contact;
  }

  void ContactStepper::add_poles(const std::vector<std::complex<double>> &states,
                                 const std::vector<std::complex<double>> &feed, DenseVector &displacements,
                                 DenseVector *const velocities) const
  {
    const unsigned int n = states.size();
    if (n == 0)
      return;
    DenseVector parts(2 * n);
    const auto add = [&](const auto &state, DenseVector &to)
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        const std::complex<double> z = state(k);
        parts[k] = z.real();
        parts[n + k] = z.imag();
      }
      matrices.by_poles.vmult(to, parts, true);
    };
    add([&](const unsigned int k) { return states[k]; }, displacements);
    if (velocities)
      add([&](const unsigned int k) { return pair.poles[k] * states[k] + feed[k]; }, *velocities);
  }

  // modes under the forces of the beginning of the step and the constant loads
  void ContactStepper::advance_modes(const DynamicState &state, const Drive &drive)
  {
    const std::vector<double> dampers = pair.hub ? pair.hub->damping_force(state.v) : std::vector<double>();
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      const ModalStep &s = steps[k];
      const double hub = pair.hub_participation(k), point = pair.force_participation(k);
      const double p1 = pair.modal_load[k] + hub * drive.hub_acceleration + point * drive.force,
                   p0 = pair.modal_load[k] + hub * state.hub_acceleration + point * state.force +
                        state.modal_force[k] - (pair.hub ? pair.hub->modal_force(dampers, k) : 0.);
      q[k] = s.T[0][0] * state.q[k] + s.T[0][1] * state.v[k] + s.g0[0] * p0 + s.g1[0] * p1;
      v[k] = s.T[1][0] * state.q[k] + s.T[1][1] * state.v[k] + s.g0[1] * p0 + s.g1[1] * p1;
    }
    if (damper.acts())
      damper.act(v, q, v);
    free_displacement = free_velocity = 0;
    add_products(matrices.shapes.amplitudes, {&q, &v}, {&free_displacement, &free_velocity});
    std::vector<std::complex<double>> feed(pair.n_poles());
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
    {
      const std::complex<double> load = pair.pole_load[k], point = pair.force_into_pole(k);
      feed[k] = load + point * drive.force;
      z[k] = pole_steps.factor[k] * state.z[k] + pole_steps.now[k] * feed[k] +
             pole_steps.later[k] * (load + point * state.force + state.pole_force[k]);
    }
    add_poles(z, feed, free_displacement, &free_velocity);
  }

  void ContactStepper::add_kept(const DynamicState &state, const double force,
                                const std::vector<unsigned int> &rows, double *const to) const
  {
    for (unsigned int k = 0; k < kept.size(); ++k)
    {
      const DenseMatrix &W = pair.relaxing[k].flexibility;
      DenseVector forces = state.relaxed[k];
      // force_response() answers the given force at once
      if (pair.relaxing[k].body == 1)
        forces[0] -= force;
      for (unsigned int j = 0; j < forces.size(); ++j)
        for (unsigned int i = 0; i < rows.size() && forces[j] != 0; ++i)
          to[i] += kept[k] * forces[j] * W(rows[i], j);
    }
  }

  void ContactStepper::set_problem(const DynamicState &state, const Drive &drive, const DenseVector &rigid)
  {
    const StepOperator &A = *step_operator;
    const std::vector<unsigned int> &points = A.points(), &rows = A.residual_rows();
    const unsigned int n = pair.n_points(), m = points.size();
    const auto next_change = [&](const DenseVector &change, const DenseVector &before, const unsigned int row)
    { return state.extrapolates_change ? 2 * change[row] - before[row] : change[row]; };
    solution.R.reinit(3 * m);
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < m; ++i)
      {
        const unsigned int there = contact_row(n, c, points[i]);
        solution.R[contact_row(m, c, i)] =
            state.R[there] + next_change(state.force_change, state.force_change_before, there);
      }
    A.modal_numbers(solution.R, c_n, c_t);
    add(c_t, c_n);
    multiply(matrices.displacement_gain, c_n, displacement);
    multiply(matrices.velocity_gain, c_n, velocity);

    problem.b = 0;
    add_kept(state, drive.force, rows, problem.b.begin() + 3 * m);
    solution.y.reinit(A.n_response_rows());
    for (unsigned int k = 0; k < rows.size(); ++k)
      solution.y[3 * m + k] = state.residual_displacement[rows[k]] +
                              next_change(state.residual_change, state.residual_change_before, rows[k]);
    A.respond({{free_displacement, free_velocity}, {displacement, velocity}}, {&problem.b, &solution.y});
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < m; ++i)
      {
        const unsigned int here = contact_row(m, c, i), there = contact_row(n, c, points[i]);
        problem.b[here] += constant_response[there] + rigid[there];
        if (c > 0)
          problem.b[here] += pair.force_response(there) * (drive.force - state.force) / h -
                             reference_of_rate(state, there) / matrices.rate_step() +
                             by_approach[there] * state.contact.approach;
        else
          problem.b[here] += pair.force_response(there) * drive.force +
                             (state.roughness.empty() ? 0. : state.roughness[points[i]]);
      }
    problem.normal_force = drive.normal_force;
    problem.approach = drive.normal_force > 0 ? state.contact.approach : drive.approach;

    add(problem.b, solution.y);
    problem.move(solution.y, problem.approach);
    solution.approach = problem.approach;
    // what the gradient of the residual adds to the slip is not in y, which has displacements alone, and a rest that relaxes
    // does not change with the forces alone
    solution.response_known = !A.has_gradient() && kept.empty();
  }

  void ContactStepper::solve_with_modal_slip_in_friction(const DynamicState &state, ContactSolver &solver)
  {
    const std::vector<unsigned int> &points = step_operator->points(), &rows = step_operator->residual_rows();
    const unsigned int n = pair.n_points(), m = points.size();
    // starts from what the state alone says, so that a resumed run does the same
    for (unsigned int i = 0; i < m; ++i)
      problem.mu[i] = problem.friction_law[i].coefficient(
          std::hypot(state.contact.y[n + points[i]], state.contact.y[2 * n + points[i]]),
          state.contact.status[points[i]] == ContactStatus::stick);
    std::vector<unsigned int> place(3 * n, 0);
    for (unsigned int k = 0; k < rows.size(); ++k)
      place[rows[k]] = 3 * m + k;
    const auto speed_of = [&](const ContactSolution &now)
    {
      std::vector<double> speeds(m);
      for (unsigned int i = 0; i < m; ++i)
      {
        double slip[2];
        for (unsigned int c = 1; c < 3; ++c)
        {
          const unsigned int there = contact_row(n, c, points[i]);
          slip[c - 1] = now.y[contact_row(m, c, i)] -
                        (now.y[place[there]] - reference_of_rate(state, there)) / matrices.rate_step();
        }
        speeds[i] = std::hypot(slip[0], slip[1]);
      }
      return speeds;
    };
    solve_with_friction_of_speed(problem, solver, solution, speed_of);
  }

  void ContactStepper::take_over(DynamicState &state, const DenseVector &rigid)
  {
    const StepOperator &A = *step_operator;
    const std::vector<unsigned int> &points = A.points(), &rows = A.residual_rows();
    const unsigned int n = pair.n_points(), m = points.size();
    proximity.end_step(state, A, solution, gaps);
    double rate = 0, error_of_same = 0, error_of_extrapolated = 0;
    for (unsigned int i = 0; i < m; ++i)
      state.contact.status[points[i]] = solution.status[i];
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < m; ++i)
      {
        const unsigned int here = contact_row(m, c, i), there = contact_row(n, c, points[i]);
        const double change = solution.R[here] - state.R[there], before = state.force_change[there];
        error_of_same += std::pow(change - before, 2);
        error_of_extrapolated += std::pow(change - 2 * before + state.force_change_before[there], 2);
        state.force_change_before[there] = before;
        state.force_change[there] = change;
        state.contact.R[there] = state.R[there] = solution.R[here];
        state.contact.y[there] = solution.y[here];
      }
    state.extrapolates_change = error_of_extrapolated < error_of_same;
    // where a point is no longer nearby its rate is forgotten
    DenseVector residual_rate(3 * n);
    for (unsigned int k = 0; k < rows.size(); ++k)
    {
      const double reference = reference_of_rate(state, rows[k]);
      double &displacement_of_row = state.residual_displacement[rows[k]];
      state.residual_change_before[rows[k]] = state.residual_change[rows[k]];
      state.residual_change[rows[k]] = solution.y[3 * m + k] - displacement_of_row;
      displacement_of_row = solution.y[3 * m + k];
      if (rows[k] >= n)
        residual_rate[rows[k]] = (displacement_of_row - reference) / matrices.rate_step();
    }
    state.residual_rate = residual_rate;
    for (unsigned int c = 1; c < 3; ++c)
      for (unsigned int i = 0; i < m; ++i)
      {
        const unsigned int there = contact_row(n, c, points[i]);
        rate += state.R[there] * state.residual_rate[there];
      }

    if (matrices.shapes.rank() > 0)
    {
      rate += c_t * velocity;
      if (pair.n_modes() > 0)
        matrices.shapes.amplitudes.Tvmult(state.modal_force, c_n);
    }
    state.pole_force = shares(matrices.into_poles, c_n);
    state.pole_reaction = shares(matrices.by_poles, c_n);
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      state.z[k] = z[k] + pole_steps.now[k] * state.pole_force[k];
    if (damper.acts())
    {
      DenseVector by_force(pair.n_modes());
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        by_force[k] = steps[k].g1[1] * state.modal_force[k];
      damper.act(by_force, q, v);
    }
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      state.q[k] = q[k] + steps[k].g1[0] * state.modal_force[k];
      state.v[k] = v[k] + steps[k].g1[1] * state.modal_force[k];
    }
    state.time += h;
    state.last_step = h;
    set_powers(state.R, state.contact.y, rigid, n, rate, state);

    ContactSolution &to = state.contact;
    to.approach = solution.approach;
    to.converged = solution.converged;
    to.residual = solution.residual;
    to.cost() = solution.cost();
  }
} // namespace vibrocontact

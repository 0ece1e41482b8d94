#include <vibrocontact/analyses/limit_cycle/step_derivative.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/matrix_parts.h>
#include <vibrocontact/contact/point_rows.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  StepOnPoints::StepOnPoints(const ContactStepper &stepper, const std::vector<unsigned int> &points)
      : MovingShapes(on_rows(stepper.matrices_of_step(),
                             rows_of_points(stepper.matrices_of_step().contacts.n_points(), points))),
        points(points), lead(stepper.matrices_of_step().lead())
  {
    const StepMatrices &matrices = stepper.matrices_of_step();
    const std::vector<unsigned int> rows = rows_of_points(matrices.contacts.n_points(), points);
    by_poles = parts_of(right);
    into_poles = parts_of(left);
    const std::vector<unsigned int> along(rows.begin() + points.size(), rows.end());
    slip_flexibility = entries_at(matrices.residual_flexibility, along, rows);
    for (const unsigned int row : rows)
      by_approach.push_back(stepper.approach_rows()[row]);
  }

  StepDerivative::StepDerivative(const ContactStepper &stepper,
                                 const std::vector<std::complex<double>> &poles,
                                 const DenseVector &residual_rate)
      : stepper(stepper), poles(poles), force_given(stepper.last_problem().force_given())
  {
    const ContactProblem &problem = stepper.last_problem();
    const ContactSolution &solution = stepper.last_solution();
    J.linearise(problem, ContactResidual(problem), solution.R, solution.y);
    for (const unsigned int nearby : J.points())
      points.push_back(stepper.nearby_points()[nearby]);
    if (points.empty())
      return;
    DenseMatrix response;
    problem.A->extract(J.points(), response);
    J.assemble(response, factors);
    if (problem.friction_law.any(&FrictionLaw::depends_on_speed))
    {
      take_speed_dependence(residual_rate);
      add_speed_dependence(response);
    }
    if (!factorise_lu(factors))
      throw ConvergenceError("The contact of a step has no derivative: its Jacobian is singular.");
  }

  void StepDerivative::stand_on(const StepOnPoints &these)
  {
    on_points = &these;
    active.clear();
    for (const unsigned int point : points)
    {
      const auto place = std::lower_bound(these.points.begin(), these.points.end(), point);
      AssertThrow(place != these.points.end() && *place == point, dealii::ExcInternalError());
      active.push_back(place - these.points.begin());
    }
  }

  void StepDerivative::take_speed_dependence(const DenseVector &residual_rate)
  {
    const ContactProblem &problem = stepper.last_problem();
    const ContactSolution &solution = stepper.last_solution();
    const unsigned int n_nearby = problem.n_points(), n_of_grid = residual_rate.size() / 3;
    for (unsigned int k = 0; k < points.size(); ++k)
    {
      const unsigned int nearby = J.points()[k], point = points[k];
      Vector2 slip;
      for (unsigned int c = 1; c < 3; ++c)
        slip[c - 1] =
            solution.y[contact_row(n_nearby, c, nearby)] - residual_rate[contact_row(n_of_grid, c, point)];
      by_speed.push_back(speed_dependence(J.rows_of_points()[k], problem.mu[nearby], solution.R[nearby],
                                          problem.friction_law[nearby], slip));
    }
  }

  void StepDerivative::add_speed_dependence(const DenseMatrix &response)
  {
    const StepMatrices &matrices = stepper.matrices_of_step();
    const unsigned int m = points.size(), n_of_grid = matrices.contacts.n_points();
    for (unsigned int column = 0; column < 3 * m; ++column)
      for (unsigned int k = 0; k < m; ++k)
      {
        double speed = 0;
        for (unsigned int c = 1; c < 3; ++c)
          speed += by_speed[k].direction[c - 1] *
                   (response(c * m + k, column) -
                    matrices.residual_flexibility(contact_row(n_of_grid, c, points[k]),
                                                  contact_row(n_of_grid, column / m, points[column % m])) /
                        matrices.rate_step());
        for (unsigned int d = 0; d < 2; ++d)
          factors((d + 1) * m + k, column) -= by_speed[k].force[d] * speed;
      }
  }

  void StepDerivative::advance_modes(StateChanges &changes, const LengthChange *const change,
                                     const StepEnds *const ends) const
  {
    const std::vector<ModalStep> &steps = stepper.steps_of_modes();
    for (unsigned int j = 0; j < changes.n_columns(); ++j)
      for (unsigned int k = 0; k < steps.size(); ++k)
      {
        const ModalStep &s = steps[k];
        double &q = changes.q(k, j), &v = changes.v(k, j);
        const double q0 = q, v0 = v, p0 = changes.modal_force(k, j);
        q = s.T[0][0] * q0 + s.T[0][1] * v0 + s.g0[0] * p0;
        v = s.T[1][0] * q0 + s.T[1][1] * v0 + s.g0[1] * p0;
        if (!change)
          continue;
        const ModalStep &d = change->modes_by_length[k];
        const double p = ends->modal_force[k], p1 = ends->next_modal_force[k];
        q += change->length * (d.T[0][0] * ends->q[k] + d.T[0][1] * ends->v[k] + d.g0[0] * p + d.g1[0] * p1);
        v += change->length * (d.T[1][0] * ends->q[k] + d.T[1][1] * ends->v[k] + d.g0[1] * p + d.g1[1] * p1);
      }
  }

  void StepDerivative::advance_poles(StateChanges &changes, const LengthChange *const change,
                                     const StepEnds *const ends) const
  {
    const StepWeights &step = stepper.steps_of_poles();
    const unsigned int n = poles.size();
    for (unsigned int j = 0; j < changes.n_columns() && n > 0; ++j)
      for (unsigned int k = 0; k < n; ++k)
      {
        const Complex force(changes.pole_force(k, j), changes.pole_force(n + k, j));
        Complex z(changes.poles(k, j), changes.poles(n + k, j));
        z = step.factor[k] * z + step.later[k] * force;
        if (change)
        {
          const StepWeights &d = change->poles_by_length;
          z += change->length * (d.factor[k] * ends->poles[k] + d.later[k] * ends->pole_force[k] +
                                 d.now[k] * ends->next_pole_force[k]);
        }
        changes.poles(k, j) = z.real();
        changes.poles(n + k, j) = z.imag();
      }
  }

  DenseMatrix StepDerivative::of_modes(const DenseMatrix &numbers, const unsigned int n_columns) const
  {
    DenseMatrix result(on_points->rank(), n_columns);
    if (!stepper.steps_of_modes().empty())
      on_points->shapes.amplitudes.mmult(result, numbers);
    return result;
  }

  DenseMatrix StepDerivative::displacements(const StateChanges &changes) const
  {
    DenseMatrix result = of_modes(changes.q, changes.n_columns());
    if (!poles.empty())
      on_points->by_poles.mmult(result, changes.poles, true);
    return result;
  }

  DenseMatrix StepDerivative::velocities(const StateChanges &changes) const
  {
    DenseMatrix result = of_modes(changes.v, changes.n_columns());
    if (poles.empty())
      return result;
    const unsigned int n = poles.size();
    DenseMatrix rates(2 * n, changes.n_columns());
    for (unsigned int j = 0; j < changes.n_columns(); ++j)
      for (unsigned int k = 0; k < n; ++k)
      {
        const Complex rate = poles[k] * Complex(changes.poles(k, j), changes.poles(n + k, j));
        rates(k, j) = rate.real();
        rates(n + k, j) = rate.imag();
      }
    on_points->by_poles.mmult(result, rates, true);
    return result;
  }

  void StepDerivative::solve_contact(const DenseMatrix &moved, StateChanges &changes,
                                     const LengthChange *const change, const StepEnds *const ends) const
  {
    const unsigned int n = on_points->n_points(), n_columns = moved.n(), n_active = active.size(),
                       n_of_grid = stepper.matrices_of_step().contacts.n_points();
    const StepMatrices &matrices = stepper.matrices_of_step();
    DenseMatrix x(3 * n_active + (force_given ? 1 : 0), n_columns);
    for (unsigned int j = 0; j < n_columns; ++j)
      for (unsigned int k = 0; k < n_active; ++k)
      {
        double gap_and_slip[3], speed = 0;
        for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int row = contact_row(n, c, active[k]);
          double &value = gap_and_slip[c];
          value = moved(row, j);
          if (c == 0)
            continue;
          if (!by_speed.empty())
            speed += by_speed[k].direction[c - 1] * value;
          value -= changes.rate_reference(row - n, j) / matrices.rate_step();
          if (force_given)
            value += on_points->by_approach[row] * changes.approach[j];
          if (change)
            value -=
                change->length * ends->residual_rate[contact_row(n_of_grid, c, points[k])] / matrices.step;
        }
        const auto row = J.apply(k, 0, 0, 0, gap_and_slip[0], gap_and_slip[1], gap_and_slip[2]);
        for (unsigned int c = 0; c < 3; ++c)
          x(c * n_active + k, j) =
              -row[c] + (c > 0 && !by_speed.empty() ? by_speed[k].force[c - 1] * speed : 0.);
      }
    if (n_active > 0)
      factors.solve(x);
    changes.R.reinit(3 * n, n_columns);
    changes.approach.assign(n_columns, 0.);
    for (unsigned int j = 0; j < n_columns; ++j)
    {
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int k = 0; k < n_active; ++k)
          changes.R(contact_row(n, c, active[k]), j) = x(c * n_active + k, j);
      if (force_given)
        changes.approach[j] = x(3 * n_active, j) * J.approach_scale();
    }
  }

  DenseMatrix StepDerivative::next_reference(DenseMatrix displacement, const DenseMatrix &before) const
  {
    const double theta = stepper.matrices_of_step().residual_theta;
    if (theta == 1)
      return displacement;
    displacement *= 1 / theta;
    displacement.add((theta - 1) / theta, before);
    return displacement;
  }

  void StepOnPoints::feed(StateChanges &changes) const
  {
    const unsigned int n_columns = changes.n_columns(), n_modes = changes.q.m(),
                       n_poles = changes.poles.m() / 2;
    changes.modal_force.reinit(n_modes, n_columns);
    if (n_modes > 0)
      shapes.amplitudes.Tmmult(changes.modal_force, changes.shape_force);
    changes.pole_force.reinit(2 * n_poles, n_columns);
    if (n_poles == 0)
      return;
    into_poles.Tmmult(changes.pole_force, changes.shape_force);
    // the parts stand as 2 Re, -2 Im
    for (unsigned int j = 0; j < n_columns; ++j)
      for (unsigned int k = 0; k < n_poles; ++k)
      {
        changes.pole_force(k, j) /= 2;
        changes.pole_force(n_poles + k, j) /= -2;
      }
  }

  void StepDerivative::add_forces(StateChanges &changes) const
  {
    on_points->feed(changes);
    const std::vector<ModalStep> &steps = stepper.steps_of_modes();
    for (unsigned int j = 0; j < changes.n_columns(); ++j)
      for (unsigned int k = 0; k < steps.size(); ++k)
      {
        changes.q(k, j) += steps[k].g1[0] * changes.modal_force(k, j);
        changes.v(k, j) += steps[k].g1[1] * changes.modal_force(k, j);
      }
    const unsigned int n = poles.size();
    for (unsigned int j = 0; j < changes.n_columns(); ++j)
      for (unsigned int k = 0; k < n; ++k)
      {
        const Complex added =
            stepper.steps_of_poles().now[k] * Complex(changes.pole_force(k, j), changes.pole_force(n + k, j));
        changes.poles(k, j) += added.real();
        changes.poles(n + k, j) += added.imag();
      }
  }

  void StepDerivative::advance(StateChanges &changes, const LengthChange *const change,
                               const StepEnds *const ends) const
  {
    advance_modes(changes, change, ends);
    advance_poles(changes, change, ends);
    DenseMatrix moved = product(on_points->by_displacement, displacements(changes));
    on_points->by_velocity.mmult(moved, velocities(changes), true);
    solve_contact(moved, changes, change, ends);
    changes.rate_reference =
        next_reference(product(on_points->slip_flexibility, changes.R), changes.rate_reference);
    changes.shape_force.reinit(on_points->rank(), changes.n_columns());
    on_points->shapes.basis.Tmmult(changes.shape_force, changes.R);
    add_forces(changes);
  }

  DenseMatrix StepDerivative::contact_response() const
  {
    const unsigned int rank = on_points->rank(), n_loaded = on_points->n_loaded, n = on_points->n_points(),
                       first = rank + n_loaded, n_columns = first + 2 * n + 1;
    DenseMatrix moved(3 * n, n_columns);
    add_block(moved, on_points->by_displacement, 0, 0);
    add_block(moved, top_left(on_points->by_velocity, 3 * n, n_loaded), 0, rank);
    StateChanges changes;
    changes.rate_reference.reinit(2 * n, n_columns);
    for (unsigned int i = 0; i < 2 * n; ++i)
      changes.rate_reference(i, first + i) = 1;
    changes.approach.assign(n_columns, 0.);
    changes.approach.back() = 1;
    solve_contact(moved, changes, nullptr, nullptr);

    DenseMatrix on_shapes(n_loaded, n_columns), result(n_loaded + 2 * n + 1, n_columns);
    top_left(on_points->shapes.basis, 3 * n, n_loaded).Tmmult(on_shapes, changes.R);
    add_block(result, on_shapes, 0, 0);
    add_block(result, product(on_points->slip_flexibility, changes.R), n_loaded, 0);
    for (unsigned int j = 0; j < n_columns; ++j)
      result(n_loaded + 2 * n, j) = changes.approach[j];
    return result;
  }

  void StepDerivative::advance_many(std::vector<StateChanges> &blocks) const
  {
    const DenseMatrix response = contact_response();
    const unsigned int rank = on_points->rank(), n_loaded = on_points->n_loaded,
                       n_slips = 2 * on_points->n_points();
    for (StateChanges &changes : blocks)
    {
      const unsigned int n_columns = changes.n_columns();
      advance_modes(changes, nullptr, nullptr);
      advance_poles(changes, nullptr, nullptr);
      DenseMatrix before(response.n(), n_columns);
      add_block(before, displacements(changes), 0, 0);
      add_block(before, top_left(velocities(changes), n_loaded, n_columns), rank, 0);
      add_block(before, changes.rate_reference, rank + n_loaded, 0);
      for (unsigned int j = 0; j < n_columns; ++j)
        before(rank + n_loaded + n_slips, j) = changes.approach[j];
      const DenseMatrix after = product(response, before);
      // the shapes of gradients are not loaded
      changes.shape_force.reinit(rank, n_columns);
      add_block(changes.shape_force, top_left(after, n_loaded, n_columns), 0, 0);
      DenseMatrix displacement(n_slips, n_columns);
      for (unsigned int j = 0; j < n_columns; ++j)
      {
        for (unsigned int i = 0; i < n_slips; ++i)
          displacement(i, j) = after(n_loaded + i, j);
        changes.approach[j] = after(n_loaded + n_slips, j);
      }
      changes.rate_reference = next_reference(std::move(displacement), changes.rate_reference);
      add_forces(changes);
    }
  }

  std::vector<ModalStep> steps_by_length(const std::vector<ModalStep> &longer,
                                         const std::vector<ModalStep> &shorter, const double difference)
  {
    std::vector<ModalStep> result(longer);
    for (unsigned int k = 0; k < result.size(); ++k)
      for (unsigned int i = 0; i < 2; ++i)
      {
        for (unsigned int j = 0; j < 2; ++j)
          result[k].T[i][j] = (longer[k].T[i][j] - shorter[k].T[i][j]) / difference;
        result[k].g0[i] = (longer[k].g0[i] - shorter[k].g0[i]) / difference;
        result[k].g1[i] = (longer[k].g1[i] - shorter[k].g1[i]) / difference;
      }
    return result;
  }

  StepWeights steps_by_length(StepWeights longer, const StepWeights &shorter, const double difference)
  {
    for (unsigned int k = 0; k < longer.factor.size(); ++k)
    {
      longer.factor[k] = (longer.factor[k] - shorter.factor[k]) / difference;
      longer.now[k] = (longer.now[k] - shorter.now[k]) / difference;
      longer.later[k] = (longer.later[k] - shorter.later[k]) / difference;
    }
    return longer;
  }
} // namespace vibrocontact

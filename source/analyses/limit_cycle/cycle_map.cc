#include <vibrocontact/analyses/limit_cycle/cycle_map.h>
#include <vibrocontact/analyses/transient/step_levels.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/matrix_parts.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/point_rows.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    /// of what a step is multiplied with at once: they stay in the cache
    constexpr unsigned int columns_of_block = 128;

    /// of all forces
    constexpr double contact_tolerance = 1e-13;

    /// Units to a thousandth of the largest.
    void raise_small(std::vector<double> &units)
    {
      double largest = 0;
      for (const double unit : units)
        largest = std::max(largest, unit);
      for (double &unit : units)
        unit = std::max(unit, 1e-3 * largest);
    }

    std::vector<std::complex<double>> sum(std::vector<std::complex<double>> a,
                                          const std::vector<std::complex<double>> &b)
    {
      for (unsigned int k = 0; k < a.size(); ++k)
        a[k] += b[k];
      return a;
    }

    /// Columns of the unit matrix.
    DenseMatrix unit_columns(const unsigned int size, const unsigned int begin, const unsigned int end)
    {
      DenseMatrix result(size, end - begin);
      for (unsigned int j = begin; j < end; ++j)
        result(j, j - begin) = 1;
      return result;
    }

    /// The points that touch at no end of a step.
    std::vector<unsigned int> always_open(const std::vector<unsigned int> &points,
                                          const std::vector<std::vector<ContactStatus>> &statuses)
    {
      std::vector<unsigned int> result;
      for (const unsigned int point : points)
        if (std::all_of(statuses.begin(), statuses.end(),
                        [&](const auto &status) { return status[point] == ContactStatus::open; }))
          result.push_back(point);
      return result;
    }

    DenseVector only_column(const DenseMatrix &matrix)
    {
      return DenseVector(&matrix(0, 0), &matrix(0, 0) + matrix.m());
    }
  } // namespace

  ContactSolverParameters solver_of_cycles(ContactSolverParameters solver)
  {
    solver.tolerance = std::min(solver.tolerance, contact_tolerance);
    return solver;
  }

  CycleMap::CycleMap(const TransientParameters &transient, const ContactSections &contact,
                     const ContactSolverParameters &solver, const ContactPair &pair, const Drive &drive,
                     const double approach, const std::vector<unsigned int> &points,
                     const unsigned int n_steps, std::shared_ptr<const PatchShapes> shapes)
      : transient(transient), contact(contact), solver(solver), pair(pair), drive(drive), approach(approach),
        points(points),
        shapes(shapes ? std::move(shapes) : std::make_shared<const PatchShapes>(shapes_of_steps(pair))),
        rows(rows_of_points(pair.n_points(), points)), m(n_steps), frequency(pair.omega)
  {
    trace = rows_at(pair.trace, rows);
    left_parts.reinit(rows.size(), 2 * pair.n_poles());
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        left_parts(i, k) = pair.left(rows[i], k).real();
        left_parts(i, pair.n_poles() + k) = pair.left(rows[i], k).imag();
      }
    AssertThrow(n_motion() > 0 && !points.empty(), dealii::ExcInternalError());
    constant_force.reinit(pair.n_modes());
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      constant_force[k] = pair.modal_load[k] + pair.hub_participation(k) * drive.hub_acceleration +
                          pair.force_participation(k) * drive.force;
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      constant_feed.push_back(pair.pole_load[k] + pair.force_into_pole(k) * drive.force);
    // motions without frequency and rows that hardly yield count as slow and soft ones do
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      unit_of_pole.push_back(2 * std::abs(pair.poles[k]) * amplitude_per_state(pair, k));
    for (const double omega : frequency)
      fastest = std::max(fastest, omega);
    for (const std::complex<double> &pole : pair.poles)
      fastest = std::max(fastest, std::abs(pole));
    raise_small(frequency);
    raise_small(unit_of_pole);
    for (unsigned int i = 0; i < rows.size(); ++i)
    {
      double flexibility = pair.residual(rows[i], rows[i]);
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        flexibility += std::pow(trace(i, k) / frequency[k], 2);
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
        flexibility += 2 * std::abs(pair.right(rows[i], k) * pair.left(rows[i], k) / pair.poles[k]);
      root_of_flexibility.push_back(std::sqrt(flexibility));
    }
    raise_small(root_of_flexibility);
  }

  std::vector<unsigned int> CycleMap::force_rows(const std::vector<unsigned int> &some) const
  {
    std::vector<unsigned int> places;
    for (const unsigned int point : some)
      places.push_back(std::lower_bound(points.begin(), points.end(), point) - points.begin());
    std::vector<unsigned int> result = rows_of_points(points.size(), places);
    for (unsigned int &row : result)
      row += n_motion();
    return result;
  }

  std::vector<unsigned int> CycleMap::rate_rows(const std::vector<unsigned int> &some) const
  {
    std::vector<unsigned int> result = force_rows(some);
    result.erase(result.begin(), result.begin() + some.size());
    for (unsigned int &row : result)
      row += first_rate() - n_motion() - points.size();
    return result;
  }

  std::vector<double> CycleMap::rates_in(const DenseVector &x, const StepOnPoints &on) const
  {
    std::vector<double> rates;
    for (const unsigned int row : rate_rows(on.points))
      rates.push_back(x[row] / unit_of_rate(row - first_rate()));
    return rates;
  }

  void CycleMap::take_motion(const StateChanges &changes, DenseMatrix &x) const
  {
    const unsigned int n_modes = pair.n_modes(), n_poles = pair.n_poles();
    for (unsigned int j = 0; j < x.n(); ++j)
    {
      for (unsigned int k = 0; k < n_modes; ++k)
      {
        x(k, j) = frequency[k] * changes.q(k, j);
        x(n_modes + k, j) = changes.v(k, j);
      }
      for (unsigned int k = 0; k < n_poles; ++k)
      {
        x(2 * n_modes + k, j) = unit_of_pole[k] * changes.poles(k, j);
        x(2 * n_modes + n_poles + k, j) = unit_of_pole[k] * changes.poles(n_poles + k, j);
      }
    }
  }

  void CycleMap::set_motion(const DenseMatrix &x, StateChanges &changes) const
  {
    const unsigned int n_modes = pair.n_modes(), n_poles = pair.n_poles();
    changes.q.reinit(n_modes, x.n());
    changes.v.reinit(n_modes, x.n());
    changes.poles.reinit(2 * n_poles, x.n());
    changes.approach.assign(x.n(), 0.);
    for (unsigned int j = 0; j < x.n(); ++j)
    {
      for (unsigned int k = 0; k < n_modes; ++k)
      {
        changes.q(k, j) = x(k, j) / frequency[k];
        changes.v(k, j) = x(n_modes + k, j);
      }
      for (unsigned int k = 0; k < n_poles; ++k)
      {
        changes.poles(k, j) = x(2 * n_modes + k, j) / unit_of_pole[k];
        changes.poles(n_poles + k, j) = x(2 * n_modes + n_poles + k, j) / unit_of_pole[k];
      }
    }
  }

  DenseMatrix CycleMap::packed(const StateChanges &changes, const StepOnPoints &on) const
  {
    DenseMatrix x(size(), changes.n_columns());
    take_motion(changes, x);
    const std::vector<unsigned int> of_forces = force_rows(on.points);
    for (unsigned int j = 0; j < x.n(); ++j)
      for (unsigned int i = 0; i < of_forces.size(); ++i)
        x(of_forces[i], j) = root_of_flexibility[of_forces[i] - n_motion()] * changes.R(i, j);
    if (!has_rates())
      return x;
    const std::vector<unsigned int> of_rates = rate_rows(on.points);
    const DenseMatrix displacement = product(on.slip_flexibility, changes.R);
    for (unsigned int j = 0; j < x.n(); ++j)
      for (unsigned int i = 0; i < of_rates.size(); ++i)
        x(of_rates[i], j) = unit_of_rate(of_rates[i] - first_rate()) *
                            (changes.rate_reference(i, j) - displacement(i, j)) / on.lead;
    return x;
  }

  DenseVector CycleMap::pack(const DynamicState &state) const
  {
    const unsigned int n_modes = pair.n_modes(), n_poles = pair.n_poles();
    DenseVector x(size());
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      x[k] = frequency[k] * state.q[k];
      x[n_modes + k] = state.v[k];
    }
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      x[2 * n_modes + k] = unit_of_pole[k] * state.z[k].real();
      x[2 * n_modes + n_poles + k] = unit_of_pole[k] * state.z[k].imag();
    }
    for (unsigned int i = 0; i < rows.size(); ++i)
      x[n_motion() + i] = root_of_flexibility[i] * state.R[rows[i]];
    for (unsigned int i = first_rate(); i < size(); ++i)
      x[i] = unit_of_rate(i - first_rate()) * state.residual_rate[row_along(i - first_rate())];
    return x;
  }

  DynamicState CycleMap::unpack(const DenseVector &x) const
  {
    const unsigned int n_modes = pair.n_modes(), n_poles = pair.n_poles();
    DynamicState state;
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      state.q.push_back(x[k] / frequency[k]);
      state.v.push_back(x[n_modes + k]);
    }
    for (unsigned int k = 0; k < n_poles; ++k)
      state.z.emplace_back(x[2 * n_modes + k] / unit_of_pole[k],
                           x[2 * n_modes + n_poles + k] / unit_of_pole[k]);
    state.R.reinit(3 * pair.n_points());
    for (unsigned int i = 0; i < rows.size(); ++i)
      state.R[rows[i]] = x[n_motion() + i] / root_of_flexibility[i];
    state.contact.approach = approach;
    state.hub_acceleration = drive.hub_acceleration;
    state.force = drive.force;
    complete(pair, {}, state);
    for (unsigned int i = first_rate(); i < size(); ++i)
      state.residual_rate[row_along(i - first_rate())] = x[i] / unit_of_rate(i - first_rate());
    return state;
  }

  std::unique_ptr<ContactStepper> CycleMap::stepper_of(const double step) const
  {
    return std::make_unique<ContactStepper>(pair, find_creep_scheme(contact.first().creep_scheme), contact,
                                            modal_steps(transient, pair, step), step, drive.creepage.speed,
                                            pole_steps(transient, pair, step), shapes.get(),
                                            transient.residual_theta);
  }

  bool CycleMap::are_known(const DenseVector &R) const
  {
    for (unsigned int i = 0; i < pair.n_points(); ++i)
      if (R[i] > 0 && !std::binary_search(points.begin(), points.end(), i))
        return false;
    return true;
  }

  DenseVector CycleMap::march(const DenseVector &x, const double period, const bool keep_derivatives,
                              const Observer &observe)
  {
    if (!observe && marched.period == period && marched.start == x &&
        (marched.has_derivatives || !keep_derivatives))
      return marched.end;
    const double h = period / m;
    if (!stepper || stepper->matrices_of_step().step != h)
    {
      stepper = stepper_of(h);
      // central differences: off by 1e-8 of what they are
      const double little = 1e-4 * h;
      modes_by_length = steps_by_length(modal_steps(transient, pair, h + little),
                                        modal_steps(transient, pair, h - little), 2 * little);
      poles_by_length = steps_by_length(pole_steps(transient, pair, h + little),
                                        pole_steps(transient, pair, h - little), 2 * little);
    }
    marched = {};
    no_derivative.clear();
    derivatives.clear();
    ends.clear();
    derivatives.reserve(keep_derivatives ? m : 0);
    std::vector<std::vector<ContactStatus>> statuses;
    const auto contact_solver = create_contact_solver(solver);
    DynamicState state = unpack(x), before;
    DenseVector first, last;
    for (unsigned int j = 0; j < m; ++j)
    {
      before = state;
      const ContactSolution &solution = stepper->advance(state, drive, *contact_solver);
      ++n_marched_steps;
      if (!solution.converged)
        throw ConvergenceError("the contact of step " + std::to_string(j + 1) + " of " + std::to_string(m) +
                               " of the period did not converge");
      if (!are_known(state.R))
      {
        left_its_points = true;
        throw ConvergenceError("the contact reaches points that are far from those it has at rest");
      }
      if (keep_derivatives && no_derivative.empty())
      {
        try
        {
          derivatives.emplace_back(*stepper, pair.poles, state.residual_rate);
        }
        catch (const ConvergenceError &error)
        {
          no_derivative = error.what();
        }
        DenseVector begin = before.modal_force, end = state.modal_force;
        begin += constant_force;
        end += constant_force;
        ends.push_back({before.q, before.v, begin, end, before.z, sum(before.pole_force, constant_feed),
                        sum(state.pole_force, constant_feed), state.residual_rate});
      }
      statuses.push_back(state.contact.status);
      if (j == 0)
        first = pack(state);
      if (j + 1 == m)
        last = pack(before);
      if (observe)
        observe(state);
    }
    DenseVector end = pack(state);
    // a period later the first step follows the last one
    mean_rate = first;
    mean_rate -= x;
    mean_rate += end;
    mean_rate -= last;
    mean_rate /= 2 * h;
    if (has_rates())
      for (const unsigned int row : rate_rows(always_open(points, statuses)))
        end[row] = mean_rate[row] = 0;
    if (keep_derivatives && no_derivative.empty())
      stand_on_loaded_points();
    marched = {period, x, end, keep_derivatives && no_derivative.empty(), std::move(statuses)};
    return end;
  }

  void CycleMap::stand_on_loaded_points()
  {
    std::set<unsigned int> in_contact;
    for (const StepDerivative &step : derivatives)
      in_contact.insert(step.points_in_contact().begin(), step.points_in_contact().end());
    if (in_contact.empty())
    {
      no_derivative = "nothing is in contact during the period";
      return;
    }
    loaded = std::make_unique<StepOnPoints>(*stepper,
                                            std::vector<unsigned int>(in_contact.begin(), in_contact.end()));
    for (StepDerivative &step : derivatives)
      step.stand_on(*loaded);
  }

  StateChanges CycleMap::changes_of(const DenseMatrix &x, const StepOnPoints &on) const
  {
    const unsigned int n_rows = rows.size(), n_columns = x.n();
    StateChanges changes;
    set_motion(x, changes);
    DenseMatrix R(n_rows, n_columns);
    for (unsigned int j = 0; j < n_columns; ++j)
      for (unsigned int i = 0; i < n_rows; ++i)
        R(i, j) = x(n_motion() + i, j) / root_of_flexibility[i];
    changes.modal_force.reinit(pair.n_modes(), n_columns);
    changes.pole_force.reinit(2 * pair.n_poles(), n_columns);
    if (pair.n_modes() > 0)
      trace.Tmmult(changes.modal_force, R);
    if (pair.n_poles() > 0)
      left_parts.Tmmult(changes.pole_force, R);
    const std::vector<unsigned int> on_grid = rows_of_points(pair.n_points(), on.points),
                                    along(on_grid.begin() + on.n_points(), on_grid.end());
    changes.rate_reference = product(entries_at(pair.residual, along, rows), R);
    if (!has_rates())
      return changes;
    const std::vector<unsigned int> of_rates = rate_rows(on.points);
    for (unsigned int j = 0; j < n_columns; ++j)
      for (unsigned int i = 0; i < of_rates.size(); ++i)
        changes.rate_reference(i, j) +=
            on.lead * x(of_rates[i], j) / unit_of_rate(of_rates[i] - first_rate());
    return changes;
  }

  const std::vector<StepDerivative> &CycleMap::derivatives_of_steps() const
  {
    if (!no_derivative.empty())
      throw ConvergenceError(no_derivative);
    AssertThrow(marched.has_derivatives, dealii::ExcInternalError());
    return derivatives;
  }

  DenseVector CycleMap::derivative(const DenseVector &start) const
  {
    ++n_products;
    const std::vector<StepDerivative> &steps = derivatives_of_steps();
    DenseMatrix column(size(), 1);
    std::copy(start.begin(), start.end(), &column(0, 0));
    StateChanges changes = changes_of(column, *loaded);
    for (const StepDerivative &step : steps)
      step.advance(changes);
    return only_column(packed(changes, *loaded));
  }

  DenseVector CycleMap::by_period() const
  {
    const std::vector<StepDerivative> &steps = derivatives_of_steps();
    StateChanges changes = changes_of(DenseMatrix(size(), 1), *loaded);
    const LengthChange longer = {modes_by_length, poles_by_length, 1. / m};
    const double share = 1. / marched.period;
    // the rates of the state are what they are; the time for which they go on, and over which they are taken, is longer
    const std::vector<double> rates = has_rates() ? rates_in(marched.start, *loaded) : std::vector<double>();
    for (unsigned int i = 0; i < rates.size(); ++i)
      changes.rate_reference(i, 0) += share * loaded->lead * rates[i];
    for (unsigned int j = 0; j < m; ++j)
      steps[j].advance(changes, &longer, &ends[j]);
    DenseVector result = only_column(packed(changes, *loaded));
    if (has_rates())
      for (const unsigned int row : rate_rows(loaded->points))
        result[row] -= share * marched.end[row];
    return result;
  }

  double CycleMap::change_along_motion() const
  {
    // what differences of steps have beside the direction of the motion is gone after a period
    const DenseVector along = derivative(mean_rate);
    DenseVector change = derivative(along);
    change -= along;
    return change.l2_norm() / along.l2_norm();
  }

  CycleBalance CycleMap::balance(const DynamicState &at_rest, const unsigned int n_harmonics,
                                 const double tolerance) const
  {
    return {pair, contact, drive, at_rest, *shapes, points, n_harmonics, tolerance};
  }

  std::vector<double> CycleMap::roots_along(const StepOnPoints &on) const
  {
    std::vector<double> result;
    for (const unsigned int row : rate_rows(on.points))
      result.push_back(root_of_flexibility[points.size() + row - first_rate()]);
    return result;
  }

  DenseMatrix CycleMap::lasting(const StateChanges &changes) const
  {
    const unsigned int n_loaded = loaded->n_loaded, first_reference = n_motion() + n_loaded;
    const std::vector<double> along = roots_along(*loaded);
    const double of_shapes = *std::max_element(root_of_flexibility.begin(), root_of_flexibility.end());
    DenseMatrix y(first_reference + along.size(), changes.n_columns());
    take_motion(changes, y);
    for (unsigned int j = 0; j < y.n(); ++j)
    {
      for (unsigned int k = 0; k < n_loaded; ++k)
        y(n_motion() + k, j) = of_shapes * changes.shape_force(k, j);
      for (unsigned int i = 0; i < along.size(); ++i)
        y(first_reference + i, j) = changes.rate_reference(i, j) / along[i];
    }
    return y;
  }

  StateChanges CycleMap::changes_of_lasting(const DenseMatrix &y) const
  {
    const unsigned int n_loaded = loaded->n_loaded, first_reference = n_motion() + n_loaded;
    const std::vector<double> along = roots_along(*loaded);
    const double of_shapes = *std::max_element(root_of_flexibility.begin(), root_of_flexibility.end());
    StateChanges changes;
    set_motion(y, changes);
    changes.shape_force.reinit(loaded->rank(), y.n());
    changes.rate_reference.reinit(along.size(), y.n());
    for (unsigned int j = 0; j < y.n(); ++j)
    {
      for (unsigned int k = 0; k < n_loaded; ++k)
        changes.shape_force(k, j) = y(n_motion() + k, j) / of_shapes;
      for (unsigned int i = 0; i < along.size(); ++i)
        changes.rate_reference(i, j) = along[i] * y(first_reference + i, j);
    }
    loaded->feed(changes);
    return changes;
  }

  DenseMatrix CycleMap::monodromy() const
  {
    const std::vector<StepDerivative> &steps = derivatives_of_steps();
    const unsigned int n = n_motion() + loaded->n_loaded + 2 * loaded->n_points();
    n_products += n;
    std::vector<StateChanges> blocks;
    for (unsigned int begin = 0; begin < n; begin += columns_of_block)
      blocks.push_back(changes_of_lasting(unit_columns(n, begin, std::min(n, begin + columns_of_block))));
    for (const StepDerivative &step : steps)
      step.advance_many(blocks);
    DenseMatrix result(n, n);
    for (unsigned int k = 0; k < blocks.size(); ++k)
      add_block(result, lasting(blocks[k]), 0, k * columns_of_block);
    return result;
  }

  DenseVector CycleMap::rate_of_lasting() const
  {
    DenseMatrix column(size(), 1);
    std::copy(mean_rate.begin(), mean_rate.end(), &column(0, 0));
    StateChanges changes = changes_of(column, *loaded);
    const std::vector<unsigned int> of_forces = force_rows(loaded->points);
    DenseMatrix R(of_forces.size(), 1);
    for (unsigned int i = 0; i < of_forces.size(); ++i)
      R(i, 0) = column(of_forces[i], 0) / root_of_flexibility[of_forces[i] - n_motion()];
    changes.shape_force.reinit(loaded->rank(), 1);
    loaded->shapes.basis.Tmmult(changes.shape_force, R);
    return only_column(lasting(changes));
  }

  DenseMatrix CycleMap::one_step(const DynamicState &from, const double step) const
  {
    const auto one = stepper_of(step);
    DynamicState state = from;
    if (!one->advance(state, drive, *create_contact_solver(solver)).converged)
      throw ConvergenceError("the contact of a step from the equilibrium did not converge");
    StepDerivative derivative(*one, pair.poles, state.residual_rate);
    const StepOnPoints on(*one, derivative.points_in_contact());
    derivative.stand_on(on);
    StateChanges changes = changes_of(unit_columns(size(), 0, size()), on);
    derivative.advance(changes);
    return packed(changes, on);
  }

  CycleForces forces_of_period(CycleMap &map, const DenseVector &begin, const double period)
  {
    CycleForces result;
    const std::vector<unsigned int> &points = map.points_that_may_touch();
    result.points = points;
    map.march(begin, period, false,
              [&](const DynamicState &state)
              {
                result.forces.push_back(on_points(state.R, points));
                result.approaches.push_back(state.contact.approach);
              });
    return result;
  }

  std::vector<unsigned int> points_around(const PlacedContacts &contacts, const DenseVector &R,
                                          const unsigned int distance)
  {
    std::vector<bool> chosen(contacts.n_points(), false);
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
    {
      const ContactGrid &grid = contacts.all[k].grid;
      const unsigned int first = contacts.first_point(k);
      const auto near = [&](const unsigned int at, const unsigned int n)
      { return std::make_pair(at > distance ? at - distance : 0u, std::min(n - 1, at + distance)); };
      for (unsigned int i = 0; i < grid.n_points(); ++i)
      {
        if (!(R[first + i] > 0))
          continue;
        const auto [x_low, x_high] = near(i % grid.n_x, grid.n_x);
        const auto [y_low, y_high] = near(i / grid.n_x, grid.n_y);
        for (unsigned int y = y_low; y <= y_high; ++y)
          for (unsigned int x = x_low; x <= x_high; ++x)
            chosen[first + y * grid.n_x + x] = true;
      }
    }
    std::vector<unsigned int> points;
    for (unsigned int i = 0; i < chosen.size(); ++i)
      if (chosen[i])
        points.push_back(i);
    return points;
  }
} // namespace vibrocontact

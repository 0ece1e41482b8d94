#include <vibrocontact/analyses/limit_cycle/cycle_map.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/point_rows.h>
#include <vibrocontact/marching/step_levels.h>

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
        coordinates(pair, points, transient.residual_theta < 1), m(n_steps)
  {
    AssertThrow(n_motion() > 0 && !points.empty(), dealii::ExcInternalError());
    constant_force.reinit(pair.n_modes());
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      constant_force[k] = pair.modal_load[k] + pair.hub_participation(k) * drive.hub_acceleration +
                          pair.force_participation(k) * drive.force;
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      constant_feed.push_back(pair.pole_load[k] + pair.force_into_pole(k) * drive.force);
  }

  DynamicState CycleMap::unpack(const DenseVector &x) const
  {
    DynamicState held;
    held.contact.approach = approach;
    held.hub_acceleration = drive.hub_acceleration;
    held.force = drive.force;
    return coordinates.unpack(x, held);
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

  double CycleMap::growth_taken_by_theta(const double frequency) const
  {
    return transient.growth_taken_by_theta(2 * dealii::numbers::PI * frequency, 1 / (frequency * m));
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
    // that touch at no end of a step
    std::vector<unsigned int> always_open = points;
    const auto contact_solver = create_contact_solver(solver);
    DynamicState state = unpack(x), before;
    DenseVector first, last;
    for (unsigned int j = 0; j < m; ++j)
    {
      before = state;
      const ContactSolution &solution = stepper->advance(state, drive, *contact_solver);
      ++n_marched_steps;
      if (progress)
        progress->advance(0, [this] { return std::to_string(n_marched_steps) + " steps marched"; });
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
        StepEnds both;
        both.q = before.q;
        both.v = before.v;
        both.modal_force = before.modal_force;
        both.modal_force += constant_force;
        both.next_modal_force = state.modal_force;
        both.next_modal_force += constant_force;
        both.poles = before.z;
        both.pole_force = sum(before.pole_force, constant_feed);
        both.next_pole_force = sum(state.pole_force, constant_feed);
        both.residual_rate = state.residual_rate;
        ends.push_back(std::move(both));
      }
      const std::vector<ContactStatus> &status = state.contact.status;
      always_open.erase(std::remove_if(always_open.begin(), always_open.end(),
                                       [&](const unsigned int point)
                                       { return status[point] != ContactStatus::open; }),
                        always_open.end());
      if (keep_derivatives)
        statuses.push_back(status);
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
    for (const unsigned int row : coordinates.rate_rows(always_open))
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
    StateChanges changes = coordinates.changes_of(column, *loaded);
    for (const StepDerivative &step : steps)
      step.advance(changes);
    return only_column(coordinates.packed(changes, *loaded));
  }

  DenseVector CycleMap::by_period() const
  {
    const std::vector<StepDerivative> &steps = derivatives_of_steps();
    const LengthChange longer = {modes_by_length, poles_by_length, 1. / m};
    const double share = 1. / marched.period;
    const std::vector<unsigned int> of_rates = coordinates.rate_rows(loaded->points);
    // the rates of the state are what they are, but go on for longer: as larger ones would; and they are taken over a longer time
    DenseMatrix column(size(), 1);
    for (const unsigned int row : of_rates)
      column(row, 0) = share * marched.start[row];
    StateChanges changes = coordinates.changes_of(column, *loaded);
    for (unsigned int j = 0; j < m; ++j)
      steps[j].advance(changes, &longer, &ends[j]);
    DenseVector result = only_column(coordinates.packed(changes, *loaded));
    for (const unsigned int row : of_rates)
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

  DenseMatrix CycleMap::monodromy() const
  {
    const std::vector<StepDerivative> &steps = derivatives_of_steps();
    const unsigned int n = coordinates.n_lasting(*loaded);
    n_products += n;
    std::vector<StateChanges> blocks;
    for (unsigned int begin = 0; begin < n; begin += columns_of_block)
      blocks.push_back(coordinates.changes_of_lasting(
          unit_columns(n, begin, std::min(n, begin + columns_of_block)), *loaded));
    for (const StepDerivative &step : steps)
      step.advance_many(blocks);
    DenseMatrix result(n, n);
    for (unsigned int k = 0; k < blocks.size(); ++k)
      add_block(result, coordinates.lasting(blocks[k], *loaded), 0, k * columns_of_block);
    return result;
  }

  DenseVector CycleMap::rate_of_lasting() const
  {
    DenseMatrix column(size(), 1);
    std::copy(mean_rate.begin(), mean_rate.end(), &column(0, 0));
    return only_column(coordinates.lasting_of(column, *loaded));
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
    StateChanges changes = coordinates.changes_of(unit_columns(size(), 0, size()), on);
    derivative.advance(changes);
    return coordinates.packed(changes, on);
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

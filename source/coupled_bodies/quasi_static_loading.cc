#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/coupled_bodies/grid_error.h>
#include <vibrocontact/coupled_bodies/quasi_static_loading.h>
#include <vibrocontact/coupled_bodies/sprung_operator.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// compliance of the springs over the tangential one of a point: far above that of the whole contact, so that the far end
    /// goes nearly in proportion to the force, and low enough to leave its digits to the slip
    constexpr double spring_compliance = 10;
    constexpr unsigned int most_rounds = 30;
  } // namespace

  LoadingGrid loading_grid(const ContactPair &pair)
  {
    if (pair.half_spaces)
      return {static_interface(pair),
              std::shared_ptr<const ContactOperator>(pair.half_spaces, &pair.half_spaces->flexibility)};
    return {static_interface(pair), std::make_shared<const DenseContactOperator>(static_compliance(pair))};
  }

  LoadedContact::LoadedContact(const LoadingGrid &grid, const ContactSections &sections,
                               const ContactSolverParameters &parameters,
                               const std::array<bool, 3> &force_given)
      : grid(grid), force_given(force_given), tolerance(parameters.tolerance),
        law(normal_law_of_points(sections, grid.interface.contacts)),
        solver(create_contact_solver(parameters))
  {
    const PlacedContacts &contacts = grid.interface.contacts;
    const unsigned int n = contacts.n_points();
    const DenseMatrix hub = contacts.translation_of(0);
    for (unsigned int d = 0; d < 3; ++d)
    {
      motion[d].reinit(3 * n);
      for (unsigned int row = 0; row < 3 * n; ++row)
        motion[d][row] = hub(row, d);
    }
    compliance =
        spring_compliance * 0.5 * (grid.compliance->mean_diagonal(1) + grid.compliance->mean_diagonal(2));
    std::vector<SprungOperator::Spring> springs;
    for (unsigned int d = 0; d < 2; ++d)
    {
      if (force_given[d])
        springs.push_back({motion[d], compliance});
      by_force[d][d] = compliance;
    }
    problem.title = "quasi-static loading";
    problem.A =
        springs.empty() ? grid.compliance : std::make_shared<const SprungOperator>(grid.compliance, springs);
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
      problem.mu.insert(problem.mu.end(), contacts.all[k].grid.n_points(), sections.all[k].friction);
    problem.normal_law = law;
    problem.by_approach = problem.to_force = motion[2];
    start.reinit(3 * n);
    std::copy(grid.interface.gap.begin(), grid.interface.gap.end(), start.begin());
    // what loads on the bodies do is there from the beginning: along the contact nothing slips by it
    for (unsigned int i = 0; i < n && grid.interface.load_jump.size() > 0; ++i)
      start[i] += grid.interface.load_jump[i];
    // without force: where the first point touches
    now.displacement[2] = *std::min_element(start.begin(), start.begin() + n);
    moved.reinit(3 * n);
    now.solution.R.reinit(3 * n);
    now.solution.y = start;
    now.solution.status.assign(n, ContactStatus::open);
  }

  std::array<double, 3> LoadedContact::force_of(const DenseVector &R) const
  {
    // no -0
    return {{0. - motion[0] * R, 0. - motion[1] * R, motion[2] * R}};
  }

  void LoadedContact::solve(const std::array<double, 3> &place, ContactSolution &state, LoadedState &next)
  {
    problem.b = start;
    problem.b -= moved;
    for (unsigned int d = 0; d < 2; ++d)
      problem.b.add(place[d], motion[d]);
    problem.normal_force = force_given[2] ? place[2] : 0.;
    problem.approach = force_given[2] ? now.displacement[2] : place[2];
    const auto solve_from = [&](ContactSolution from)
    {
      state = std::move(from);
      solver->solve(problem, state);
      ++next.solves;
      next.iterations += state.iterations;
    };
    const ContactSolution before = state;
    solve_from(before);
    // declared, as of rolling: a warm start that fails is followed by a cold one
    if (!state.converged && !before.empty())
    {
      solve_from({});
      ++state.fallbacks;
    }
  }

  bool LoadedContact::find(const std::array<double, 3> &loads, LoadedState &next)
  {
    ContactSolution &state = next.solution;
    // the first step has no start
    if (now.solves == 0)
      state = ContactSolution();
    std::array<double, 3> place = loads;
    const auto goes_on = [&](const std::array<double, 2> &missing)
    {
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int e = 0; e < 2; ++e)
          place[d] += by_force[d][e] * missing[e];
    };
    std::array<double, 2> missing = {{0, 0}};
    for (unsigned int d = 0; d < 2; ++d)
      if (force_given[d])
      {
        place[d] = far_end[d];
        missing[d] = loads[d] - now.force[d];
      }
    goes_on(missing);
    std::array<double, 3> before_place = place, before_force = now.force;
    for (unsigned int round = 0; round < most_rounds; ++round)
    {
      solve(place, state, next);
      if (!state.converged)
      {
        reason = "the contact problem did not converge: residual " + number_text(state.residual) + " after " +
                 std::to_string(state.iterations) + " iterations.";
        return false;
      }
      next.force = force_of(state.R);
      double bound = 0, largest = 0;
      for (unsigned int i = 0; i < problem.n_points(); ++i)
        bound += problem.mu[i] * state.R[i];
      const bool sticks = std::count(state.status.begin(), state.status.end(), ContactStatus::stick) > 0;
      for (unsigned int d = 0; d < 2; ++d)
      {
        missing[d] = force_given[d] ? loads[d] - next.force[d] : 0.;
        largest = std::max(largest, std::abs(missing[d]));
        next.displacement[d] = force_given[d] ? place[d] - compliance * next.force[d] : place[d];
      }
      if (largest <= tolerance * std::max(bound, std::hypot(loads[0], loads[1])))
      {
        for (unsigned int d = 0; d < 2; ++d)
          far_end[d] = place[d];
        next.displacement[2] = state.approach;
        return true;
      }
      if (!sticks && round > 2)
      {
        reason = "all points slip, so that friction, which bears " + number_text(bound) +
                 " N at most, does not carry the driving force (" + number_text(loads[0]) + ", " +
                 number_text(loads[1]) + ") N.";
        return false;
      }
      // Broyden's update of how far ends go with forces
      if (round > 0)
      {
        std::array<double, 2> change = {{0, 0}}, wrong = {{0, 0}};
        double square = 0;
        for (unsigned int d = 0; d < 2; ++d)
          if (force_given[d])
          {
            change[d] = next.force[d] - before_force[d];
            square += change[d] * change[d];
          }
        for (unsigned int d = 0; d < 2; ++d)
          if (force_given[d])
          {
            wrong[d] = place[d] - before_place[d];
            for (unsigned int e = 0; e < 2; ++e)
              wrong[d] -= by_force[d][e] * change[e];
          }
        for (unsigned int d = 0; d < 2 && square > 0; ++d)
          for (unsigned int e = 0; e < 2; ++e)
            by_force[d][e] += wrong[d] * change[e] / square;
      }
      before_place = place;
      before_force = next.force;
      goes_on(missing);
    }
    reason = "the hub's place under the driving force was not found in " + std::to_string(most_rounds) +
             " solutions.";
    return false;
  }

  void LoadedContact::account(LoadedState &next)
  {
    const unsigned int n = problem.n_points();
    const ContactSolution &solution = next.solution;
    next.dissipated = 0;
    for (unsigned int row = n; row < 3 * n; ++row)
    {
      next.dissipated -= solution.R[row] * solution.y[row];
      moved[row] += solution.y[row];
    }
    next.dissipated_sum += next.dissipated;
    for (unsigned int d = 0; d < 3; ++d)
      next.work_sum += 0.5 * (now.force[d] + next.force[d]) * (next.displacement[d] - now.displacement[d]);
    DenseVector jump;
    grid.compliance->vmult(jump, solution.R, loaded_points(solution.R, n));
    next.stored = 0.5 * (solution.R * jump);
    for (unsigned int i = 0; i < n; ++i)
      next.stored += law[i].potential(solution.y[i]);
  }

  bool LoadedContact::load(const std::array<double, 3> &loads)
  {
    const auto begin = WallClock::now();
    LoadedState next = now;
    next.solves = next.iterations = 0;
    reason.clear();
    bool found = false;
    try
    {
      found = find(loads, next);
    }
    catch (const ConvergenceError &error)
    {
      reason = error.what();
    }
    if (!found)
      return false;
    account(next);
    next.seconds = seconds_since(begin);
    now = std::move(next);
    return true;
  }

  namespace
  {
    /// What answers to loads on both grids.
    class GridErrors
    {
    public:
      explicit GridErrors(const std::array<bool, 3> &force_given) : force_given(force_given) {}

      void add(const LoadedState &own, const LoadedState &coarse)
      {
        for (unsigned int d = 0; d < 3; ++d)
        {
          const auto answer = answer_along(d);
          difference[d] = std::max(difference[d], std::abs((own.*answer)[d] - (coarse.*answer)[d]));
          // what answers across a load counts by what there is along it
          for (unsigned int e = d < 2 ? 0 : 2; e < (d < 2 ? 2u : 3u); ++e)
            largest[d] = std::max(largest[d], std::abs((own.*answer)[e]));
        }
        dissipated = own.dissipated_sum;
        difference_dissipated =
            std::max(difference_dissipated, std::abs(own.dissipated_sum - coarse.dissipated_sum));
      }

      void state(LoadingResult &result) const
      {
        for (unsigned int d = 0; d < 3; ++d)
          result.errors[d] = largest[d] > 0 ? difference[d] / largest[d] : 0.;
        result.dissipated_error = dissipated > 0 ? difference_dissipated / dissipated : 0.;
      }

    private:
      std::array<double, 3> LoadedState::*answer_along(const unsigned int d) const
      {
        return force_given[d] ? &LoadedState::displacement : &LoadedState::force;
      }

      const std::array<bool, 3> force_given;
      std::array<double, 3> largest = {{0, 0, 0}}, difference = {{0, 0, 0}};
      double dissipated = 0, difference_dissipated = 0;
    };
  } // namespace

  LoadingResult quasi_static_loading(const LoadHistory &history, const ContactSections &sections,
                                     const ContactSolverParameters &solver, const LoadingGrids &grids,
                                     const std::function<void(unsigned int, const LoadedContact &)> &finished)
  {
    LoadedContact own(grids.own, sections, solver, history.force_given);
    std::optional<LoadedContact> coarse;
    LoadingResult result;
    if (grids.coarse)
      coarse.emplace(*grids.coarse, sections, solver, history.force_given);
    else
      result.error_not_known = "there is no coarser grid";
    GridErrors errors(history.force_given);
    for (unsigned int k = 0; k < history.steps.size(); ++k)
    {
      const std::array<double, 3> &load = history.steps[k].load;
      if (!own.load(load))
      {
        result.failure = own.failure();
        break;
      }
      try
      {
        check_contact_in_grid(grids.own.interface.contacts, sections, 0, own.state().solution.status);
      }
      catch (const InputError &error)
      {
        if (k == 0)
          throw;
        // steps before are worth keeping
        result.failure = error.what();
        break;
      }
      if (coarse && result.error_not_known.empty())
      {
        if (!coarse->load(load))
          result.error_not_known = "the coarser grid has no solution of step " + std::to_string(k + 1);
        else
        {
          const auto &status = coarse->state().solution.status;
          const unsigned int touching =
              status.size() - std::count(status.begin(), status.end(), ContactStatus::open);
          const std::string too_few = touching > 0 ? too_few_coarse_points(touching) : "";
          if (!too_few.empty())
            result.error_not_known = too_few + " in step " + std::to_string(k + 1);
          errors.add(own.state(), coarse->state());
        }
      }
      ++result.steps_done;
      finished(k, own);
    }
    result.last = own.state();
    if (result.error_not_known.empty() && result.steps_done > 0)
      errors.state(result);
    return result;
  }
} // namespace vibrocontact

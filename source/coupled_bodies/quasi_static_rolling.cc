#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/shared_cases.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/coupled_bodies/grid_error.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// @param first its first point
    ContactResultants resultants(const PlacedContact &contact, const unsigned int first,
                                 const double friction, const std::vector<double> &gap,
                                 const ContactSolution &solution)
    {
      const ContactGrid &grid = contact.grid;
      const unsigned int n = solution.status.size();
      ContactResultants result;
      result.friction = friction;
      double least = gap[first];
      for (unsigned int i = 0; i < grid.n_points(); ++i)
      {
        const unsigned int point = first + i;
        const double N = solution.R[point], Tx = solution.R[n + point], Ty = solution.R[2 * n + point];
        result.normal_force += N;
        result.tangential_force[0] += Tx;
        result.tangential_force[1] += Ty;
        result.spin_moment += grid.x(i) * Ty - grid.y(i) * Tx;
        result.max_pressure = std::max(result.max_pressure, N / grid.cell_area());
        result.stick_points += solution.status[point] == ContactStatus::stick;
        result.slip_points += solution.status[point] == ContactStatus::slip;
        least = std::min(least, gap[point]);
      }
      result.contact_points = result.stick_points + result.slip_points;
      result.utilisation =
          utilisation(result.tangential_force[0], result.tangential_force[1], friction * result.normal_force);
      // how far body 1 has moved against the normal
      const double moved = contact.above == 0 ? 1 : contact.below == 0 ? -1 : 0;
      result.approach = moved * contact.frame.axes[0][2] * solution.approach - least;
      return result;
    }

    RollingResult resultants(const RollingCase &rolling_case, const ContactInterface &interface,
                             const ContactSections &sections, ContactSolution solution)
    {
      const PlacedContacts &contacts = interface.contacts;
      RollingResult result;
      result.rolling_case = rolling_case;
      result.friction = sections.first().friction;
      std::vector<std::array<double, 3>> forces;
      double bound = 0;
      for (unsigned int k = 0; k < contacts.all.size(); ++k)
      {
        const PlacedContact &contact = contacts.all[k];
        result.contacts.push_back(
            resultants(contact, contacts.first_point(k), sections.all[k].friction, interface.gap, solution));
        const ContactResultants &one = result.contacts.back();
        forces.push_back({{one.normal_force, one.tangential_force[0], one.tangential_force[1]}});
        result.max_pressure = std::max(result.max_pressure, one.max_pressure);
        result.stick_points += one.stick_points;
        result.slip_points += one.slip_points;
        result.contact_points += one.contact_points;
        const double sign = contact.above == 0 ? 1 : contact.below == 0 ? -1 : 0;
        if (sign == 0)
          continue;
        bound += one.friction * one.normal_force;
        // about the z axis of body 1
        const std::array<double, 3> &origin = sign > 0 ? contact.frame.origin : contact.origin_below;
        std::array<double, 3> there = {{0, 0, 0}};
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int d = 0; d < 3; ++d)
            there[d] += sign * contact.frame.axes[c][d] * forces.back()[c];
        result.spin_moment +=
            sign * contact.frame.axes[0][2] * one.spin_moment + origin[0] * there[1] - origin[1] * there[0];
      }
      const std::array<double, 3> force = contacts.force_on(0, forces);
      result.normal_force = force[2];
      result.tangential_force[0] = force[0];
      result.tangential_force[1] = force[1];
      result.utilisation = utilisation(force[0], force[1], bound);
      result.approach = solution.approach - *std::min_element(interface.gap.begin(), interface.gap.end());
      result.solution = std::move(solution);
      return result;
    }

    /// What stands for a solution that the solver did not find: no forces, and a residual as wrong as can be.
    ContactSolution no_solution(const ContactProblem &problem)
    {
      ContactSolution none;
      none.R.reinit(3 * problem.n_points());
      none.y.reinit(3 * problem.n_points());
      none.status.assign(problem.n_points(), ContactStatus::open);
      none.approach = problem.approach;
      none.residual = 1;
      return none;
    }

    /// Longer chunks save cold starts (one more iteration or two), shorter ones are shared more evenly.
    constexpr unsigned int cases_per_chunk = 4;

    /// What all cases have in common.
    struct RollingSweep
    {
      const RollingParameters &rolling;
      const ContactSections &contact;
      const ContactSolverParameters &solver_parameters;
      const std::vector<RollingCase> cases;

      /// With the friction of a case, if that is swept.
      ContactSections sections(const unsigned int k) const
      {
        return rolling.sweep.friction.empty() ? contact : contact.with_friction(cases[k].friction);
      }
    };

    /// One of the grids, with its operator.
    struct SweptGrid
    {
      const RollingSweep &sweep;
      const RollingGrid &grid;
      const std::shared_ptr<const ContactOperator> A = grid.operator_at(sweep.rolling.creepage.speed);

      bool corrects_edge() const { return grid.edge[0] > 0 && sweep.rolling.creepage.speed > 0; }

      LeadingEdge edge(const ContactSolution &normal) const
      {
        return LeadingEdge(grid.interface.contacts.only(), grid.edge, sweep.rolling.creepage.speed, *A,
                           normal);
      }

      ContactProblem problem(const unsigned int k) const
      {
        const RollingCase &one = sweep.cases[k];
        ContactProblem result =
            rolling_problem(A, grid.interface, grid.scheme, one.creepage, sweep.sections(k));
        result.title = "case " + std::to_string(k) + " of quasi-static rolling";
        result.normal_force = one.normal_force;
        result.approach = one.hub_displacement;
        return result;
      }

      /// The problem that a result has solved.
      ContactProblem problem(const unsigned int k, const RollingResult &solved) const
      {
        ContactProblem result = problem(k);
        if (corrects_edge() && !solved.solution.empty())
          edge(solved.solution).without_weights().add_to(result);
        result.mu = solved.point_friction;
        return result;
      }
    };

    /// Solves with the leading edge of its own normal solution: that without friction to begin with, which
    /// tangential forces hardly change, if at all.
    /// If the rounds end before the edge is that of its own solution, that of the round before stands, declared as a fallback.
    void solve_with_edge(const SweptGrid &grid, ContactProblem &problem, ContactSolver &solver,
                         ContactSolution &state)
    {
      constexpr unsigned int max_rounds = 5;
      SolverCost cost;
      const auto count = [&] { state.cost() = cost += state.cost(); };
      if (state.empty())
      {
        ContactProblem frictionless = problem;
        frictionless.friction_law = {};
        frictionless.mu.assign(problem.mu.size(), 0.);
        solver.solve(frictionless, state);
        count();
      }
      LeadingEdge edge = grid.edge(state);
      for (unsigned int round = 0; round < max_rounds; ++round)
      {
        ContactProblem with_edge = problem;
        edge.add_to(with_edge);
        solve_with_friction_of_speed(with_edge, solver, state,
                                     [&](ContactSolution solution)
                                     {
                                       edge.take_weights(solution.y);
                                       return slip_speed(solution);
                                     });
        edge.take_weights(state.y);
        problem.mu = with_edge.mu;
        count();
        const LeadingEdge next = grid.edge(state);
        if (!state.converged || next.equals(edge))
          return;
        edge = next;
      }
      ++state.fallbacks;
    }

    /// The cases of a chunk on one grid, one after the other.
    class GridChunk
    {
    public:
      /// @param is_own whether its contact has to keep away from the sides of the grid
      GridChunk(const SweptGrid &grid, const bool is_own)
          : grid(grid), sweep(grid.sweep), is_own(is_own),
            solver(create_contact_solver(sweep.solver_parameters))
      {
      }

      const RollingResult &solve(const unsigned int k)
      {
        const RollingCase &one = sweep.cases[k];
        ContactProblem problem;
        const bool continues = !last.solution.empty() && last.rolling_case.curve == one.curve &&
                               last.rolling_case.friction == one.friction && last.solution.converged;
        std::string failure;
        const auto solve_from = [&](ContactSolution state)
        {
          const auto begin = WallClock::now();
          failure.clear();
          // friction that falls with the speed changes the problem on the way
          problem = grid.problem(k);
          try
          {
            if (grid.corrects_edge())
              solve_with_edge(grid, problem, *solver, state);
            else
              solve_with_friction_of_speed(problem, *solver, state);
          }
          catch (const ConvergenceError &error)
          {
            failure = error.what();
            state = no_solution(problem);
          }
          state.seconds = seconds_since(begin);
          return state;
        };
        ContactSolution solution = solve_from(continues ? last.solution : ContactSolution());
        if (continues && !solution.converged)
        {
          // declared: a warm start that fails is followed by a cold one, and counts as a fallback
          const ContactSolution warm = solution;
          solution = solve_from({});
          solution.fallbacks += warm.fallbacks + 1;
          solution.iterations += warm.iterations;
          solution.seconds += warm.seconds;
        }
        if (solution.converged && is_own)
          try
          {
            check_contact_in_grid(grid.grid.interface.contacts, sweep.contact, sweep.rolling.creepage.speed,
                                  solution.status);
          }
          catch (const InputError &error)
          {
            // in a sweep the other cases are worth keeping
            if (sweep.cases.size() == 1)
              throw;
            failure = error.what();
            solution.converged = false;
          }
        last = resultants(one, grid.grid.interface, sweep.sections(k), std::move(solution));
        last.failure = failure;
        last.point_friction = problem.mu;
        return last;
      }

    private:
      const SweptGrid &grid;
      const RollingSweep &sweep;
      const bool is_own;
      const std::unique_ptr<ContactSolver> solver;
      RollingResult last;
    };

    /// The cases of a chunk on all grids.
    class RollingChunk
    {
    public:
      RollingChunk(const RollingGrids &grids, const SweptGrid &own, const SweptGrid *coarse)
          : grids(grids), own(own, true)
      {
        if (coarse)
          rough.emplace(*coarse, false);
      }

      RollingResult solve(const unsigned int k)
      {
        RollingResult result = own.solve(k);
        const auto not_known = [&](const std::string &reason)
        {
          result.error_not_known = reason;
          for (ContactResultants &one : result.contacts)
            one.error_not_known = reason;
        };
        if (!rough)
        {
          not_known("there is no coarser grid");
          return result;
        }
        const RollingResult &other = rough->solve(k);
        result.solution.seconds += other.solution.seconds;
        const bool is_open = starts_open(grids.coarse->interface.contacts, other);
        if (other.solution.converged && is_open)
          take_coarse(grids, other, result);
        else
        {
          not_known(other.solution.converged ? "the contact on the coarser grid reaches its upstream side"
                                             : "the coarser grid has no solution");
          if (grids.extrapolates && result.solution.converged)
          {
            result.solution.converged = false;
            result.failure = "the coarser of the two grids gives no solution to extrapolate with" +
                             (other.failure.empty() ? "." : ": " + other.failure);
          }
        }
        return result;
      }

    private:
      const RollingGrids &grids;
      GridChunk own;
      std::optional<GridChunk> rough;
    };
  } // namespace

  std::vector<RollingResult>
  quasi_static_rolling(const RollingParameters &rolling, const ContactSections &contact,
                       const ContactSolverParameters &solver_parameters, const RollingGrids &grids,
                       const std::function<void(const RollingResult &, const ContactProblem &)> &finished,
                       const MPI_Comm communicator)
  {
    const RollingSweep sweep = {rolling, contact, solver_parameters, rolling_cases(rolling, contact)};
    const SweptGrid own = {sweep, grids.own};
    std::optional<const SweptGrid> coarse;
    if (grids.coarse)
      coarse.emplace(SweptGrid{sweep, *grids.coarse});
    std::vector<RollingResult> results;
    share_cases<RollingResult>(
        sweep.cases.size(), cases_per_chunk,
        [&]
        {
          return [chunk = std::make_shared<RollingChunk>(grids, own, coarse ? &*coarse : nullptr)](
                     const unsigned int k) { return chunk->solve(k); };
        },
        [&](const unsigned int k, const std::function<RollingResult()> &solved)
        {
          results.push_back(solved());
          finished(results.back(), own.problem(k, results.back()));
        },
        communicator);
    return results;
  }

  std::vector<RollingResult>
  quasi_static_rolling(const RollingParameters &rolling, const ContactSections &contact,
                       const ContactSolverParameters &solver_parameters, const ContactInterface &interface,
                       const std::function<std::shared_ptr<const ContactOperator>(double)> &operator_at,
                       const std::function<void(const RollingResult &, const ContactProblem &)> &finished,
                       const MPI_Comm communicator)
  {
    RollingGrids grids;
    grids.own = {interface, operator_at, find_creep_scheme(contact.first().creep_scheme)};
    return quasi_static_rolling(rolling, contact, solver_parameters, grids, finished, communicator);
  }
} // namespace vibrocontact

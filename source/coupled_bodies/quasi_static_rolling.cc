#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/shared_cases.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace vibrocontact
{
  void RollingParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const auto list = [](const double low, const double high = Double::max_double_value)
    { return List(Double(low, high), 0, 10000); };
    const List positive_or_empty(Double(1e-30, 1e15), 0, 1);
    prm.add_parameter(
        "Normal force", normal_force,
        "Resultant normal force, or empty if the hub displacement is given. In a modal convolution "
        "that with which a flat road presses at rest, in place of Road/Indentation. Units: N.",
        positive_or_empty);
    prm.add_parameter("Hub displacement", hub_displacement,
                      "Downward displacement of the hub of body 1 (approach of half-spaces) from the "
                      "position in which the bodies touch "
                      "at the nominal contact point, or empty "
                      "if the normal force is given. Units: m.",
                      positive_or_empty);
    prm.add_parameter("Speed", creepage.speed,
                      "Rolling speed; 0 in a transient or with a Sliding velocity. Units: m/s.",
                      Double(0, 1000));
    prm.add_parameter("Longitudinal creepage", creepage.longitudinal,
                      "Velocity of body 1 minus body 2 along x over the speed. Units: none.", Double(-1, 1));
    prm.add_parameter("Lateral creepage", creepage.lateral,
                      "Velocity of body 1 minus body 2 along y over the speed. Units: none.", Double(-1, 1));
    prm.add_parameter("Spin", creepage.spin,
                      "Rotation of body 1 against body 2 about +z over the speed. Units: 1/m.",
                      Double(-1000, 1000));
    prm.add_parameter("Sliding velocity x", creepage.sliding_x,
                      "Velocity of body 1 minus body 2 along x beside the creepage. Units: m/s.",
                      Double(-1000, 1000));
    prm.add_parameter("Sliding velocity y", creepage.sliding_y,
                      "Velocity of body 1 minus body 2 along y beside the creepage. Units: m/s.",
                      Double(-1000, 1000));
    prm.add_parameter(
        "Hub", hub,
        "The hub of body 1 in stability and transient, after the load has found its place: held "
        "there; massless: it follows under the constant normal force; suspended: section "
        "Suspension; axle: sections Axle and Suspension. Half-spaces have none. Units: none.",
        Selection("held|massless|suspended|axle"));
    prm.enter_subsection("Suspension");
    suspension.declare_parameters(prm);
    prm.leave_subsection();
    prm.enter_subsection("Axle");
    axle.declare_parameters(prm);
    prm.leave_subsection();
    prm.enter_subsection("Sweep");
    prm.add_parameter("Longitudinal creepage", sweep.longitudinal,
                      "Values of one curve, all other entries at their single values. Units: none.",
                      list(-1, 1));
    prm.add_parameter("Lateral creepage", sweep.lateral,
                      "Values of one curve, all other entries at their single values. Units: none.",
                      list(-1, 1));
    prm.add_parameter("Spin", sweep.spin,
                      "Values of one curve, all other entries at their single values. Units: 1/m.",
                      list(-1000, 1000));
    prm.add_parameter("Normal force", sweep.normal_force,
                      "Values of one curve, all other entries at their single values. Units: N.", list(0));
    prm.add_parameter("Hub displacement", sweep.hub_displacement,
                      "Values of one curve, all other entries at their single values. Units: m.", list(-1));
    prm.add_parameter("Friction coefficient", sweep.friction,
                      "Every curve is repeated for these, which take the place of Contact/Friction "
                      "coefficient. Units: none.",
                      list(0, 10));
    prm.leave_subsection();
  }

  std::vector<std::string> RollingParameters::Sweep::given() const
  {
    std::vector<std::string> names;
    for (const auto &[name, values] :
         {std::make_pair("Longitudinal creepage", &longitudinal),
          std::make_pair("Lateral creepage", &lateral), std::make_pair("Spin", &spin),
          std::make_pair("Normal force", &normal_force),
          std::make_pair("Hub displacement", &hub_displacement),
          std::make_pair("Friction coefficient", &friction)})
      if (!values->empty())
        names.push_back(std::string("Rolling/Sweep/") + name);
    return names;
  }

  void RollingParameters::check(const bool frictionless) const
  {
    if (!frictionless && !(creepage.speed > 0) && creepage.sliding_x == 0 && creepage.sliding_y == 0)
      throw InputError(
          "Entry Rolling/Speed is 0 and there is no Sliding velocity: nothing moves; steady rolling "
          "needs one of them (pressing alone needs a friction coefficient of 0).");
    const auto name = [](const std::vector<double> &single, const std::string &entry)
    { return (single.empty() ? "Rolling/Sweep/" : "Rolling/") + entry; };
    const bool force = !normal_force.empty() || !sweep.normal_force.empty();
    const bool displacement = !hub_displacement.empty() || !sweep.hub_displacement.empty();
    if (force && displacement)
      throw InputError(name(normal_force, "Normal force") + " and " +
                       name(hub_displacement, "Hub displacement") +
                       " are both given, but one follows from the other: empty one of them.");
    if (!force && !displacement)
      throw InputError("Rolling/Normal force and Rolling/Hub displacement are neither of them given: set one "
                       "of them.");
    if (normal_force.empty() && hub_displacement.empty() &&
        !(sweep.longitudinal.empty() && sweep.lateral.empty() && sweep.spin.empty()))
      throw InputError("Rolling/Sweep lists a creepage, but there is no load for these curves: set "
                       "Rolling/Normal force or Rolling/Hub displacement beside the sweep.");
    for (const double value : sweep.normal_force)
      if (!(value > 0))
        throw InputError("Rolling/Sweep/Normal force lists a force that is not positive: take it out.");
  }

  std::vector<RollingCase> rolling_cases(const RollingParameters &rolling, const ContactSections &sections)
  {
    const ContactParameters &contact = sections.first();
    RollingCase base;
    base.curve = "single";
    base.creepage = rolling.creepage;
    base.friction = contact.friction;
    base.normal_force = rolling.normal_force.empty() ? 0. : rolling.normal_force.front();
    base.hub_displacement = rolling.hub_displacement.empty() ? 0. : rolling.hub_displacement.front();

    const std::vector<double> frictions =
        rolling.sweep.friction.empty() ? std::vector<double>{contact.friction} : rolling.sweep.friction;
    std::vector<RollingCase> cases;
    const auto add_curve = [&](const std::string &name, const std::vector<double> &values,
                               const std::function<void(RollingCase &, double)> &set)
    {
      for (const double friction : values.empty() ? std::vector<double>() : frictions)
        for (const double value : values)
        {
          RollingCase one = base;
          one.curve = name;
          one.friction = friction;
          set(one, value);
          cases.push_back(one);
        }
    };
    const RollingParameters::Sweep &sweep = rolling.sweep;
    add_curve("Longitudinal creepage", sweep.longitudinal,
              [](RollingCase &c, const double value) { c.creepage.longitudinal = value; });
    add_curve("Lateral creepage", sweep.lateral,
              [](RollingCase &c, const double value) { c.creepage.lateral = value; });
    add_curve("Spin", sweep.spin, [](RollingCase &c, const double value) { c.creepage.spin = value; });
    add_curve("Normal force", sweep.normal_force,
              [](RollingCase &c, const double value) { c.normal_force = value; });
    add_curve("Hub displacement", sweep.hub_displacement,
              [](RollingCase &c, const double value) { c.hub_displacement = value; });
    if (cases.empty())
      add_curve(rolling.sweep.friction.empty() ? "single" : "Friction coefficient", {0.},
                [](RollingCase &, double) {});
    return cases;
  }

  namespace
  {
    double utilisation(const double Tx, const double Ty, const double bound)
    {
      return bound > 0 ? std::hypot(Tx, Ty) / bound : 0;
    }

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
      const ContactInterface &interface;
      const CreepScheme &scheme;
      const std::shared_ptr<const ContactOperator> A;
      const std::vector<RollingCase> cases;

      /// With the friction of a case, if that is swept.
      ContactSections sections(const unsigned int k) const
      {
        return rolling.sweep.friction.empty() ? contact : contact.with_friction(cases[k].friction);
      }

      ContactProblem problem(const unsigned int k) const
      {
        const RollingCase &one = cases[k];
        ContactProblem result = rolling_problem(A, interface, scheme, one.creepage, sections(k));
        result.title = "case " + std::to_string(k) + " of quasi-static rolling";
        result.normal_force = one.normal_force;
        result.approach = one.hub_displacement;
        return result;
      }
    };

    /// The cases of a chunk, one after the other.
    class RollingChunk
    {
    public:
      explicit RollingChunk(const RollingSweep &sweep)
          : sweep(sweep), solver(create_contact_solver(sweep.solver_parameters))
      {
      }

      RollingResult solve(const unsigned int k)
      {
        const RollingCase &one = sweep.cases[k];
        ContactProblem problem = sweep.problem(k);
        const bool continues = !last.solution.empty() && last.rolling_case.curve == one.curve &&
                               last.rolling_case.friction == one.friction && last.solution.converged;
        std::string failure;
        const auto solve_from = [&](ContactSolution state)
        {
          const auto begin = std::chrono::steady_clock::now();
          failure.clear();
          try
          {
            solve_with_friction_of_speed(problem, *solver, state);
          }
          catch (const ConvergenceError &error)
          {
            failure = error.what();
            state = no_solution(problem);
          }
          state.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
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
        if (solution.converged)
          try
          {
            check_contact_in_grid(sweep.interface.contacts, sweep.contact, sweep.rolling.creepage.speed,
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
        last = resultants(one, sweep.interface, sweep.sections(k), std::move(solution));
        last.failure = failure;
        last.point_friction = problem.mu;
        return last;
      }

    private:
      const RollingSweep &sweep;
      const std::unique_ptr<ContactSolver> solver;
      RollingResult last;
    };
  } // namespace

  std::vector<RollingResult>
  quasi_static_rolling(const RollingParameters &rolling, const ContactSections &contact,
                       const ContactSolverParameters &solver_parameters, const ContactInterface &interface,
                       const std::function<std::shared_ptr<const ContactOperator>(double)> &operator_at,
                       const std::function<void(const RollingResult &, const ContactProblem &)> &finished,
                       const MPI_Comm communicator)
  {
    const RollingSweep sweep = {rolling,
                                contact,
                                solver_parameters,
                                interface,
                                find_creep_scheme(contact.first().creep_scheme),
                                operator_at(rolling.creepage.speed),
                                rolling_cases(rolling, contact)};
    std::vector<RollingResult> results;
    share_cases<RollingResult>(
        sweep.cases.size(), cases_per_chunk,
        [&] {
          return [chunk = std::make_shared<RollingChunk>(sweep)](const unsigned int k)
          { return chunk->solve(k); };
        },
        [&](const unsigned int k, const std::function<RollingResult()> &solved)
        {
          results.push_back(solved());
          ContactProblem problem = sweep.problem(k);
          problem.mu = results.back().point_friction;
          finished(results.back(), problem);
        },
        communicator);
    return results;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/bordered_cycle.h>
#include <vibrocontact/analyses/limit_cycle/cycle_equations.h>
#include <vibrocontact/analyses/limit_cycle/cycle_start.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/wall_clock.h>

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  namespace
  {
    /// periods that are marched where Newton's method led nowhere, before it begins again
    constexpr unsigned int periods_between[] = {12, 36, 108};

    /// How a state for Newton's method to start from is made.
    struct Start
    {
      std::string name;
      std::function<void()> make;
    };
    /// what is left of a change over a period where rounding may be the reason
    constexpr double nearly_closed = 1e-8;
    /// of a disturbance along the motion in a period
    constexpr double most_change_along = 1e-2;

    /// Newton's method from a state and a period, which the cycle has in the end.
    NewtonResult close_cycle(CycleEquations &equations, const unsigned int max_iterations,
                             const DenseVector &state, const double period, LimitCycle &cycle)
    {
      NewtonSettings settings;
      settings.max_iterations = max_iterations;
      std::vector<double> x(state.begin(), state.end());
      x.push_back(period);
      const NewtonResult result = solve_by_newton(equations, settings, x);
      cycle.converged = result.converged;
      cycle.newton_iterations += result.iterations;
      cycle.residual.reset();
      if (result.is_evaluated())
        cycle.residual = result.size;
      cycle.state = DenseVector(x.begin(), x.end() - 1);
      cycle.period = x.back();
      return result;
    }

    /// Whether a point that was open at the end of a step sticks at that of the next one, the last step before the first.
    bool sticks_at_touch(const std::vector<std::vector<ContactStatus>> &statuses)
    {
      for (std::size_t j = 0; j < statuses.size(); ++j)
      {
        const std::vector<ContactStatus> &before = statuses[j == 0 ? statuses.size() - 1 : j - 1];
        for (std::size_t i = 0; i < before.size(); ++i)
          if (before[i] == ContactStatus::open && statuses[j][i] == ContactStatus::stick)
            return true;
      }
      return false;
    }

    constexpr char led_to_rest[] = "Newton's method led to the equilibrium";

    double distance(const DenseVector &state, const DenseVector &other)
    {
      DenseVector difference = state;
      difference -= other;
      return difference.l2_norm();
    }

    std::string left_over(const double residual)
    {
      return "Newton's method ended at a change over a period of " + number_text(residual) + " of the motion";
    }

    std::unique_ptr<const DenseMatrix> linear_cycle_of(const CycleMap &map, const DynamicState &equilibrium,
                                                       const double period)
    {
      return linear_cycle(map.one_step(equilibrium, period / map.n_steps()), map.n_steps());
    }
  } // namespace

  unsigned int steps_of_period(const StabilityRoot &root, const LimitCycleParameters &parameters)
  {
    return std::max<unsigned int>(least_steps_of_period,
                                  std::ceil(1 / (root.frequency * parameters.time_step) - 1e-9));
  }

  void judge_cycle(CycleMap &map, const LimitCycleParameters &parameters, LimitCycle &cycle)
  {
    const auto begin = WallClock::now();
    cycle.message.clear();
    cycle.not_judged.clear();
    const auto is_off = [&](const std::string &what, const std::string &advice)
    {
      cycle.stability.reset();
      // what the steps change shows whether it is a motion
      if (parameters.error_estimate && sticks_at_touch(map.statuses()))
      {
        cycle.not_judged = what + ": the slip of a point that touches down and sticks within one step is "
                                  "counted from the beginning of that step, however short it is";
        return;
      }
      cycle.converged = false;
      cycle.message = what + ": " + advice;
    };
    try
    {
      map.march(cycle.state, cycle.period, true);
      cycle.change_along = map.change_along_motion();
      if (!(cycle.change_along <= most_change_along))
      {
        is_off("in the motion that repeats itself a disturbance along it changes by " +
                   number_text(cycle.change_along) + " of itself in a period",
               "take a shorter Limit cycle/Time step");
        return;
      }
      if (parameters.n_multipliers > 0)
        cycle.stability = cycle_stability(map.monodromy(), map.rate_of_lasting(), cycle.period);
      if (cycle.stability && !(cycle.stability->trivial_error <= most_change_along))
        is_off("the multiplier of a shift along the motion is off by " +
                   number_text(cycle.stability->trivial_error) + ", so that the others are not known either",
               "take a shorter Limit cycle/Time step, or leave the Multipliers out");
    }
    catch (const ConvergenceError &error)
    {
      cycle.converged = false;
      cycle.message = std::string("its stability was not found: ") + error.what();
    }
    cycle.stability_seconds = seconds_since(begin);
  }

  LimitCycle find_limit_cycle(CycleMap &map, const ContactPair &pair, const DynamicState &equilibrium,
                              const StabilityRoot &root, const LimitCycleParameters &parameters,
                              const DynamicState *const from)
  {
    const auto begin = WallClock::now();
    LimitCycle cycle;
    cycle.root = root;
    cycle.n_steps = map.n_steps();
    cycle.period = 1 / root.frequency;
    if (root.frequency * parameters.time_step * least_steps_of_period > 1 + 1e-9)
    {
      cycle.message = "Limit cycle/Time step is more than an eighth of its period, which is " +
                      number_text(cycle.period) + " s: take a shorter one";
      return cycle;
    }
    if (const double taken = map.growth_taken_by_theta(root.frequency);
        taken > root.growth && root.growth > 0)
    {
      cycle.message =
          "Transient/Theta takes " + number_text(taken) + " 1/s from a root that grows by " +
          number_text(root.growth) +
          " 1/s: set it to 0.5 or Transient/Integrator to exact propagator, or take a shorter Limit "
          "cycle/Time step";
      return cycle;
    }
    // who starts from a motion knows more of it
    const std::string where_else =
        from ? ""
             : " (Limit cycle/Start = end of transient begins at a motion that is there; shorter steps may "
               "lead elsewhere, too)";
    try
    {
      const RootMotion motion(map, pair, equilibrium, root);
      const std::unique_ptr<const DenseMatrix> linear = linear_cycle_of(map, equilibrium, cycle.period);
      CycleEquations equations(map, map.pack(equilibrium), *linear, parameters.tolerance);
      // by harmonics or a given motion first, then by motions that go on for a while
      std::optional<CycleStart> given, start;
      if (from)
        given = start_at(map, motion, root, *from);
      std::vector<Start> starts = {{"harmonic balance",
                                    [&]
                                    {
                                      start = given ? start_by_harmonics_of(map, motion, root, equilibrium,
                                                                            *given)
                                                    : start_by_harmonics(map, motion, root, equilibrium);
                                    }},
                                   {given ? "the motion given" : "a few periods",
                                    [&] { start = given ? *given : start_of_cycle(map, motion, root); }}};
      for (const unsigned int n : periods_between)
        starts.push_back(
            {std::to_string(n) + " periods more", [&, n] { let_go_on(map, motion, n, *start); }});
      for (const Start &one : starts)
      {
        one.make();
        if (!start)
          continue;
        cycle.started_by = one.name;
        const NewtonResult result =
            close_cycle(equations, parameters.max_newton_iterations, start->state, start->period, cycle);
        // rest repeats itself as well; what is left there is rounding
        if (cycle.converged && motion.velocity_in(cycle.state) < 1e-3 * start->velocity)
        {
          cycle.converged = false;
          cycle.message = led_to_rest + where_else;
        }
        else if (!cycle.converged && !cycle.residual)
          cycle.message = "no period could be marched from the start: " + equations.failure;
        else if (!cycle.converged)
          cycle.message =
              left_over(*cycle.residual) +
              (result.iterations == parameters.max_newton_iterations
                   ? " after as many iterations as Limit cycle/Max Newton iterations allows"
               : *cycle.residual < nearly_closed ? ", near what rounding permits: raise Limit cycle/Tolerance"
                                                 : where_else) +
              (equations.failure.empty() ? "" : ": " + equations.failure);
        if (cycle.converged)
          break;
      }
    }
    catch (const ConvergenceError &error)
    {
      cycle.message = error.what();
    }
    cycle.seconds = seconds_since(begin);
    if (cycle.converged)
      judge_cycle(map, parameters, cycle);
    cycle.n_products = map.n_products;
    cycle.n_marched_steps = map.n_marched_steps;
    return cycle;
  }

  LimitCycle find_again(CycleMap &map, const DynamicState &equilibrium, const LimitCycle &like,
                        const LimitCycleParameters &parameters)
  {
    const auto begin = WallClock::now();
    LimitCycle cycle;
    cycle.root = like.root;
    cycle.motion = like.motion;
    cycle.n_steps = map.n_steps();
    try
    {
      const std::unique_ptr<const DenseMatrix> linear = linear_cycle_of(map, equilibrium, like.period);
      CycleEquations equations(map, map.pack(equilibrium), *linear, parameters.tolerance);
      close_cycle(equations, parameters.max_newton_iterations, like.state, like.period, cycle);
      const DenseVector rest = map.pack(equilibrium);
      if (!cycle.converged)
        cycle.message =
            !equations.failure.empty() || !cycle.residual ? equations.failure : left_over(*cycle.residual);
      if (distance(cycle.state, rest) < 1e-3 * distance(like.state, rest))
      {
        cycle.converged = false;
        cycle.residual.reset();
        cycle.message = led_to_rest;
      }
    }
    catch (const ConvergenceError &error)
    {
      cycle.message = error.what();
    }
    cycle.seconds = seconds_since(begin);
    return cycle;
  }
} // namespace vibrocontact

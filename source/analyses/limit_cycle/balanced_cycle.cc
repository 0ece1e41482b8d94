#include <vibrocontact/analyses/limit_cycle/balanced_cycle.h>
#include <vibrocontact/analyses/limit_cycle/cycle_balance.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/base/wall_clock.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// of the projections; what few harmonics leave out is far more
    constexpr double balance_tolerance = 1e-6;

    /// Of the preconditioner, and its copy of an order.
    double bytes_of(const CycleForces &by_steps, const unsigned int n_harmonics)
    {
      return 16. * 9 * by_steps.points.size() * by_steps.points.size() * (n_harmonics + 4);
    }

    /// Why a motion is not what the contact does; empty: it is.
    std::string objection_to(const std::vector<DynamicState> &states, const CycleScene &scene,
                             const std::vector<unsigned int> &points)
    {
      for (const DynamicState &state : states)
      {
        try
        {
          check_contact_in_grid(scene.pair->interface.contacts, scene.contacts, scene.drive.creepage.speed,
                                state.contact.status);
        }
        catch (const InputError &error)
        {
          return error.what();
        }
        for (unsigned int i = 0; i < scene.pair->n_points(); ++i)
          if (state.contact.y[i] < 0 && !std::binary_search(points.begin(), points.end(), i))
            return "so few harmonics close points that the cycle by steps does not touch";
      }
      return "";
    }

    CyclePeriod heard(const std::vector<DynamicState> &states, const ContactPair &pair,
                      const std::vector<Probe> &probes)
    {
      CyclePeriod period = silent_period(pair.interface.contacts, probes);
      for (const DynamicState &state : states)
        hear(state, state.time, pair, probes, period);
      return period;
    }
  } // namespace

  std::vector<BalancedCycle> balance_cycle(const CycleScene &scene, const LimitCycle &cycle,
                                           const CycleForces &by_steps,
                                           const LimitCycleParameters &parameters,
                                           const std::vector<Probe> &probes)
  {
    std::vector<BalancedCycle> result;
    for (const unsigned int n_harmonics : parameters.harmonics)
    {
      const auto begin = WallClock::now();
      BalancedCycle one;
      one.n_harmonics = n_harmonics;
      one.message = memory_shortage("harmonic balance with " + std::to_string(n_harmonics) + " harmonics",
                                    bytes_of(by_steps, n_harmonics), run_communicator());
      if (!one.message.empty())
      {
        result.push_back(one);
        continue;
      }
      try
      {
        CycleBalance balance(*scene.pair, scene.contacts, scene.drive, scene.at_rest, *scene.shapes,
                             by_steps.points, n_harmonics, balance_tolerance);
        one.n_unknowns = balance.n_unknowns();
        std::vector<double> x = balance.unknowns(by_steps.forces, by_steps.approaches, cycle.period);
        NewtonSettings settings;
        settings.max_iterations = parameters.max_newton_iterations;
        Progress progress("harmonic balance with " + std::to_string(n_harmonics) + " harmonics", 1);
        balance.progress = &progress;
        const NewtonResult found = solve_by_newton(balance, settings, x);
        one.converged = found.converged;
        if (found.is_evaluated())
          one.residual = found.size;
        one.newton_iterations = found.iterations;
        one.n_products = balance.n_products;
        one.period = balance.period(x);
        if (one.converged)
        {
          const std::vector<DynamicState> states = balance.motion(x, cycle.n_steps);
          one.message = objection_to(states, scene, by_steps.points);
          one.converged = one.message.empty();
          if (one.converged)
            one.motion = heard(states, *scene.pair, probes);
        }
        else
          one.message =
              "Newton's method ended where the contact's laws are missed" +
              (one.residual ? " by " + number_text(*one.residual) + " of the motion's forces" : "") +
              (balance.failure.empty() ? "" : ": " + balance.failure);
      }
      catch (const ConvergenceError &error)
      {
        one.message = error.what();
      }
      one.seconds = seconds_since(begin);
      result.push_back(one);
    }
    return result;
  }
} // namespace vibrocontact

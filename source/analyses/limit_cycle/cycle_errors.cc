#include <vibrocontact/analyses/limit_cycle/cycle_errors.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/wall_clock.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// of the cycles that errors are told from, which are small numbers of few digits
    constexpr double loose_tolerance = 1e-7;

    double relative_difference(const double a, const double b)
    {
      const double size = std::max(std::abs(a), std::abs(b));
      return size > 0 ? std::abs(a - b) / size : 0.;
    }
  } // namespace

  CycleErrors errors_of_steps(const CycleScene &scene, const TransientParameters &steps,
                              const ContactSolverParameters &solver, const LimitCycleParameters &parameters,
                              const std::vector<unsigned int> &points, const LimitCycle &cycle,
                              const CyclePeriod &period, const std::vector<Probe> &probes)
  {
    const auto begin = WallClock::now();
    CycleErrors errors;
    const CycleSignal &signal = period.main_signal();
    errors.signal = signal.name;
    LimitCycleParameters looser = parameters;
    looser.tolerance = std::max(parameters.tolerance, loose_tolerance);
    for (const unsigned int n_steps : {(cycle.n_steps + 1) / 2, 2 * cycle.n_steps})
    {
      const std::unique_ptr<CycleMap> map = map_about(scene, steps, solver, points, n_steps);
      const LimitCycle other = find_again(*map, scene.at_rest, cycle, looser);
      errors.failure = other.message;
      if (!other.converged)
        continue;
      try
      {
        const CyclePeriod heard = listen_to_cycle(*map, other, *scene.pair, scene.contacts, probes);
        const CycleSignal &again = heard.signal(signal.name);
        // X(2h) - X(h) = C h, X(h) - X(h/2) = C h / 2
        const double share = n_steps > cycle.n_steps ? 2. : 1.;
        errors.n_steps = n_steps;
        errors.frequency = share * relative_difference(1 / cycle.period, 1 / other.period);
        errors.amplitude = share * relative_difference(signal.amplitude(), again.amplitude());
        errors.first_harmonic =
            share * relative_difference(signal.harmonics().at(1), again.harmonics().at(1));
        break;
      }
      catch (const std::runtime_error &error)
      {
        errors.failure = error.what();
      }
    }
    errors.seconds = seconds_since(begin);
    return errors;
  }
} // namespace vibrocontact

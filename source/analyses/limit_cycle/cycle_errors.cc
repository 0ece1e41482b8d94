#include <vibrocontact/analyses/limit_cycle/cycle_errors.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/wall_clock.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// of the other cycle: an estimate needs two digits
    constexpr double loose_tolerance = 1e-7;
  } // namespace

  CycleErrors errors_of_steps(const CycleScene &scene, const LimitCycleParameters &parameters,
                              const std::vector<unsigned int> &points, const LimitCycle &cycle,
                              const CyclePeriod &period, const std::vector<Probe> &probes)
  {
    const auto begin = WallClock::now();
    CycleErrors errors;
    const CycleSignal &signal = period.main_signal();
    errors.signal = signal.name;
    LimitCycleParameters looser = parameters;
    looser.tolerance = std::max(parameters.tolerance, loose_tolerance);
    std::vector<unsigned int> others = {2 * cycle.n_steps};
    if (const unsigned int half = (cycle.n_steps + 1) / 2; half >= least_steps_of_period)
      others.insert(others.begin(), half);
    for (const unsigned int n_steps : others)
    {
      errors.failure =
          shortage_of_derivatives(loaded_points(scene.at_rest.R, scene.pair->n_points()).size(), n_steps);
      if (!errors.failure.empty())
        continue;
      const std::unique_ptr<CycleMap> map = map_about(scene, points, n_steps);
      const LimitCycle other = find_again(*map, scene.at_rest, cycle, looser);
      errors.failure = other.message;
      if (!other.converged)
        continue;
      try
      {
        const CyclePeriod heard = listen_to_cycle(*map, other, *scene.pair, scene.contacts, probes);
        const CycleSignal &again = heard.signal(signal.name);
        const double change_of_step = std::abs(double(cycle.n_steps) / n_steps - 1);
        const auto error = [&](const double here, const double there, const double size)
        { return size > 0 ? std::abs(there - here) / (change_of_step * size) : 0.; };
        errors.n_steps = n_steps;
        errors.frequency = error(cycle.period, other.period, cycle.period);
        errors.amplitude = error(signal.amplitude(), again.amplitude(), signal.amplitude());
        errors.first_harmonic = error(signal.harmonics().at(1), again.harmonics().at(1), signal.amplitude());
        break;
      }
      catch (const std::runtime_error &failure)
      {
        errors.failure = failure.what();
      }
    }
    errors.seconds = seconds_since(begin);
    return errors;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/cycle_errors.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/marching/judge_march.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// of the other cycle, whatever the user asks of his own: an estimate needs two digits
    constexpr double tolerance_of_other = 1e-7;
    /// of the change of all harmonics: amplitude and first harmonic may agree by chance
    constexpr double least_of_harmonics = 0.5;

    /// Root of the squares of all changes of the harmonics but the mean.
    double change_of_harmonics(const std::vector<double> &here, const std::vector<double> &there)
    {
      const auto at = [](const std::vector<double> &harmonics, const std::size_t k)
      { return k < harmonics.size() ? harmonics[k] : 0.; };
      double sum = 0;
      for (std::size_t k = 1; k < std::max(here.size(), there.size()); ++k)
        sum += std::pow(at(here, k) - at(there, k), 2);
      return std::sqrt(sum);
    }

    /// Errors of a cycle beside another one in other steps.
    void compare(const LimitCycle &cycle, const CycleSignal &signal, const LimitCycle &other,
                 const CycleSignal &again, CycleErrors &errors)
    {
      const double change_of_step = std::abs(double(cycle.n_steps) / other.n_steps - 1),
                   size = signal.amplitude();
      const std::vector<double> here = signal.harmonics(), there = again.harmonics();
      const double least = least_of_harmonics * change_of_harmonics(here, there);
      const auto of_signal = [&](const double change)
      { return size > 0 ? std::max(std::abs(change), least) / (change_of_step * size) : 0.; };
      errors.n_steps = other.n_steps;
      errors.frequency = std::abs(other.period / cycle.period - 1) / change_of_step;
      errors.amplitude = of_signal(again.amplitude() - size);
      errors.first_harmonic = of_signal(there.at(1) - here.at(1));
    }
  } // namespace

  CycleErrors errors_of_steps(const CycleScene &scene, const LimitCycleParameters &parameters,
                              const std::vector<unsigned int> &points, const LimitCycle &cycle,
                              const CyclePeriod &period, const std::vector<Probe> &probes)
  {
    const auto begin = WallClock::now();
    CycleErrors errors;
    const CycleSignal &signal = period.main_signal();
    errors.signal = signal.name;
    LimitCycleParameters of_other = parameters;
    of_other.tolerance = tolerance_of_other;
    /// @return why there is no cycle in so many steps; empty: there is, and it was compared
    const auto compare_with = [&](const unsigned int n_steps) -> std::string
    {
      const std::string shortage = shortage_of_derivatives(scene, n_steps);
      if (!shortage.empty())
        return shortage;
      const std::unique_ptr<CycleMap> map = map_about(scene, points, n_steps);
      const LimitCycle other = find_again(*map, scene.at_rest, cycle, of_other);
      // rounding may permit no more than the user asks for
      if (!other.converged && !(other.residual && *other.residual <= parameters.tolerance))
        return other.message;
      try
      {
        const CyclePeriod heard = listen_to_cycle(*map, other, *scene.pair, scene.contacts, probes);
        compare(cycle, signal, other, heard.signal(signal.name), errors);
        errors.failure.clear();
        return "";
      }
      catch (const std::runtime_error &failure)
      {
        return failure.what();
      }
    };
    std::vector<unsigned int> others = {2 * cycle.n_steps};
    if (const unsigned int half = (cycle.n_steps + 1) / 2; half >= least_steps_of_period)
      others.insert(others.begin(), half);
    for (const unsigned int n_steps : others)
    {
      const std::string failure = compare_with(n_steps);
      // twice as many steps tell more of errors that do not fall with the step yet
      if (failure.empty() && errors.largest() <= most_step_error)
        break;
      if (errors.n_steps == 0)
        errors.failure = failure;
    }
    errors.seconds = seconds_since(begin);
    return errors;
  }
} // namespace vibrocontact

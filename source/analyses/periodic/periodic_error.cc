#include <vibrocontact/analyses/periodic/periodic_error.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  PeriodicReference periodic_reference(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law,
                                       const HarmonicForce &force, const unsigned int n_samples)
  {
    PeriodicReference result;
    result.solution = shoot(body, law, force);
    for (unsigned int i = 0; i < n_samples; ++i)
    {
      const MotionSample sample = result.solution.at(double(i) / n_samples);
      result.displacement.push_back(sample.displacement);
      result.velocity.push_back(sample.velocity);
      result.contact_force.push_back(sample.force);
    }
    return result;
  }

  PeriodicErrors errors_of(const PeriodicBalance &balance, const PeriodicSolution &solution,
                           const PeriodicMotion &motion, const PeriodicReference &reference)
  {
    PeriodicErrors errors;
    const PointHistory &point = motion.points[0];
    errors.displacement = relative_error(point.displacement, reference.displacement);
    errors.velocity = relative_error(point.velocity, reference.velocity);
    errors.contact_force = relative_error(point.contact_force, reference.contact_force);
    errors.impulse = relative(motion.impulse[0] - reference.solution.impulse, reference.solution.impulse);
    errors.energy_norm =
        relative(motion.energy_norm - reference.solution.energy_norm, reference.solution.energy_norm);

    const unsigned int n = balance.settings.n_functions;
    std::vector<double> middle;
    for (unsigned int k = 0; k < n; ++k)
      middle.push_back((k + 0.5) / n);
    const DenseMatrix values = sampled(balance.trial(), middle, 0);
    std::vector<double> here(n, 0.), there(n);
    for (unsigned int k = 0; k < n; ++k)
    {
      for (unsigned int j = 0; j < n; ++j)
        here[k] += values(k, j) * solution.displacement[j];
      there[k] = reference.solution.at(middle[k] + solution.excitation.phase / (2 * M_PI)).displacement;
    }
    errors.midpoints = relative_error(here, there);
    return errors;
  }

  PeriodicErrors median(const std::vector<PeriodicErrors> &errors)
  {
    PeriodicErrors result;
    for (double PeriodicErrors::*entry :
         {&PeriodicErrors::displacement, &PeriodicErrors::velocity, &PeriodicErrors::contact_force,
          &PeriodicErrors::impulse, &PeriodicErrors::energy_norm, &PeriodicErrors::midpoints})
    {
      std::vector<double> values;
      for (const PeriodicErrors &e : errors)
        values.push_back(e.*entry);
      std::sort(values.begin(), values.end());
      const std::size_t half = values.size() / 2;
      result.*entry = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
    }
    return result;
  }
} // namespace vibrocontact

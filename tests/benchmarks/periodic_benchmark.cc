/// What a periodic motion of the axial bar (tests/unit/axial_bar.h) costs, and how exact it is against shooting.
///
///   periodic_benchmark cost | modes | samples | rigid | found [PAIR]
///
/// cost: one solution of case 2 from the motion without contact to a residual of 1e-10, set-up apart: median of 100 in processor
/// time, against pair, number of functions and number of contact points. modes: against the modes kept, with and without the
/// static answers of the others. samples: against the samples of the law. rigid: exact law, all pairs. found:
/// in how many of 16 positions of the force within a cell a motion is found, and which way.

#include "../unit/axial_bar.h"

#include <vibrocontact/analyses/periodic/periodic_error.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>

using namespace vibrocontact;

namespace
{
  std::shared_ptr<const NormalLaw> penalty(const AxialBarCase &c)
  {
    return create_normal_law("exponential penalty", {c.amplitude, c.exponent});
  }

  BalanceSettings settings(const std::string &pair, const unsigned int n, const unsigned int n_samples = 4096)
  {
    BalanceSettings result;
    result.trial = pair.substr(0, pair.find(':'));
    result.weighting = pair.substr(pair.find(':') + 1);
    result.n_functions = n;
    result.n_samples = n_samples;
    return result;
  }

  const std::vector<std::string> pairs = {"fourier:fourier",     "bspline:bspline", "daubechies6:daubechies6",
                                          "daubechies6:fourier", "haar:fourier",    "haar:bspline"};

  /// Median processor time of a solution [ms].
  double cost(PeriodicBalance &balance, PeriodicSolution &solution, const unsigned int repetitions = 100)
  {
    std::vector<double> ms;
    double total = 0;
    for (unsigned int k = 0; k < repetitions && total < 5e3; ++k)
    {
      const std::clock_t begin = std::clock();
      solution = balance.solve();
      ms.push_back(1e3 * (std::clock() - begin) / CLOCKS_PER_SEC);
      total += ms.back();
    }
    std::nth_element(ms.begin(), ms.begin() + ms.size() / 2, ms.end());
    return ms[ms.size() / 2];
  }

  void costs()
  {
    const AxialBarCase c = axial_bar_1275();
    std::printf(
        "| pair | functions | points | ms | iterations | steps of the gap |\n|---|---|---|---|---|---|\n");
    const auto line = [&](const std::string &pair, const unsigned int n, const ForcedBody &body)
    {
      PeriodicBalance balance(body, penalty(c), settings(pair, n));
      balance.set_force(c.excitation());
      PeriodicSolution solution;
      const double ms = cost(balance, solution);
      std::printf("| %s | %u | %u | %.2f | %u | %u |%s\n", pair.c_str(), n, body.n_points(), ms,
                  solution.iterations, solution.homotopy_steps, solution.converged ? "" : " no solution");
      std::fflush(stdout);
    };
    for (const unsigned int n : {15u, 31u, 63u, 127u, 255u})
      line("fourier:fourier", n, axial_bar(c));
    for (const std::string &pair : pairs)
      if (pair != pairs[0])
        line(pair, 64, axial_bar(c));
    for (const unsigned int points : {2u, 4u, 8u})
      line("fourier:fourier", 63, with_points(c, points));
  }

  struct Measured
  {
    PeriodicErrors errors;
    double ms = 0;
    PeriodicSolution solution;
  };

  Measured measure(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law, const AxialBarCase &c,
                   const BalanceSettings &settings, const PeriodicReference &reference,
                   const unsigned int repetitions)
  {
    Measured result;
    PeriodicBalance balance(body, law, settings);
    balance.set_force(c.excitation());
    result.ms = cost(balance, result.solution, repetitions);
    if (result.solution.converged)
      result.errors =
          errors_of(balance, result.solution,
                    sample_motion(balance, result.solution, reference.displacement.size()), reference);
    return result;
  }

  void modes()
  {
    std::printf("| case | modes | displacement | force | displacement, without residual | force | ms |\n"
                "|---|---|---|---|---|---|---|\n");
    for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
    {
      const ForcedBody all = axial_bar(c);
      const PeriodicReference reference = periodic_reference(all, penalty(c), c.excitation(), 4096);
      for (const unsigned int n : {1u, 2u, 3u, 5u, 8u, 12u, 25u})
      {
        const BalanceSettings s = settings("fourier:fourier", 127);
        const Measured with = measure(with_modes(all, n, true), penalty(c), c, s, reference, 20),
                       without = measure(with_modes(all, n, false), penalty(c), c, s, reference, 1);
        std::printf("| %.0f Hz | %u | %.1e | %.1e | %.1e | %.1e | %.2f |\n", c.frequency, n,
                    with.errors.displacement, with.errors.contact_force, without.errors.displacement,
                    without.errors.contact_force, with.ms);
      }
    }
  }

  void samples()
  {
    std::printf("| case | samples | displacement | force | impulse | ms |\n|---|---|---|---|---|---|\n");
    for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
    {
      const PeriodicReference reference = periodic_reference(axial_bar(c), penalty(c), c.excitation(), 4096);
      for (unsigned int n = 256; n <= 16384; n *= 2)
      {
        const Measured found =
            measure(axial_bar(c), penalty(c), c, settings("fourier:fourier", 127, n), reference, 20);
        std::printf("| %.0f Hz | %u | %.2e | %.2e | %.1e | %.2f |\n", c.frequency, n,
                    found.errors.displacement, found.errors.contact_force, found.errors.impulse, found.ms);
      }
    }
  }

  void rigid()
  {
    std::printf("| case | pair | functions | displacement | velocity | force | impulse | iterations | steps "
                "of the gap |\n"
                "|---|---|---|---|---|---|---|---|---|\n");
    for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
    {
      const ForcedBody body = axial_bar(c, true);
      const auto law = create_normal_law("signorini");
      const PeriodicReference reference = periodic_reference(body, law, c.excitation(), 4096);
      for (const std::string &pair : pairs)
        for (unsigned int n : {15, 16, 31, 32, 63, 64, 127, 128, 255, 256})
        {
          const unsigned int number = n;
          const Measured found = measure(body, law, c, settings(pair, number), reference, 1);
          const PeriodicErrors &e = found.errors;
          if (found.solution.converged)
            std::printf("| %.0f Hz | %s | %u | %.2e | %.2e | %.2e | %.1e | %u | %u |\n", c.frequency,
                        pair.c_str(), number, e.displacement, e.velocity, e.contact_force, e.impulse,
                        found.solution.iterations, found.solution.homotopy_steps);
          else
            std::printf("| %.0f Hz | %s | %u | no solution, residual %.1e | | | | %u | %u |\n", c.frequency,
                        pair.c_str(), number, found.solution.residual, found.solution.iterations,
                        found.solution.homotopy_steps);
          std::fflush(stdout);
        }
    }
  }

  /// @param only pairs whose names hold that
  void found(const std::string &only)
  {
    constexpr unsigned int n_phases = 16;
    std::printf(
        "| case | pair | functions | directly | by the gap | by the stiffness | not | error | of those by "
        "the stiffness | most iterations |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
    {
      const ForcedBody body = axial_bar(c);
      const PeriodicReference reference = periodic_reference(body, penalty(c), c.excitation(), 4096);
      for (const std::string &pair : pairs)
        for (const unsigned int n : {8u, 9u, 16u, 17u, 32u, 33u, 63u, 64u, 127u, 128u})
        {
          if (pair.find(only) == std::string::npos)
            continue;
          PeriodicBalance balance(body, penalty(c), settings(pair, n));
          unsigned int count[4] = {}, most = 0;
          std::vector<double> errors[2];
          for (unsigned int k = 0; k < n_phases; ++k)
          {
            HarmonicForce force = c.excitation();
            force.phase = 2 * M_PI * k / (n_phases * double(n));
            balance.set_force(force);
            const PeriodicSolution solution = balance.solve();
            const unsigned int way = !solution.converged            ? 3
                                     : solution.stiffness_steps > 0 ? 2
                                     : solution.homotopy_steps > 0  ? 1
                                                                    : 0;
            ++count[way];
            most = std::max(most, solution.iterations);
            if (way < 3)
              errors[way == 2].push_back(
                  errors_of(balance, solution,
                            sample_motion(balance, solution, reference.displacement.size()), reference)
                      .displacement);
          }
          std::printf("| %.0f Hz | %s | %u | %u | %u | %u | %u |", c.frequency, pair.c_str(), n, count[0],
                      count[1], count[2], count[3]);
          for (std::vector<double> &values : errors)
          {
            std::sort(values.begin(), values.end());
            if (values.empty())
              std::printf(" |");
            else
              std::printf(" %.1e |", values[values.size() / 2]);
          }
          std::printf(" %u |\n", most);
          std::fflush(stdout);
        }
    }
  }
} // namespace

int main(const int argc, char **const argv)
{
  const std::string what = argc > 1 ? argv[1] : "cost";
  if (what == "cost")
    costs();
  else if (what == "modes")
    modes();
  else if (what == "samples")
    samples();
  else if (what == "rigid")
    rigid();
  else
    found(argc > 2 ? argv[2] : "");
}

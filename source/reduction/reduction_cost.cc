#include <vibrocontact/reduction/reduction_cost.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// with modes
    constexpr unsigned int supposed_waves = 24;
    /// of modes, however few: five blocks of a Krylov basis and those in work
    constexpr unsigned int fewest_vectors = 64;
  } // namespace

  ReductionCost reduction_cost(const double n_dofs, const double n_rows, const double n_modes,
                               const bool counts_first)
  {
    const double size = n_dofs / 287e3, number = 8;
    const double matrices = 5e3 * n_dofs, factors = 2.8e9 * std::pow(size, 1.25),
                 factor_seconds = 17 * std::pow(size, 1.5);
    ReductionCost cost;
    cost.kept = matrices + factors;
    cost.stages.push_back({"mesh and assembly", 8 * size, matrices});
    cost.stages.push_back({"factorisation", 4 * size + factor_seconds, cost.kept});
    if (n_rows > 0)
      cost.stages.push_back(
          {"contact compliance", 0.02 * size * n_rows, cost.kept + 2 * number * n_rows * n_rows});
    if (n_modes > 0)
    {
      if (counts_first)
        cost.stages.push_back({"count of modes", 4 * size + factor_seconds, cost.kept + 0.7 * factors});
      cost.stages.push_back({std::to_string(std::lround(n_modes)) + " modes", 0.6 * size * n_modes,
                             cost.kept + number * n_dofs * (4.4 * n_modes + fewest_vectors)});
      cost.kept += number * n_dofs * n_modes;
    }
    for (const ReductionStage &stage : cost.stages)
      cost.peak = std::max(cost.peak, stage.bytes);
    return cost;
  }

  ReductionCost revolved_cost(const double n_dofs, const double n_waves, const bool with_modes)
  {
    const double size = n_dofs / 3900, seconds = 0.04 * std::pow(size, 1.2),
                 bytes = 5e3 * n_dofs + 6e7 * size;
    ReductionCost cost;
    if (n_waves > 0)
      cost.stages.push_back({"contact compliance", seconds * (n_waves + 1), bytes});
    if (with_modes)
      cost.stages.push_back({"modes", seconds * supposed_waves, bytes});
    cost.peak = bytes;
    return cost;
  }

  ReductionCost track_cost(const double n_dofs, const double n_rows, const double n_of_poles,
                           const double n_of_response)
  {
    const double size = n_dofs / 813, number = 8, bytes = 2e8 * size + 2 * number * n_rows * n_rows;
    ReductionCost cost;
    const auto frequencies = [&](const std::string &what, const double n, const double seconds)
    {
      if (n > 0)
        cost.stages.push_back(
            {what + " at " + std::to_string(std::lround(n)) + " frequencies", seconds * size * n, bytes});
    };
    if (n_rows > 0)
      cost.stages.push_back({"compliance of the crown", 2 * size, bytes});
    frequencies("receptance", n_of_poles, 0.13);
    frequencies("frequency response", n_of_response, 1.5);
    cost.peak = bytes;
    return cost;
  }
} // namespace vibrocontact

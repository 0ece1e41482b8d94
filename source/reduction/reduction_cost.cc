#include <vibrocontact/reduction/reduction_cost.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// with modes
    constexpr unsigned int supposed_waves = 24;
    /// of modes, however few: blocks of a Krylov basis and those in work
    constexpr unsigned int fewest_vectors = 152;
  } // namespace

  ReductionCost reduction_cost(const ReductionSize &size, const StiffnessSolver solver)
  {
    const bool iterative = solver == StiffnessSolver::iterative;
    const double number = 8, n = size.n_dofs, relative = n / 287e3, c = size.compactness,
                 entries = 21 * c * std::pow(n, 4. / 3), matrices = 4e3 * n,
                 factors = (iterative ? 4.5 : 11.) * entries, ordering_seconds = 4 * relative,
                 // at 10 Gflop/s
        factor_seconds =
            iterative ? 260 * std::pow(n / 1e6, 1.4) * std::pow(c, 1.5) : 0.2e-10 * std::pow(entries, 1.5),
                 // five steps: a product with 190 entries per row at 6 Gflop/s, the factors in blocks of 32
        column_seconds = 5 * (2 * 190 * n / 6e9 + entries / 15e9),
                 // b, r, z, both directions, and what is on its way to the factors
        block_bytes = iterative ? 7 * 32 * number * n : 0;
    ReductionCost cost;
    cost.solver = solver;
    cost.kept = matrices + factors;
    cost.stages.push_back({"mesh and assembly", 8 * relative, matrices});
    if (size.prestressed)
      cost.stages.push_back(
          {"prestress", (iterative ? 1 : 2) * (ordering_seconds + factor_seconds), cost.kept});
    cost.stages.push_back({iterative ? "approximate factorisation" : "factorisation",
                           ordering_seconds + factor_seconds, cost.kept});
    if (size.n_rows > 0)
      cost.stages.push_back({"contact compliance",
                             iterative ? column_seconds * size.n_rows : 0.02 * relative * size.n_rows,
                             cost.kept + 2 * number * size.n_rows * size.n_rows + block_bytes});
    if (size.n_modes > 0)
    {
      if (size.counts_first)
        cost.stages.push_back(
            {"count of modes", ordering_seconds + factor_seconds, cost.kept + 0.7 * factors});
      // those of the second search with them; in blocks of 8 half as long again
      const double n_solves = 1.5 * (5 * size.n_modes + 150);
      cost.stages.push_back(
          {std::to_string(std::lround(size.n_modes)) + " modes",
           iterative ? column_seconds * n_solves : 0.6 * relative * size.n_modes,
           cost.kept + number * n * (4.4 * size.n_modes + fewest_vectors) + block_bytes / 4});
      cost.kept += number * n * size.n_modes;
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

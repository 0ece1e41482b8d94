#pragma once

#include <vibrocontact/analyses/limit_cycle/basin_parameters.h>
#include <vibrocontact/analyses/limit_cycle/cycle_branch_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// steps of a period: fewer do not show a sine
  constexpr unsigned int least_steps_of_period = 8;

  /// `subsection Limit cycle`
  struct LimitCycleParameters
  {
    /// a period of an unstable root is divided into equal steps of at most this length [s]
    double time_step = 5e-6;
    /// where cycles are sought from: "roots", or "end of transient", that of the results in a folder; empty: of the same file
    std::string start = "roots";
    std::string transient_folder;
    /// which unstable roots cycles are sought from, as in the file: frequencies [Hz]; empty: all
    std::vector<double> roots;
    /// |x(T) - x(0)| over |x(0) - equilibrium|, in the root of the energy
    double tolerance = 1e-9;
    unsigned int max_newton_iterations = 20;
    /// Floquet multipliers that are listed, the largest; 0: they are not computed
    unsigned int n_multipliers = 12;
    /// whether each cycle is found once more in other steps, to tell their error
    bool error_estimate = true;
    /// numbers of harmonics with which each cycle is found by harmonic balance as well; empty: it is not
    std::vector<unsigned int> harmonics;
    CycleBranchParameters branch;
    BasinParameters basins;

    bool starts_from_transient() const { return start == "end of transient"; }
    /// "end of transient", or "end of transient in <folder>"
    std::string name_of_start() const
    {
      return start + (transient_folder.empty() ? "" : " in " + transient_folder);
    }
    void declare_parameters(dealii::ParameterHandler &prm);
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_branch_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <vector>

namespace vibrocontact
{
  /// `subsection Limit cycle`
  struct LimitCycleParameters
  {
    /// a period of an unstable root is divided into equal steps of at most this length [s]
    double time_step = 5e-6;
    /// which unstable roots cycles are sought from, as in the file: frequencies [Hz]; empty: all
    std::vector<double> roots;
    /// |x(T) - x(0)| over |x(0) - equilibrium|, in the root of the energy
    double tolerance = 1e-9;
    unsigned int max_newton_iterations = 20;
    /// Floquet multipliers that are listed, the largest; 0: they are not computed
    unsigned int n_multipliers = 12;
    /// numbers of harmonics with which each cycle is found by harmonic balance as well; empty: it is not
    std::vector<unsigned int> harmonics;
    CycleBranchParameters branch;

    void declare_parameters(dealii::ParameterHandler &prm);
  };
} // namespace vibrocontact

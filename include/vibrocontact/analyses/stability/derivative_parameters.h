#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Derivatives` of section Stability: derivatives of the roots, and their scatter with that of the entries.
  struct DerivativeParameters
  {
    /// Section/Entry
    std::vector<std::string> entries;
    /// standard deviation of each, in its units; empty: no scatter
    std::vector<double> deviations;
    unsigned int n_draws = 0, seed = 1;

    bool any() const { return !entries.empty(); }
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError
    void check() const;
  };
} // namespace vibrocontact

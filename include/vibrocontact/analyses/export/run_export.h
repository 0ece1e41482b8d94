#pragma once

#include <vibrocontact/base/parameter_group.h>
#include <vibrocontact/run/analysis.h>

#include <string>

namespace vibrocontact
{
  /// `subsection Export`: what is written of the reduced bodies for other programs.
  struct ExportParameters : ParameterGroup
  {
    /// matrices, state space or both
    std::string form = "both";

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &) const override {}
  };

  /// The row of the analysis `export`.
  Analysis export_analysis();
} // namespace vibrocontact

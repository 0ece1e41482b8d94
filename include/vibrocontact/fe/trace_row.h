#pragma once

#include <deal.II/base/types.h>

#include <utility>
#include <vector>

namespace vibrocontact
{
  /// A displacement as a sum over dofs, u = sum weight * U[global dof]: (dof, weight) pairs. Its transpose
  /// spreads a force.
  using TraceRow = std::vector<std::pair<dealii::types::global_dof_index, double>>;
} // namespace vibrocontact

#pragma once

#include <deal.II/lac/petsc_matrix_base.h>

#include <vector>

namespace vibrocontact
{
  /// Nested dissection (METIS) of a symmetric sparse matrix. Dofs with the same pattern (the components of a
  /// node) are one vertex of the graph, which makes the ordering ten times faster than on dofs.
  /// @param last dofs ordered last, sorted (those of a Schur complement)
  /// @return on rank 0 the position of every dof, from 1; empty on the others
  std::vector<int> fill_reducing_order(Mat matrix, const std::vector<unsigned int> &last);
} // namespace vibrocontact

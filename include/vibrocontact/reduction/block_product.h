#pragma once

#include <petscmat.h>

#include <vector>

namespace vibrocontact
{
  /// A X for several distributed columns at once, each rank with its rows of them, one column after the
  /// other: reads the matrix once for some columns. Collective.
  std::vector<double> block_product(Mat matrix, const std::vector<double> &columns, PetscInt n_columns);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/matrices/stored_matrix.h>
#include <vibrocontact/scene/matrix_nodes.h>

#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A matrix of Nastran's cards DMIG ("direct matrix input at grid points"): real, square (form 1 or 9) or symmetric (6, one
  /// triangle given). Its rows and columns are dofs of nodes; component 0, of a scalar point, is a modal coordinate.
  ///
  ///     DMIG    KAAX    0       6       2       0                       header: name, 0, form, type, type out
  ///     DMIG*   KAAX                           1               1        column: node, component
  ///     *                      1               1  1.20000000D+06        row: node, component, value
  struct DmigMatrix
  {
    struct Entry
    {
      MatrixDof row, column;
      double value;
      unsigned int line;
    };
    std::string source, name;
    bool symmetric = false;
    std::vector<Entry> entries;
  };

  /// All matrices of a file, by name. @throws InputError with file and line
  std::map<std::string, DmigMatrix> read_dmig(const std::string &source, const std::string &bytes);

  /// Dofs that have an entry in one of the matrices, by node and direction.
  std::vector<MatrixDof> dofs_of(const std::vector<const DmigMatrix *> &matrices);

  /// The matrix by the numbers of its dofs. @throws InputError for a dof that is none of them
  StoredMatrix stored(const DmigMatrix &matrix, const std::vector<MatrixDof> &dofs);
} // namespace vibrocontact

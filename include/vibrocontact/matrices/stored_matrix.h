#pragma once

#include <string>
#include <vector>

namespace vibrocontact
{
  /// An entry of a matrix in a file; row and column from 0.
  struct StoredEntry
  {
    unsigned int row, column;
    double value;
    /// of the file, for messages
    unsigned int line;
  };

  /// A real matrix as a file gives it: of a symmetric one either triangle, or both.
  struct StoredMatrix
  {
    /// file, for messages
    std::string source;
    unsigned int n_rows = 0, n_columns = 0;
    /// the file says that it is symmetric and gives each pair of entries once
    bool one_triangle = false;
    std::vector<StoredEntry> entries;
  };

  /// The lower triangle, by rows, each entry once. Rounding of a file that gives both triangles is taken out: two entries that
  /// agree to 1e-9 of the geometric mean of their diagonal entries (or of the larger of the two) are their mean.
  /// @throws InputError with file and line for a matrix that is not square or not symmetric, or an entry given twice
  std::vector<StoredEntry> lower_triangle(StoredMatrix matrix);

  /// A matrix that CalculiX stores (`*FREQUENCY, SOLVER=MATRIXSTORAGE`): lines row, column, value of the upper triangle.
  /// @param n rows, those of the .dof beside it @throws InputError with file and line
  StoredMatrix read_calculix_matrix(const std::string &source, const std::string &bytes, unsigned int n);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/matrices/stored_matrix.h>

#include <string>

namespace vibrocontact
{
  /// A matrix in the exchange format of NIST's Matrix Market (Boisvert, Pozo, Remington 1996, NISTIR 5935):
  ///
  ///     %%MatrixMarket matrix coordinate real symmetric
  ///     % comments
  ///     3 3 4            rows, columns, entries that follow
  ///     1 1 2.5          row, column, value; of a symmetric matrix the lower triangle
  ///
  /// or `array`, all values column by column. Real or integer, general or symmetric.
  /// @param source file, for messages
  /// @throws InputError with file and line
  StoredMatrix read_matrix_market(const std::string &source, const std::string &bytes);

  /// The same as a dense matrix. @throws InputError with file and line, also for an entry given twice
  DenseMatrix read_dense_matrix_market(const std::string &source, const std::string &bytes);

  /// `array real general` or, for a matrix that is said to be symmetric, `coordinate real symmetric` without zeros, with 17
  /// digits. @param comments a line each
  std::string matrix_market_text(const DenseMatrix &matrix, bool symmetric, const std::string &comment);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/base/dense.h>

#include <vector>

namespace vibrocontact
{
  /// Some rows of a matrix.
  template <typename Number>
  dealii::LAPACKFullMatrix<Number> rows_at(const dealii::LAPACKFullMatrix<Number> &matrix,
                                           const std::vector<unsigned int> &rows)
  {
    dealii::LAPACKFullMatrix<Number> result(rows.size(), matrix.n());
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int i = 0; i < rows.size(); ++i)
        result(i, j) = matrix(rows[i], j);
    return result;
  }

  /// The first rows and columns of a matrix.
  template <typename Number>
  dealii::LAPACKFullMatrix<Number> top_left(const dealii::LAPACKFullMatrix<Number> &matrix,
                                            const unsigned int n_rows, const unsigned int n_columns)
  {
    dealii::LAPACKFullMatrix<Number> result(n_rows, n_columns);
    for (unsigned int j = 0; j < n_columns; ++j)
      for (unsigned int i = 0; i < n_rows; ++i)
        result(i, j) = matrix(i, j);
    return result;
  }

  /// Some entries of a vector.
  inline DenseVector entries_at(const DenseVector &vector, const std::vector<unsigned int> &rows)
  {
    DenseVector result(rows.size());
    for (unsigned int i = 0; i < rows.size(); ++i)
      result[i] = vector[rows[i]];
    return result;
  }

  /// Some columns of a matrix.
  template <typename Number>
  dealii::LAPACKFullMatrix<Number> columns_at(const dealii::LAPACKFullMatrix<Number> &matrix,
                                              const std::vector<unsigned int> &columns)
  {
    dealii::LAPACKFullMatrix<Number> result(matrix.m(), columns.size());
    for (unsigned int j = 0; j < columns.size(); ++j)
      for (unsigned int i = 0; i < matrix.m(); ++i)
        result(i, j) = matrix(i, columns[j]);
    return result;
  }

  /// Where some rows and columns of a matrix meet.
  template <typename Number>
  dealii::LAPACKFullMatrix<Number> entries_at(const dealii::LAPACKFullMatrix<Number> &matrix,
                                              const std::vector<unsigned int> &rows,
                                              const std::vector<unsigned int> &columns)
  {
    dealii::LAPACKFullMatrix<Number> result(rows.size(), columns.size());
    for (unsigned int j = 0; j < columns.size(); ++j)
      for (unsigned int i = 0; i < rows.size(); ++i)
        result(i, j) = matrix(rows[i], columns[j]);
    return result;
  }
} // namespace vibrocontact

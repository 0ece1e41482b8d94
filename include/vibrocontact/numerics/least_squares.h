#pragma once

#include <vibrocontact/base/dense.h>

namespace vibrocontact
{
  /// min |A x - b| for every column b of B, by the singular values of A with its columns scaled to length one
  /// (dgelsd). @return one column per right-hand side
  DenseMatrix least_squares(DenseMatrix A, const DenseMatrix &B);

  /// The same under equations C x = d that hold exactly (dgglse); one column of D per right-hand side. C has few
  /// rows and they have to be independent.
  DenseMatrix least_squares(const DenseMatrix &A, const DenseMatrix &B, const DenseMatrix &C,
                            const DenseMatrix &D);

  /// R of A = Q R (dgeqrf), upper triangular, as many rows as A has columns; where A has fewer, the last are zero.
  DenseMatrix triangular_factor(DenseMatrix A);
} // namespace vibrocontact

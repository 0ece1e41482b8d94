#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/base/exceptions.h>

#include <deal.II/lac/exceptions.h>

#include <cmath>
#include <string>
#include <vector>

namespace vibrocontact
{
  // deal.II refuses empty matrices, which bodies without modes and contacts without sliding points have.

  /// a b
  template <typename Number>
  dealii::LAPACKFullMatrix<Number> product(const dealii::LAPACKFullMatrix<Number> &a,
                                           const dealii::LAPACKFullMatrix<Number> &b)
  {
    dealii::LAPACKFullMatrix<Number> c(a.m(), b.n());
    if (a.m() > 0 && a.n() > 0 && b.n() > 0)
      a.mmult(c, b);
    return c;
  }

  template <typename Number>
  dealii::LAPACKFullMatrix<Number> transposed(const dealii::LAPACKFullMatrix<Number> &matrix)
  {
    dealii::LAPACKFullMatrix<Number> result(matrix.n(), matrix.m());
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int i = 0; i < matrix.m(); ++i)
        result(j, i) = matrix(i, j);
    return result;
  }

  /// Factorises a matrix in place. @return false if it is singular
  inline bool factorise_lu(DenseMatrix &matrix)
  {
    try
    {
      matrix.compute_lu_factorization();
    }
    catch (const dealii::LACExceptions::ExcSingular &)
    {
      return false;
    }
    return true;
  }

  /// The same numbers in single precision.
  inline SingleMatrix in_single_precision(const DenseMatrix &matrix)
  {
    SingleMatrix result(matrix.m(), matrix.n());
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int i = 0; i < matrix.m(); ++i)
        result(i, j) = static_cast<float>(matrix(i, j));
    return result;
  }

  /// y <- A x, y of the right size; an empty A leaves y as it is
  inline void multiply(const DenseMatrix &A, const DenseVector &x, DenseVector &y)
  {
    if (A.m() > 0 && A.n() > 0)
      A.vmult(y, x);
  }

  /// y_k += A x_k for several k, with A read once and columns left out that all x_k have zeros for. A y may be longer than A
  /// has rows; an empty A leaves y as it is.
  void add_products(const DenseMatrix &A, const std::vector<const DenseVector *> &x,
                    const std::vector<DenseVector *> &y);

  /// a^-1 b; b itself if either is empty. @param failure what is said if a is singular @throws ConvergenceError then
  template <typename Number>
  dealii::LAPACKFullMatrix<Number> solved(dealii::LAPACKFullMatrix<Number> a,
                                          dealii::LAPACKFullMatrix<Number> b, const std::string &failure)
  {
    if (a.m() == 0 || b.n() == 0)
      return b;
    try
    {
      a.compute_lu_factorization();
      a.solve(b);
    }
    catch (const dealii::ExceptionBase &)
    {
      throw ConvergenceError(failure);
    }
    return b;
  }

  inline double euclidean_norm(const std::vector<double> &x)
  {
    double sum = 0;
    for (const double value : x)
      sum += value * value;
    return std::sqrt(sum);
  }

  /// into += factor * block, at a row and a column of `into`
  template <typename Number>
  void add_block(dealii::LAPACKFullMatrix<Number> &into, const dealii::LAPACKFullMatrix<Number> &block,
                 const unsigned int row, const unsigned int column, const double factor = 1)
  {
    for (unsigned int j = 0; j < block.n(); ++j)
      for (unsigned int i = 0; i < block.m(); ++i)
        into(row + i, column + j) += factor * block(i, j);
  }
} // namespace vibrocontact

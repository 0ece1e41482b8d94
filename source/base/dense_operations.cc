#include <vibrocontact/base/dense_operations.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>

namespace vibrocontact
{
  void add_products(const DenseMatrix &A, const std::vector<const DenseVector *> &x,
                    const std::vector<DenseVector *> &y)
  {
    using Integer = dealii::types::blas_int;
    const Integer m = A.m(), n = A.n(), n_vectors = x.size(), one = 1;
    const double unit = 1;
    AssertDimension(x.size(), y.size());
    if (m == 0 || n == 0)
      return;
    for (Integer k = 0; k < n_vectors; ++k)
    {
      AssertDimension(x[k]->size(), A.n());
      Assert(y[k]->size() >= A.m(), dealii::ExcDimensionMismatch(y[k]->size(), A.m()));
    }
    std::vector<double> factors(std::size_t(n) * n_vectors), sums(std::size_t(m) * n_vectors, 0.);
    for (Integer k = 0; k < n_vectors; ++k)
      std::copy(x[k]->begin(), x[k]->end(), factors.begin() + std::size_t(n) * k);
    const auto counts = [&](const Integer column)
    {
      return std::any_of(x.begin(), x.end(),
                         [&](const DenseVector *const vector) { return (*vector)[column] != 0; });
    };
    for (Integer begin = 0, end = 0; end < n; begin = end + 1)
    {
      for (end = begin; end < n && counts(end);)
        ++end;
      const Integer n_columns = end - begin;
      if (n_columns > 0 && n_vectors == 1)
        dealii::gemv("N", &m, &n_columns, &unit, &A(0, begin), &m, &factors[begin], &one, &unit, sums.data(),
                     &one);
      else if (n_columns > 0)
        dealii::gemm("N", "N", &m, &n_vectors, &n_columns, &unit, &A(0, begin), &m, &factors[begin], &n,
                     &unit, sums.data(), &m);
    }
    for (Integer k = 0; k < n_vectors; ++k)
      for (Integer i = 0; i < m; ++i)
        (*y[k])[i] += sums[std::size_t(m) * k + i];
  }
} // namespace vibrocontact

#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/bodies/patch_shapes.h>
#include <vibrocontact/propagators/thin_product.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// smaller matrices are not worth a decomposition
    constexpr unsigned int fewest = 32;

    /// The matrix as basis times amplitudes, or as it is.
    std::vector<DenseMatrix> thin_factors(const DenseMatrix &matrix)
    {
      const std::size_t m = matrix.m(), n = matrix.n();
      if (std::min(m, n) < fewest)
        return {matrix};
      // each state counts alike, however its amplitude is scaled
      DenseMatrix scaled(matrix);
      std::vector<double> scale(n, 1.);
      for (std::size_t j = 0; j < n; ++j)
      {
        double largest = 0;
        for (std::size_t i = 0; i < m; ++i)
          largest = std::max(largest, std::abs(matrix(i, j)));
        if (largest == 0)
          continue;
        scale[j] = largest;
        for (std::size_t i = 0; i < m; ++i)
          scaled(i, j) /= largest;
      }
      PatchShapes shapes = patch_shapes(scaled, 1e-14);
      if (shapes.rank() * (m + n) >= m * n)
        return {matrix};
      for (std::size_t j = 0; j < n; ++j)
        for (unsigned int k = 0; k < shapes.rank(); ++k)
          shapes.amplitudes(k, j) *= scale[j];
      return {shapes.basis, shapes.amplitudes};
    }
  } // namespace

  ThinProduct::Columns::Columns(const DenseMatrix &matrix)
      : length(padded(matrix.m())), n(matrix.n()), entries(length * n, 0.)
  {
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int i = 0; i < matrix.m(); ++i)
        entries[j * length + i] = matrix(i, j);
  }

  void ThinProduct::Columns::add_to(double *const y, const double *const x) const
  {
    wide_add_columns(y, entries.data(), length, length, x, n);
  }

  ThinProduct::ThinProduct(const std::vector<DenseMatrix> &thin_factors)
      : columns(thin_factors.rbegin(), thin_factors.rend()), between(columns.front().length),
        listed(columns.front().n), factors(columns.front().n)
  {
  }

  void ThinProduct::add_to(double *const y, const double *const x)
  {
    if (columns.size() == 1)
      return columns[0].add_to(y, x);
    std::fill(between.begin(), between.end(), 0.);
    columns[0].add_to(between.data(), x);
    columns[1].add_to(y, between.data());
  }

  void ThinProduct::add_sparse_to(double *const y, const double *const x)
  {
    std::size_t n_listed = 0;
    for (std::size_t j = 0; j < listed.size(); ++j)
      if (x[j] != 0)
      {
        listed[n_listed] = j;
        factors[n_listed++] = x[j];
      }
    const bool is_thin = columns.size() > 1;
    std::fill(between.begin(), between.end(), 0.);
    wide_add_columns(is_thin ? between.data() : y, columns[0].entries.data(), columns[0].length,
                     listed.data(), factors.data(), n_listed);
    if (is_thin)
      columns[1].add_to(y, between.data());
  }

  RowsAndStates rows_and_states(const DenseMatrix &right, const DenseMatrix &left)
  {
    std::vector<DenseMatrix> load;
    for (const DenseMatrix &factor : thin_factors(left))
      load.insert(load.begin(), transposed(factor));
    return {ThinProduct(thin_factors(right)), ThinProduct(load)};
  }
} // namespace vibrocontact

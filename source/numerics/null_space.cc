#include <vibrocontact/numerics/lapack_work.h>
#include <vibrocontact/numerics/null_space.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  std::optional<DenseMatrix> null_space(DenseMatrix columns, const unsigned int N)
  {
    // deal.II takes a matrix without columns for one without rows
    const dealii::types::blas_int rows = N, n = columns.n();
    if (n > rows)
      return {};
    DenseMatrix Q(rows);
    for (int i = 0; i < rows; ++i)
      Q(i, i) = 1;
    if (n > 0)
    {
      std::vector<double> tau(n);
      with_work("dgeqrf", [&](double *work, const int &n_work, int &info)
                { dealii::geqrf(&rows, &n, &columns(0, 0), &rows, tau.data(), work, &n_work, &info); });
      double largest = 0, smallest = std::abs(columns(0, 0));
      for (int k = 0; k < n; ++k)
      {
        largest = std::max(largest, std::abs(columns(k, k)));
        smallest = std::min(smallest, std::abs(columns(k, k)));
      }
      if (!(smallest > 1e-10 * largest))
        return {};
      with_work("dormqr",
                [&](double *work, const int &n_work, int &info)
                {
                  dealii::ormqr("L", "N", &rows, &rows, &n, &columns(0, 0), &rows, tau.data(), &Q(0, 0),
                                &rows, work, &n_work, &info);
                });
    }
    DenseMatrix basis(rows, rows - n);
    for (int j = n; j < rows; ++j)
      for (int i = 0; i < rows; ++i)
        basis(i, j - n) = Q(i, j);
    return basis;
  }
} // namespace vibrocontact

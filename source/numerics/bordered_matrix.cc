#include <vibrocontact/numerics/bordered_matrix.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vibrocontact
{
  bool BorderedMatrix::factorise(const DenseMatrix &J, const double a, const std::vector<double> &p,
                                 const double b, const std::vector<double> &row)
  {
    const unsigned int n = p.size(), size = n + 1;
    std::vector<double> matrix(std::size_t(size) * size);
    for (unsigned int j = 0; j < n; ++j)
    {
      for (unsigned int i = 0; i < n; ++i)
        matrix[std::size_t(j) * size + i] = a * J(i, j);
      matrix[std::size_t(j) * size + n] = row[j];
    }
    for (unsigned int i = 0; i < n; ++i)
      matrix[std::size_t(n) * size + i] = b * p[i];
    matrix[std::size_t(n) * size + n] = row[n];
    return std::all_of(matrix.begin(), matrix.end(),
                       [](const double value) { return std::isfinite(value); }) &&
           factors.factorise(std::move(matrix));
  }
} // namespace vibrocontact

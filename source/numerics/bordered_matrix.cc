#include <vibrocontact/numerics/bordered_matrix.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  bool BorderedMatrix::factorise(const DenseMatrix &J, const double a, const std::vector<double> &p,
                                 const double b, const std::vector<double> &row)
  {
    const unsigned int n = p.size();
    size = n + 1;
    matrix.resize(std::size_t(size) * size);
    pivots.resize(size);
    for (unsigned int j = 0; j < n; ++j)
    {
      for (unsigned int i = 0; i < n; ++i)
        matrix[std::size_t(j) * size + i] = a * J(i, j);
      matrix[std::size_t(j) * size + n] = row[j];
    }
    for (unsigned int i = 0; i < n; ++i)
      matrix[std::size_t(n) * size + i] = b * p[i];
    matrix[std::size_t(n) * size + n] = row[n];
    if (!std::all_of(matrix.begin(), matrix.end(), [](const double value) { return std::isfinite(value); }))
      return false;
    dealii::types::blas_int info;
    dealii::getrf(&size, &size, matrix.data(), &size, pivots.data(), &info);
    return info == 0;
  }

  int BorderedMatrix::sign() const
  {
    int result = 1;
    for (dealii::types::blas_int i = 0; i < size; ++i)
      if ((matrix[std::size_t(i) * size + i] < 0) != (pivots[i] != i + 1))
        result = -result;
    return result;
  }

  void BorderedMatrix::solve(std::vector<double> &rhs) const
  {
    const dealii::types::blas_int one = 1;
    dealii::types::blas_int info;
    dealii::getrs("N", &size, &one, matrix.data(), &size, pivots.data(), rhs.data(), &size, &info);
  }
} // namespace vibrocontact

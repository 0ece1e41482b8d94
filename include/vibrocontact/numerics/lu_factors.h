#pragma once

#include <deal.II/base/types.h>
#include <deal.II/lac/lapack_templates.h>

#include <cmath>
#include <complex>
#include <type_traits>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// P A = L U of a square matrix by LAPACK's getrf, and what can be read off it.
  template <typename Number>
  class LuFactors
  {
  public:
    /// @param columns of the matrix, one behind the other @return whether no pivot is zero
    bool factorise(std::vector<Number> columns)
    {
      lu = std::move(columns);
      n = std::lround(std::sqrt(lu.size()));
      pivots.resize(n);
      dealii::types::blas_int info = 0;
      if (n > 0)
        dealii::getrf(&n, &n, lu.data(), &n, pivots.data(), &info);
      return info == 0;
    }

    /// @param columns right sides one behind the other, then the solutions
    void solve(std::vector<Number> &columns) const
    {
      if (n == 0)
        return;
      const dealii::types::blas_int n_columns = columns.size() / n;
      dealii::types::blas_int info = 0;
      dealii::getrs("N", &n, &n_columns, lu.data(), &n, pivots.data(), columns.data(), &n, &info);
    }

    /// A logarithm of the determinant, which would overflow; its real part is that of the modulus.
    std::complex<double> log_determinant() const
    {
      std::complex<double> sum = 0;
      for (dealii::types::blas_int k = 0; k < n; ++k)
        sum += std::log(std::complex<double>(pivot(k)));
      return sum;
    }

    /// Sign of a real determinant.
    int sign() const
    {
      static_assert(std::is_same<Number, double>::value, "Only real determinants have a sign.");
      int result = 1;
      for (dealii::types::blas_int k = 0; k < n; ++k)
        if (pivot(k) < 0)
          result = -result;
      return result;
    }

  private:
    /// Of U, with the sign of the exchange of rows.
    Number pivot(const dealii::types::blas_int k) const
    {
      const Number value = lu[std::size_t(k) * n + k];
      return pivots[k] == k + 1 ? value : -value;
    }

    dealii::types::blas_int n = 0;
    std::vector<Number> lu;
    std::vector<dealii::types::blas_int> pivots;
  };
} // namespace vibrocontact

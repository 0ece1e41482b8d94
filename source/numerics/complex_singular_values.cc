#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/complex_singular_values.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <string>

namespace vibrocontact
{
  ComplexSingularValues complex_singular_values(dealii::LAPACKFullMatrix<std::complex<double>> A)
  {
    const dealii::types::blas_int m = A.m(), n = A.n(), k = std::min(m, n), ask = -1;
    ComplexSingularValues result;
    result.values.resize(k);
    result.left.reinit(m, k);
    result.right.reinit(k, n);
    std::vector<double> real_work(
        std::max<std::size_t>(5 * k * k + 7 * k, 2 * std::max(m, n) * k + 2 * k * k + k));
    std::vector<dealii::types::blas_int> integer_work(8 * k);
    std::vector<std::complex<double>> work(1);
    dealii::types::blas_int info = 0;
    const auto call = [&](const dealii::types::blas_int &n_work)
    {
      dealii::gesdd("S", &m, &n, &A(0, 0), &m, result.values.data(), &result.left(0, 0), &m,
                    &result.right(0, 0), &k, work.data(), &n_work, real_work.data(), integer_work.data(),
                    &info);
    };
    call(ask);
    const dealii::types::blas_int n_work = work[0].real();
    work.resize(n_work);
    call(n_work);
    if (info != 0)
      throw ConvergenceError("LAPACK found no singular values (zgesdd: " + std::to_string(info) + ").");
    return result;
  }
} // namespace vibrocontact

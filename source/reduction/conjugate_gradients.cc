#include <vibrocontact/reduction/conjugate_gradients.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    /// of a product, relative to |A| |x|
    constexpr double rounding = 1e-15;
  } // namespace

  ConjugateGradientsResult conjugate_gradients(const MPI_Comm communicator, const ColumnOperator &matrix,
                                               const ColumnOperator &preconditioner,
                                               std::vector<double> &columns, const unsigned int n_columns,
                                               const double matrix_norm, const double tolerance,
                                               const unsigned int most_iterations)
  {
    const std::size_t n = n_columns > 0 ? columns.size() / n_columns : 0;
    const auto products = [&](const std::vector<double> &a, const std::vector<double> &b)
    {
      std::vector<double> result(n_columns);
      for (unsigned int j = 0; j < n_columns; ++j)
        result[j] = std::inner_product(a.begin() + j * n, a.begin() + (j + 1) * n, b.begin() + j * n, 0.);
      MPI_Allreduce(MPI_IN_PLACE, result.data(), n_columns, MPI_DOUBLE, MPI_SUM, communicator);
      return result;
    };
    // largest |r| / scale; not a number stays one
    const auto largest_ratio =
        [&](const std::vector<double> &rr, const std::function<double(unsigned int)> &scale)
    {
      double largest = 0;
      for (unsigned int j = 0; j < n_columns && !std::isnan(largest); ++j)
      {
        const double ratio = scale(j) > 0 ? std::sqrt(rr[j]) / scale(j) : 0.;
        if (!(ratio <= largest))
          largest = ratio;
      }
      return largest;
    };

    ConjugateGradientsResult result;
    const std::vector<double> b = columns;
    const std::vector<double> bb = products(b, b);
    const auto length = [&](const unsigned int j) { return std::sqrt(bb[j]); };
    std::vector<double> r = b, rr = bb, direction, rho(n_columns, 0.);
    std::vector<double> &x = columns;
    std::fill(x.begin(), x.end(), 0.);
    result.residual = largest_ratio(rr, length);
    bool is_sound = true;
    while (result.residual > tolerance && is_sound && result.n_iterations < most_iterations)
    {
      {
        const std::vector<double> z = preconditioner(r, n_columns);
        const std::vector<double> rz = products(r, z);
        for (unsigned int j = 0; j < n_columns; ++j)
        {
          const double beta = rho[j] > 0 ? rz[j] / rho[j] : 0.;
          rho[j] = rz[j];
          if (direction.empty())
            direction.assign(z.size(), 0.);
          for (std::size_t i = j * n; i < (j + 1) * n; ++i)
            direction[i] = z[i] + beta * direction[i];
        }
      }
      const std::vector<double> q = matrix(direction, n_columns);
      const std::vector<double> energy = products(direction, q);
      for (unsigned int j = 0; j < n_columns; ++j)
      {
        const bool stands = !(rr[j] > tolerance * tolerance * bb[j]);
        is_sound = is_sound && (stands || (rho[j] > 0 && energy[j] > 0));
        const double alpha = stands || !is_sound ? 0. : rho[j] / energy[j];
        for (std::size_t i = j * n; i < (j + 1) * n; ++i)
        {
          x[i] += alpha * direction[i];
          r[i] -= alpha * q[i];
        }
      }
      rr = products(r, r);
      result.residual = largest_ratio(rr, length);
      ++result.n_iterations;
    }
    r = matrix(x, n_columns);
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] = b[i] - r[i];
    const std::vector<double> xx = products(x, x);
    result.measured =
        largest_ratio(products(r, r), [&](const unsigned int j)
                      { return length(j) + rounding * matrix_norm * std::sqrt(xx[j]) / tolerance; });
    result.converged = is_sound && result.residual <= tolerance && result.measured <= tolerance;
    return result;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/multipliers.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/numerics/eigenvalues.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    /// between the motion and the eigenvector of the trivial multiplier; less: it is that of another one
    constexpr double least_cosine = 0.9;
    /// of inverse iterations, and what is left of an eigenvector that is found
    constexpr unsigned int most_iterations = 8;
    constexpr double eigenvector_tolerance = 1e-10;

    /// The eigenvector of unit length with a real value that a direction of unit length is nearly, by inverse iterations with
    /// Rayleigh quotients (Golub and Van Loan 2013, 8.2.3); nothing if there is none.
    std::optional<DenseVector> eigenvector_near(const DenseMatrix &matrix, const DenseVector &direction)
    {
      const unsigned int n = matrix.m();
      DenseVector x = direction, image(n);
      for (unsigned int k = 0; k < most_iterations; ++k)
      {
        matrix.vmult(image, x);
        const double quotient = x * image;
        image.add(-quotient, x);
        if (image.l2_norm() < eigenvector_tolerance)
          return std::abs(x * direction) >= least_cosine ? std::optional<DenseVector>(x) : std::nullopt;
        DenseMatrix shifted = matrix;
        // an exact value would leave nothing to divide by
        for (unsigned int i = 0; i < n; ++i)
          shifted(i, i) -= quotient * (1 + 4 * std::numeric_limits<double>::epsilon());
        if (!factorise_lu(shifted))
          return {};
        shifted.solve(x);
        x /= x.l2_norm();
      }
      return {};
    }
  } // namespace

  std::optional<bool> CycleStability::decided() const
  {
    if (multipliers.empty() || multipliers.front().growth < -uncertainty)
      return true;
    return multipliers.front().growth > uncertainty ? std::optional<bool>(false) : std::nullopt;
  }

  std::string CycleStability::verdict() const
  {
    if (is_stable())
      return "stable";
    if (!is_unstable())
      return "neutral";
    const std::complex<double> largest = multipliers.front().value;
    if (largest.imag() != 0)
      return "torus";
    return largest.real() > 0 ? "fold" : "period doubling";
  }

  CycleStability cycle_stability(const DenseMatrix &monodromy, const DenseVector &rate, const double period)
  {
    const unsigned int n = monodromy.m();
    DenseVector along(n), next(n);
    // what the rate has beside the direction of the motion is gone after a period
    monodromy.vmult(along, rate);
    along /= along.l2_norm();
    // at a fold two multipliers meet at 1 and may part as a pair, which leaves the trivial one without a direction of its own
    if (const std::optional<DenseVector> own = eigenvector_near(monodromy, along))
      along = *own;
    monodromy.vmult(next, along);
    DenseMatrix rest = monodromy;
    DenseVector shares(n);
    monodromy.Tvmult(shares, along);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        rest(i, j) -= along[i] * shares[j];
    std::vector<std::complex<double>> values = general_eigenvalues(rest);
    // that of the direction, which was taken out
    values.erase(std::min_element(values.begin(), values.end(),
                                  [](const auto &a, const auto &b) { return std::abs(a) < std::abs(b); }));
    CycleStability result;
    next -= along;
    result.trivial_error = next.l2_norm();
    result.uncertainty = result.trivial_error / period;
    for (const std::complex<double> &mu : values)
    {
      // of a pair the second; what is gone within a period is no disturbance that lasts
      if (mu.imag() < 0 || !(std::abs(mu) > 1e-12))
        continue;
      result.multipliers.push_back(
          {mu, std::log(std::abs(mu)) / period, std::abs(std::arg(mu)) / (2 * dealii::numbers::PI * period)});
    }
    std::sort(result.multipliers.begin(), result.multipliers.end(),
              [](const Multiplier &a, const Multiplier &b) { return a.growth > b.growth; });
    return result;
  }
} // namespace vibrocontact

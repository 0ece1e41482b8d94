#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/least_squares.h>
#include <vibrocontact/numerics/vector_fitting.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  std::vector<Complex> starting_poles(const std::vector<double> &omega, const unsigned int n_pairs)
  {
    std::vector<Complex> poles;
    const double first = omega.front(), last = omega.back();
    for (unsigned int k = 0; k < n_pairs; ++k)
    {
      const double w = first + (last - first) * (k + 1.) / (n_pairs + 1.);
      poles.emplace_back(-0.05 * w, w);
    }
    return poles;
  }

  namespace
  {
    /// E of fits that are exact, poles on the lines of undamped resonances included
    constexpr double round_off = 1e-6;

    /// Sum of c_k over the poles as a row: what a numerator that falls like 1/s^2 has to keep at zero.
    std::vector<double> sum_row(const std::vector<Complex> &poles)
    {
      std::vector<double> row;
      for (const Complex &pole : poles)
        if (pole.imag() == 0)
          row.push_back(1);
        else
          row.insert(row.end(), {2., 0.});
      return row;
    }

    /// A basis of the functions without that sum: A H without its first column, H the reflection that takes the
    /// row to the first unit vector.
    DenseMatrix without_sum(const DenseMatrix &A, std::vector<double> row)
    {
      double length = 0;
      for (const double value : row)
        length = std::hypot(length, value);
      row[0] += row[0] >= 0 ? length : -length;
      double square = 0;
      for (const double value : row)
        square += value * value;
      DenseMatrix result(A.m(), A.n() - 1);
      for (unsigned int l = 0; l < A.m(); ++l)
      {
        double product = 0;
        for (unsigned int c = 0; c < A.n(); ++c)
          product += A(l, c) * row[c];
        for (unsigned int c = 1; c < A.n(); ++c)
          result(l, c - 1) = A(l, c) - 2 * product / square * row[c];
      }
      return result;
    }

    double mean_magnitude(const Spectra &data, const unsigned int entry)
    {
      double sum = 0;
      for (unsigned int l = 0; l < data.omega.size(); ++l)
        sum += data.weight_of(l) * std::abs(data.values[entry][l]);
      return sum > 0 ? sum / data.omega.size() : 1;
    }

    /// Zeros of sum_k c_k phi_k + d.
    std::vector<Complex> zeros(const std::vector<Complex> &poles, const std::vector<double> &c,
                               const double d)
    {
      const unsigned int n = c.size();
      DenseMatrix A(n, n);
      unsigned int at = 0;
      for (const Complex &pole : poles)
      {
        const bool real = pole.imag() == 0;
        A(at, at) = pole.real();
        if (!real)
        {
          A(at, at + 1) = pole.imag();
          A(at + 1, at) = -pole.imag();
          A(at + 1, at + 1) = pole.real();
        }
        for (unsigned int j = 0; j < n; ++j)
          A(at, j) -= (real ? 1 : 2) * c[j] / d;
        at += real ? 1 : 2;
      }
      return general_eigenvalues(A);
    }
  } // namespace

  std::vector<Complex> relocate_poles(const Spectra &data, const std::vector<Complex> &poles,
                                      const ResidueRules &rules)
  {
    const unsigned int n_lines = data.omega.size();
    const DenseMatrix basis = pole_basis(data.omega, poles);
    const bool zero = rules.zero_initial_value && !rules.direct;
    const DenseMatrix own = zero ? without_sum(basis, sum_row(poles)) : basis;
    const unsigned int n = basis.n(), n_own = own.n() + rules.direct, n_block = n + 1;

    DenseMatrix system(data.n_entries() * n_block + 1, n_block), right(system.m(), 1);
    DenseMatrix columns(2 * n_lines, n_own + n_block);
    double size = 0;
    for (unsigned int i = 0; i < data.n_entries(); ++i)
    {
      const double size_of_entry = mean_magnitude(data, i);
      const auto weight = [&](const unsigned int l) { return data.weight_of(l) / size_of_entry; };
      columns = 0;
      for (unsigned int c = 0; c < own.n(); ++c)
        for (unsigned int l = 0; l < 2 * n_lines; ++l)
          columns(l, c) = weight(l % n_lines) * own(l, c);
      for (unsigned int l = 0; l < n_lines; ++l)
      {
        if (rules.direct)
          columns(l, n_own - 1) = weight(l);
        const Complex value = -weight(l) * data.values[i][l];
        size += std::norm(value);
        for (unsigned int c = 0; c < n_block; ++c)
        {
          const Complex product = value * (c < n ? Complex(basis(l, c), basis(n_lines + l, c)) : Complex(1));
          columns(l, n_own + c) = product.real();
          columns(n_lines + l, n_own + c) = product.imag();
        }
      }
      const DenseMatrix R = triangular_factor(columns);
      for (unsigned int r = 0; r < n_block; ++r)
        for (unsigned int c = r; c < n_block; ++c)
          system(i * n_block + r, c) = R(n_own + r, n_own + c);
    }
    const double scale = std::sqrt(size) / n_lines;
    const unsigned int last = system.m() - 1;
    for (unsigned int c = 0; c < n; ++c)
      for (unsigned int l = 0; l < n_lines; ++l)
        system(last, c) += scale * basis(l, c);
    system(last, n) = scale * n_lines;
    right(last, 0) = scale * n_lines;

    const DenseMatrix x = least_squares(system, right);
    std::vector<double> c(n);
    for (unsigned int k = 0; k < n; ++k)
      c[k] = x(k, 0);
    // a bracket without constant has a zero at infinity
    const double d = std::copysign(std::max(std::abs(x(n, 0)), 1e-10), x(n, 0));

    std::vector<Complex> result;
    const double smallest = 1e-12 * data.omega.back();
    for (const Complex &zero_of_bracket : zeros(poles, c, d))
      if (zero_of_bracket.imag() >= 0)
        result.emplace_back(-std::max(std::abs(zero_of_bracket.real()), smallest), zero_of_bracket.imag());
    std::sort(result.begin(), result.end(),
              [](const Complex &a, const Complex &b)
              { return a.imag() != b.imag() ? a.imag() < b.imag() : a.real() < b.real(); });
    return result;
  }

  PoleFit vector_fit(const Spectra &data, const unsigned int n_pairs, const VectorFittingOptions &options)
  {
    std::vector<Complex> poles = starting_poles(data.omega, n_pairs);
    PoleFit best;
    double least = std::numeric_limits<double>::max(), before = 0;
    unsigned int n_still = 0;
    for (unsigned int iteration = 0; iteration < options.n_iterations && n_still < 3; ++iteration)
    {
      poles = relocate_poles(data, poles, options.rules);
      const PoleFit fit = fit_residues(data, poles, options.rules);
      const double error = worst_error(data, fit);
      // an exact fit is left with the noise of its round-off
      n_still = std::abs(error - before) < 1e-4 * error || error < round_off ? n_still + 1 : 0;
      before = error;
      if (error < least)
      {
        least = error;
        best = fit;
      }
    }
    best.converged = n_still >= 3;
    return best;
  }
} // namespace vibrocontact

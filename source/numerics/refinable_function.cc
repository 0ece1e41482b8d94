#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/least_squares.h>
#include <vibrocontact/numerics/refinable_function.h>

#include <boost/math/filters/daubechies.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    using Mask = RefinableFunction::Mask;

    /// p(z) / ((1 + z) / 2); the remainder is zero.
    Mask without_factor(const Mask &p)
    {
      Mask quotient(p.size() - 1);
      long double last = 0;
      for (unsigned int i = 0; i < quotient.size(); ++i)
        quotient[i] = last = 2 * p[i] - last;
      return quotient;
    }

    Mask convolution(const Mask &a, const Mask &b)
    {
      Mask c(a.size() + b.size() - 1, 0.);
      for (unsigned int i = 0; i < a.size(); ++i)
        for (unsigned int j = 0; j < b.size(); ++j)
          c[i + j] += a[i] * b[j];
      return c;
    }

    /// [p_{2i-j}], i, j = begin .. end - 1
    DenseMatrix refinement_matrix(const Mask &p, const int begin, const int end)
    {
      DenseMatrix A(end - begin, end - begin);
      for (int i = begin; i < end; ++i)
        for (int j = begin; j < end; ++j)
          if (const int k = 2 * i - j; k >= 0 && k < static_cast<int>(p.size()))
            A(i - begin, j - begin) = p[k];
      return A;
    }

    /// Values at 0 .. support of the function with this mask if it is continuous: eigenvalue 1 is simple and the
    /// others are smaller (double ones are found to the root of round-off).
    std::optional<std::vector<double>> values_at_integers(const Mask &p)
    {
      const int support = p.size() - 1;
      if (support < 2)
        return {};
      DenseMatrix A = refinement_matrix(p, 1, support);
      unsigned int n_large = 0;
      for (const auto &lambda : general_eigenvalues(A))
        n_large += std::abs(lambda) > 1 - 1e-5;
      if (n_large != 1)
        return {};
      DenseMatrix equations(support, support - 1), residual(support, 1);
      for (int j = 0; j < support - 1; ++j)
      {
        for (int i = 0; i < support - 1; ++i)
          equations(i, j) = A(i, j) - (i == j);
        equations(support - 1, j) = 1;
      }
      // residuals in more digits, as the mask has
      std::vector<long double> v(support + 1, 0.);
      for (unsigned int step = 0; step < 3; ++step)
      {
        long double sum = 1;
        for (int i = 1; i < support; ++i)
        {
          long double r = v[i];
          for (int j = std::max(0, 2 * i - support); j <= std::min(support, 2 * i); ++j)
            r -= p[2 * i - j] * v[j];
          residual(i - 1, 0) = r;
          sum -= v[i];
        }
        residual(support - 1, 0) = sum;
        const DenseMatrix correction = least_squares(equations, residual);
        for (int i = 1; i < support; ++i)
          v[i] += correction(i - 1, 0);
      }
      return std::vector<double>(v.begin(), v.end());
    }

    /// d-th differences, f(i) - f(i - 1), f zero outside.
    std::vector<double> differences(std::vector<double> f, const unsigned int d)
    {
      for (unsigned int n = 0; n < d; ++n)
      {
        f.push_back(0);
        for (unsigned int i = f.size() - 1; i > 0; --i)
          f[i] -= f[i - 1];
      }
      return f;
    }

    template <unsigned int p>
    Mask filter()
    {
      const auto values = boost::math::filters::daubechies_scaling_filter<long double, p>();
      return {values.begin(), values.end()};
    }

    template <std::size_t... i>
    Mask filter(const unsigned int p, std::index_sequence<i...>)
    {
      using Filter = Mask (*)();
      const Filter table[] = {&filter<i + 2>...};
      return table[p - 2]();
    }
  } // namespace

  RefinableFunction::RefinableFunction(Mask mask_, const unsigned int order)
      : mask(std::move(mask_)), n_factors(order), mean(0)
  {
    for (unsigned int i = 0; i < mask.size(); ++i)
      mean += i * mask[i] / 2;
    Mask p = mask;
    for (unsigned int d = 0; d <= 3 && d < n_factors; ++d, p = without_factor(p))
    {
      const auto integers =
          p.size() == 2 ? std::make_optional(std::vector<double>{1., 0.}) : values_at_integers(p);
      if (!integers)
        break;
      derivatives.push_back({{p.begin(), p.end()}, {integers->begin(), integers->end() - 1}});
    }
  }

  double RefinableFunction::smoothness() const
  {
    Mask q = mask;
    for (unsigned int i = 0; i < n_factors; ++i)
      q = without_factor(q);
    Mask reversed(q.rbegin(), q.rend()), square = convolution(q, reversed);
    // q / 2 is 1 at z = 1; the operator carries a factor of two
    for (long double &value : square)
      value /= 2;
    double radius = 0;
    for (const auto &lambda : general_eigenvalues(refinement_matrix(square, 0, square.size())))
      radius = std::max(radius, std::abs(lambda));
    return n_factors - std::log2(radius) / 2;
  }

  std::vector<double> RefinableFunction::values(const double x, const unsigned int d) const
  {
    const auto &[p, integers] = derivatives.at(d);
    const unsigned int n = integers.size();
    constexpr unsigned int n_digits = 52;
    std::uint64_t digits = static_cast<std::uint64_t>(std::ldexp(x, n_digits));
    std::vector<double> v = integers, next(n);
    bool leading = true;
    for (unsigned int digit = 0; digit < n_digits; ++digit, digits >>= 1)
    {
      const unsigned int b = digits & 1;
      if (leading && b == 0)
        continue;
      leading = false;
      for (unsigned int i = 0; i < n; ++i)
      {
        double sum = 0;
        const unsigned int last = 2 * i + b, first = last < p.size() ? 0 : last - (p.size() - 1);
        for (unsigned int j = first; j < n && j <= last; ++j)
          sum += p[last - j] * v[j];
        next[i] = sum;
      }
      v.swap(next);
    }
    v = differences(v, d);
    v.resize(support(), 0.);
    return v;
  }

  std::complex<double> RefinableFunction::fourier_transform(const double omega) const
  {
    std::complex<double> product = 1;
    double xi = omega / 2;
    for (; std::abs(xi) > 1e-8; xi /= 2)
    {
      const std::complex<double> z = std::polar(1., -xi);
      std::complex<double> symbol = 0;
      for (unsigned int i = mask.size(); i-- > 0;)
        symbol = symbol * z + static_cast<double>(mask[i] / 2);
      product *= symbol;
    }
    // what is left is the transform at 2 xi, a shift by the mean to the second order
    return product * std::polar(1., -mean * 2 * xi);
  }

  RefinableFunction b_spline(const unsigned int order)
  {
    Mask mask{2.};
    for (unsigned int i = 0; i < order; ++i)
      mask = convolution(mask, {0.5, 0.5});
    return {mask, order};
  }

  RefinableFunction daubechies(const unsigned int n_coefficients)
  {
    if (n_coefficients < 4 || n_coefficients > 38 || n_coefficients % 2 != 0)
      throw InputError("There is no Daubechies filter of " + std::to_string(n_coefficients) +
                       " coefficients; even numbers from 4 to 38 exist.");
    Mask mask = filter(n_coefficients / 2, std::make_index_sequence<18>());
    for (long double &p : mask)
      p *= std::sqrt(2.L);
    return {mask, n_coefficients / 2};
  }

  double ConnectionCoefficients::operator()(const int k) const
  {
    const int i = k - first;
    return i >= 0 && i < static_cast<int>(values.size()) ? values[i] : 0;
  }

  ConnectionCoefficients connection_coefficients(const RefinableFunction &phi, const RefinableFunction &chi,
                                                 const unsigned int d)
  {
    Mask reversed(chi.coefficients().rbegin(), chi.coefficients().rend()),
        p = convolution(phi.coefficients(), reversed);
    for (long double &value : p)
      value /= 2;
    const unsigned int order = phi.order() + chi.order();
    for (unsigned int i = 0; i < d && i < order; ++i)
      p = without_factor(p);
    const auto integers = d < order ? values_at_integers(p) : std::nullopt;
    if (!integers)
      throw InputError("The integrals between functions of " + std::to_string(phi.coefficients().size()) +
                       " and " + std::to_string(chi.coefficients().size()) +
                       " coefficients are not determined by their recursion for derivative " +
                       std::to_string(d) + "; take smoother functions.");
    std::vector<double> values = differences(*integers, d);
    std::reverse(values.begin(), values.end());
    return {-static_cast<int>(phi.support()), values};
  }
} // namespace vibrocontact

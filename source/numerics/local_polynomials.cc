#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/numerics/local_polynomials.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    constexpr unsigned int n_circle = 6, most_quarterings = 6;
    /// of Im s: side of the largest cells
    constexpr double largest_cell = 1e-3;
    /// of a side: radius of the circle, which holds the corners
    constexpr double circle = 0.75;
    /// of the first coefficient: what the last one may be; the next one, which is left out, is some twenty times smaller
    constexpr double resolved = 1e-7;

    double largest_modulus(const ComplexMatrix &matrix)
    {
      double result = 0;
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int i = 0; i < matrix.m(); ++i)
        {
          const double one = std::abs(matrix(i, j));
          if (!std::isfinite(one))
            return one;
          result = std::max(result, one);
        }
      return result;
    }

    /// a x + b y (deal.II multiplies a matrix by real numbers only)
    ComplexMatrix sum(const ComplexMatrix &x, const Complex &a, const ComplexMatrix &y, const Complex &b)
    {
      ComplexMatrix result(x.m(), x.n());
      result.add(a, x);
      result.add(b, y);
      return result;
    }
  } // namespace

  LocalPolynomials::Cell LocalPolynomials::made(const Complex &centre, const double radius)
  {
    Cell cell;
    cell.centre = centre;
    cell.radius = radius;
    std::vector<ComplexMatrix> coefficients(n_circle);
    try
    {
      for (unsigned int k = 0; k < n_circle; ++k)
      {
        const auto root_of_unity = [&](const unsigned int power)
        { return std::polar(1., 2 * dealii::numbers::PI * (power % n_circle) / n_circle); };
        const ComplexMatrix value = f(centre + radius * root_of_unity(k));
        ++evaluations;
        for (unsigned int j = 0; j < n_circle; ++j)
        {
          if (k == 0)
            coefficients[j].reinit(value.m(), value.n());
          coefficients[j].add(std::conj(root_of_unity(j * k)) / double(n_circle), value);
        }
      }
    }
    catch (const ConvergenceError &)
    {
      // the circle leaves where f is known
      return cell;
    }
    const ComplexMatrix &mean = coefficients.front();
    if (!std::isfinite(largest_modulus(mean)))
      throw ConvergenceError("A receptance is no number.");
    if (largest_modulus(coefficients.back()) <= resolved * largest_modulus(coefficients.front()))
      cell.coefficients = std::move(coefficients);
    return cell;
  }

  const LocalPolynomials::Cell &LocalPolynomials::cell(const Complex &s)
  {
    if (!(s.imag() > 0) || !std::isfinite(std::abs(s)))
      throw ConvergenceError("A receptance is asked for at a complex frequency that does not oscillate.");
    double side = largest_cell;
    for (unsigned int times = 0; times <= most_quarterings; ++times, side /= 2)
    {
      const double along = std::floor(std::log(s.imag()) / side),
                   across = std::floor(s.real() / s.imag() / side);
      const std::array<long, 3> place = {{long(times), std::lround(along), std::lround(across)}};
      auto known = cells.find(place);
      if (known == cells.end())
      {
        const double omega = std::exp((along + 0.5) * side);
        known = cells.emplace(place, made(omega * Complex((across + 0.5) * side, 1), circle * side * omega))
                    .first;
      }
      if (!known->second.coefficients.empty())
        return known->second;
    }
    throw ConvergenceError("A receptance is not smooth near " +
                           number_text(s.imag() / (2 * dealii::numbers::PI)) + " Hz, growth " +
                           number_text(s.real()) + " 1/s.");
  }

  ComplexMatrix LocalPolynomials::value(const Complex &s)
  {
    const Cell &of = cell(s);
    const Complex y = (s - of.centre) / of.radius;
    ComplexMatrix result = of.coefficients.back();
    for (unsigned int j = n_circle - 1; j-- > 0;)
      result = sum(of.coefficients[j], 1., result, y);
    return result;
  }

  ComplexMatrix LocalPolynomials::derivative(const Complex &s)
  {
    const Cell &of = cell(s);
    const Complex y = (s - of.centre) / of.radius;
    ComplexMatrix result(of.coefficients.front().m(), of.coefficients.front().n());
    for (unsigned int j = n_circle - 1; j > 0; --j)
      result = sum(of.coefficients[j], double(j) / of.radius, result, y);
    return result;
  }
} // namespace vibrocontact

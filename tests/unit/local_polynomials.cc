// Polynomials on cells against the function they stand for: near a pole cells are quartered, beyond a cut they are refused.

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/local_polynomials.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;

  /// decay of the pole over its frequency
  LocalPolynomials::Function resonance(const double decay)
  {
    return [decay](const Complex &s)
    {
      const Complex pole = 5e3 * Complex(-decay, 1);
      ComplexMatrix result(1, 2);
      result(0, 0) = 1e3 / (s - pole);
      result(0, 1) = std::sqrt(s - pole);
      return result;
    };
  }
} // namespace

TEST(LocalPolynomials, ValueAndDerivativeAreThoseOfTheFunction)
{
  const LocalPolynomials::Function f = resonance(1e-2);
  LocalPolynomials nearby(f);
  for (unsigned int k = 0; k < 200; ++k)
  {
    const Complex s = 5e3 * Complex(4e-3 * std::cos(3. * k), 1 + 3e-3 * std::sin(7. * k));
    const Complex expected = f(s)(0, 0);
    EXPECT_LT(std::abs(nearby.value(s)(0, 0) - expected), 1e-7 * std::abs(expected));
    EXPECT_LT(std::abs(nearby.value(s)(0, 1) - f(s)(0, 1)), 1e-7 * std::abs(f(s)(0, 1)));
    const Complex slope = -1e-3 * expected * expected;
    EXPECT_LT(std::abs(nearby.derivative(s)(0, 0) - slope), 1e-5 * std::abs(slope));
    const unsigned int n = nearby.n_evaluations();
    nearby.value(s);
    EXPECT_EQ(nearby.n_evaluations(), n);
  }
}

TEST(LocalPolynomials, ValuesDoNotDependOnWhatWasAskedBefore)
{
  LocalPolynomials one(resonance(5e-3)), other(resonance(5e-3));
  const Complex s(3., 5e3);
  for (unsigned int k = 0; k < 30; ++k)
    one.value(Complex(3. - 0.5 * k, 5e3 + k));
  EXPECT_EQ(one.value(s)(0, 0), other.value(s)(0, 0));
  EXPECT_EQ(one.derivative(s)(0, 1), other.derivative(s)(0, 1));
}

TEST(LocalPolynomials, WhereTheFunctionIsNotSmoothTheyAreRefused)
{
  LocalPolynomials nearby(resonance(0));
  EXPECT_NO_THROW(nearby.value(Complex(20, 5e3)));
  EXPECT_THROW(nearby.value(Complex(1e-2, 5e3)), ConvergenceError);
  LocalPolynomials cut(
      [](const Complex &s)
      {
        if (s.real() < 0)
          throw ConvergenceError("no answer");
        return ComplexMatrix(1, 1);
      });
  EXPECT_THROW(cut.value(Complex(-1e-3, 5e3)), ConvergenceError);
}

#pragma once

#include <vibrocontact/base/complex_dense.h>

#include <array>
#include <complex>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// A matrix function of a complex variable that costs much, for many s in few places: polynomials on cells of the half plane
  /// Im s > 0, each made when it is first asked for,
  ///
  ///   f(s) = sum_j C_j ((s - c) / r)^j,      C_j = 1/n sum_k f(c + r w^k) w^(-j k),      w = exp(2 pi i / n)
  ///
  ///      _____________
  ///     |  . - - .    |  squares in log Im s and Re s / Im s, so that they grow with the frequency;
  ///     | '   +   '   |  n = 6 points on a circle about each
  ///     |  . _ _ .    |
  ///
  /// Where f is analytic in a disc of radius R about c the error falls as (r / R)^n. A cell whose last coefficient is not small is
  /// quartered. Which cell an s is in depends on s alone, so that values do not depend on what was asked before.
  class LocalPolynomials
  {
  public:
    using Function = std::function<ComplexMatrix(const std::complex<double> &)>;

    explicit LocalPolynomials(Function f) : f(std::move(f)) {}

    /// @throws ConvergenceError if the smallest cells are too large
    ComplexMatrix value(const std::complex<double> &s);
    ComplexMatrix derivative(const std::complex<double> &s);
    /// of f so far
    unsigned int n_evaluations() const { return evaluations; }

  private:
    struct Cell
    {
      std::complex<double> centre;
      double radius = 0;
      /// empty: to be quartered
      std::vector<ComplexMatrix> coefficients;
    };

    const Cell &cell(const std::complex<double> &s);
    Cell made(const std::complex<double> &centre, double radius);

    const Function f;
    unsigned int evaluations = 0;
    /// by times that they are quartered, and their place
    std::map<std::array<long, 3>, Cell> cells;
  };
} // namespace vibrocontact

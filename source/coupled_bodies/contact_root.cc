#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/contact_root.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    using ComplexVector = dealii::Vector<Complex>;

    /// Equations and unknowns have their own units.
    struct Scales
    {
      std::vector<double> row, column;

      explicit Scales(const ComplexMatrix &F) : row(F.m(), 0.), column(F.n(), 0.)
      {
        for (unsigned int j = 0; j < F.n(); ++j)
          for (unsigned int i = 0; i < F.m(); ++i)
            row[i] = std::max(row[i], std::abs(F(i, j)));
        for (double &value : row)
          value = value > 0 ? 1 / value : 1;
        for (unsigned int j = 0; j < F.n(); ++j)
          for (unsigned int i = 0; i < F.m(); ++i)
            column[j] = std::max(column[j], row[i] * std::abs(F(i, j)));
        for (double &value : column)
          value = value > 0 ? 1 / value : 1;
      }
      ComplexMatrix applied(ComplexMatrix F) const
      {
        for (unsigned int j = 0; j < F.n(); ++j)
          for (unsigned int i = 0; i < F.m(); ++i)
            F(i, j) *= row[i] * column[j];
        return F;
      }
    };

    ComplexVector times(const ComplexMatrix &A, const ComplexVector &x)
    {
      ComplexVector y(A.m());
      A.vmult(y, x);
      return y;
    }

    /// Puts the largest component to 1.
    void normalise(ComplexVector &x)
    {
      Complex largest = 0;
      for (const Complex &value : x)
        if (std::abs(value) > std::abs(largest))
          largest = value;
      x /= largest;
    }

    ConvergenceError no_root(const Complex &start)
    {
      return ConvergenceError("No root of the contact's equations is found from " +
                              number_text(start.imag() / (2 * dealii::numbers::PI)) + " Hz, growth " +
                              number_text(start.real()) + " 1/s.");
    }

    void solve(ComplexMatrix A, ComplexVector &b, const Complex &start)
    {
      try
      {
        A.compute_lu_factorization();
        A.solve(b);
      }
      catch (const dealii::ExceptionBase &)
      {
        throw no_root(start);
      }
    }

    ComplexVector nearest_to_singular(const ComplexMatrix &F, const Complex &start)
    {
      ComplexVector x(F.m());
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] = Complex(1, std::cos(1. + i));
      ComplexMatrix shifted = F;
      // F may be singular to the last digit at a root
      for (unsigned int i = 0; i < x.size(); ++i)
        shifted(i, i) += 1e-14;
      try
      {
        shifted.compute_lu_factorization();
        for (unsigned int pass = 0; pass < 2; ++pass)
        {
          shifted.solve(x);
          normalise(x);
        }
      }
      catch (const dealii::ExceptionBase &)
      {
        throw no_root(start);
      }
      return x;
    }
  } // namespace

  ContactRoot contact_root(const ContactReceptance &F, const Complex &start, std::vector<Complex> given)
  {
    constexpr unsigned int most_iterations = 30;
    constexpr double smallest_step = 1e-12;
    const unsigned int n = F.size();
    const ComplexMatrix first = F.value(start);
    const Scales scales(first);
    ComplexVector x(n);
    if (given.empty())
      x = nearest_to_singular(scales.applied(first), start);
    else
      for (unsigned int i = 0; i < n; ++i)
        x[i] = given[i] / scales.column[i];
    normalise(x);
    // c^H x = 1
    ComplexVector c = x;
    c /= x.norm_sqr();

    ContactRoot root;
    root.s = start;
    for (bool settled = false; !settled;)
    {
      if (++root.iterations > most_iterations)
        throw no_root(start);
      const ComplexMatrix value = scales.applied(F.value(root.s));
      const ComplexVector slope = times(scales.applied(F.derivative(root.s)), x), rest = times(value, x);
      ComplexMatrix bordered(n + 1, n + 1);
      ComplexVector step(n + 1);
      // s in units of its own size
      const double unit = std::max(std::abs(root.s), 1.);
      for (unsigned int j = 0; j < n; ++j)
      {
        for (unsigned int i = 0; i < n; ++i)
          bordered(i, j) = value(i, j);
        bordered(j, n) = unit * slope[j];
        bordered(n, j) = std::conj(c[j]);
        step[j] = -rest[j];
      }
      solve(std::move(bordered), step, start);
      for (unsigned int i = 0; i < n; ++i)
        x[i] += step[i];
      root.s += unit * step[n];
      if (!std::isfinite(std::abs(root.s)))
        throw no_root(start);
      settled = std::abs(step[n]) < smallest_step;
    }
    const ComplexMatrix value = scales.applied(F.value(root.s));
    double norm = 0;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        norm += std::norm(value(i, j));
    root.residual = times(value, x).l2_norm() / (std::sqrt(norm) * x.l2_norm());
    for (unsigned int i = 0; i < n; ++i)
      x[i] *= scales.column[i];
    normalise(x);
    root.x.assign(x.begin(), x.end());
    return root;
  }
} // namespace vibrocontact

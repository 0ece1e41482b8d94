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

    /// @param x to begin from
    ComplexVector nearest_to_singular(const ComplexMatrix &F, ComplexVector x, const unsigned int n_passes,
                                      const Complex &start)
    {
      ComplexMatrix shifted = F;
      // F may be singular to the last digit at a root
      for (unsigned int i = 0; i < x.size(); ++i)
        shifted(i, i) += 1e-14;
      try
      {
        shifted.compute_lu_factorization();
        for (unsigned int pass = 0; pass < n_passes; ++pass)
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

  namespace
  {
    /// The bordered matrix at s, factorised.
    class Bordered
    {
    public:
      /// @param value F(s), scaled @param unit of s
      void factorise(const ComplexMatrix &value, const ComplexVector &slope, const ComplexVector &c,
                     const double unit, const Complex &start)
      {
        const unsigned int n = value.m();
        matrix.reinit(n + 1, n + 1);
        for (unsigned int j = 0; j < n; ++j)
        {
          for (unsigned int i = 0; i < n; ++i)
            matrix(i, j) = value(i, j);
          matrix(j, n) = unit * slope[j];
          matrix(n, j) = std::conj(c[j]);
        }
        try
        {
          matrix.compute_lu_factorization();
        }
        catch (const dealii::ExceptionBase &)
        {
          throw no_root(start);
        }
      }
      void solve(ComplexVector &b, const Complex &start, const bool transposed = false) const
      {
        try
        {
          matrix.solve(b, transposed);
        }
        catch (const dealii::ExceptionBase &)
        {
          throw no_root(start);
        }
      }

    private:
      ComplexMatrix matrix;
    };
  } // namespace

  ContactRoot contact_root(const ContactReceptance &F, const Complex &start, std::vector<Complex> given,
                           const bool with_left_vector)
  {
    constexpr unsigned int most_iterations = 30;
    constexpr double smallest_step = 1e-12, slow = 0.1;
    const unsigned int n = F.size();
    const ComplexMatrix first = F.value(start);
    const Scales scales(first);
    ComplexVector x(n);
    for (unsigned int i = 0; i < n; ++i)
      x[i] = given.empty() ? Complex(1, std::cos(1. + i)) : given[i] / scales.column[i];
    const auto applied = [&](const auto &product_with)
    {
      ComplexVector scaled = x;
      for (unsigned int i = 0; i < n; ++i)
        scaled[i] *= scales.column[i];
      ComplexVector result = product_with(scaled);
      for (unsigned int i = 0; i < n; ++i)
        result[i] *= scales.row[i];
      return result;
    };
    ContactRoot root;
    root.s = start;
    const auto slope = [&]
    { return applied([&](const ComplexVector &v) { return F.derivative_times(root.s, v); }); };
    // F' x has a share of what makes F singular, which x itself need not have
    x = nearest_to_singular(scales.applied(first), given.empty() ? x : slope(), given.empty() ? 2 : 1, start);
    // c^H x = 1
    ComplexVector c = x;
    c /= x.norm_sqr();

    Bordered bordered;
    double unit = 1, last = 0;
    bool is_new = true;
    for (bool settled = false; !settled;)
    {
      if (++root.iterations > most_iterations)
        throw no_root(start);
      if (is_new)
      {
        // s in units of its own size
        unit = std::max(std::abs(root.s), 1.);
        bordered.factorise(scales.applied(root.iterations == 1 ? first : F.value(root.s)), slope(), c, unit,
                           start);
      }
      const ComplexVector rest = applied([&](const ComplexVector &v) { return F.times(root.s, v); });
      ComplexVector step(n + 1);
      for (unsigned int i = 0; i < n; ++i)
        step[i] = -rest[i];
      bordered.solve(step, start);
      for (unsigned int i = 0; i < n; ++i)
        x[i] += step[i];
      root.s += unit * step[n];
      if (!std::isfinite(std::abs(root.s)))
        throw no_root(start);
      const double size = std::abs(step[n]);
      settled = size < smallest_step;
      is_new = root.iterations > 1 && size > slow * last;
      last = size;
    }
    double norm = 0;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        norm += std::norm(first(i, j) * scales.row[i] * scales.column[j]);
    root.residual = applied([&](const ComplexVector &v) { return F.times(root.s, v); }).l2_norm() /
                    (std::sqrt(norm) * x.l2_norm());
    ComplexVector y(n + 1);
    if (with_left_vector)
    {
      bordered.factorise(scales.applied(F.value(root.s)), slope(), c, unit, start);
      y[n] = 1;
      bordered.solve(y, start, true);
      for (unsigned int i = 0; i < n; ++i)
        y[i] *= scales.row[i];
    }
    for (unsigned int i = 0; i < n; ++i)
      x[i] *= scales.column[i];
    normalise(x);
    root.x.assign(x.begin(), x.end());
    if (with_left_vector)
    {
      const ComplexVector moved = F.derivative_times(root.s, x);
      Complex size = 0;
      for (unsigned int i = 0; i < n; ++i)
        size += y[i] * moved[i];
      for (unsigned int i = 0; i < n; ++i)
        root.y.push_back(y[i] / size);
    }
    return root;
  }
} // namespace vibrocontact

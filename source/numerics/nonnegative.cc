#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/nonnegative.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// The minimum over the unknowns of a set, whatever its signs; the others are zero.
    std::vector<double> minimum_of_set(const DenseMatrix &K, const std::vector<double> &h,
                                       const std::vector<unsigned int> &set)
    {
      const unsigned int n = set.size();
      std::vector<double> x(h.size(), 0.);
      if (n == 0)
        return x;
      DenseMatrix part(n);
      DenseVector right(n);
      for (unsigned int a = 0; a < n; ++a)
      {
        for (unsigned int b = 0; b < n; ++b)
          part(a, b) = K(set[a], set[b]);
        part(a, a) *= 1 + 1e-12;
        right(a) = h[set[a]];
      }
      for (double raise = 1e-10; !factorise_cholesky(part); raise *= 100)
      {
        if (raise > 1)
          throw ConvergenceError(
              "The least change that makes the fitted poles passive has no solution: its matrix is not "
              "definite.");
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            part(a, b) = K(set[a], set[b]) * (a == b ? 1 + raise : 1);
      }
      part.solve(right);
      for (unsigned int a = 0; a < n; ++a)
        x[set[a]] = right(a);
      return x;
    }
  } // namespace

  std::vector<double> nonnegative_minimum(const DenseMatrix &K, const std::vector<double> &h,
                                          const std::vector<double> &start)
  {
    const unsigned int n = h.size();
    std::vector<double> x(n, 0.);
    std::copy(start.begin(), start.end(), x.begin());
    std::vector<unsigned int> set;
    for (unsigned int k = 0; k < n; ++k)
      if (x[k] > 0)
        set.push_back(k);
    double scale = 0;
    for (const double value : h)
      scale = std::max(scale, std::abs(value));
    for (unsigned int round = 0; round < 3 * n + 10; ++round)
    {
      // the free minimum of the set, as far as the signs allow
      while (!set.empty())
      {
        const std::vector<double> wanted = minimum_of_set(K, h, set);
        double step = 1;
        for (const unsigned int k : set)
          if (wanted[k] <= 0)
            step = std::min(step, x[k] / std::max(x[k] - wanted[k], std::numeric_limits<double>::min()));
        for (const unsigned int k : set)
          x[k] += step * (wanted[k] - x[k]);
        if (step == 1)
          break;
        std::vector<unsigned int> left;
        for (const unsigned int k : set)
          if (wanted[k] > 0 || x[k] > 1e-14 * std::abs(wanted[k]))
            left.push_back(k);
          else
            x[k] = 0;
        set = left;
      }
      // what would fall if it grew
      double steepest = 1e-10 * scale;
      unsigned int next = n;
      for (unsigned int k = 0; k < n; ++k)
        if (std::find(set.begin(), set.end(), k) == set.end())
        {
          double fall = h[k];
          for (const unsigned int j : set)
            fall -= K(k, j) * x[j];
          if (fall > steepest)
          {
            steepest = fall;
            next = k;
          }
        }
      if (next == n)
        break;
      set.push_back(next);
    }
    return x;
  }
} // namespace vibrocontact

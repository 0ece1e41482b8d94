#include <vibrocontact/numerics/piecewise_polynomial.h>
#include <vibrocontact/numerics/polynomial.h>
#include <vibrocontact/numerics/wide_loops.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int n = PiecewisePolynomial::n_coefficients;
    const double pi = std::acos(-1.);

    /// cos(pi j (i + 1/2) / n)
    struct Cosines
    {
      Cosines()
      {
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            values[j][i] = std::cos(pi * j * (i + 0.5) / n);
      }
      double values[n][n];
    };
    const Cosines cosines;

    /// Coefficients of Chebyshev polynomials of the interpolant in the n Chebyshev points.
    std::array<double, n> chebyshev(const std::array<double, n> &values)
    {
      std::array<double, n> c{};
      for (unsigned int j = 0; j < n; ++j)
      {
        for (unsigned int i = 0; i < n; ++i)
          c[j] += values[i] * cosines.values[j][i];
        c[j] *= (j == 0 ? 1. : 2.) / n;
      }
      return c;
    }

    std::array<double, n> powers(const std::array<double, n> &c)
    {
      // T_(j+1) = 2 y T_j - T_(j-1)
      std::array<double, n> before{}, now{}, result{};
      before[0] = 1;
      now[1] = 1;
      for (unsigned int i = 0; i < n; ++i)
        result[i] = c[0] * before[i] + c[1] * now[i];
      for (unsigned int j = 2; j < n; ++j)
      {
        std::array<double, n> next{};
        for (unsigned int i = 0; i < n; ++i)
          next[i] = (i > 0 ? 2 * now[i - 1] : 0.) - before[i];
        before = now;
        now = next;
        for (unsigned int i = 0; i < n; ++i)
          result[i] += c[j] * now[i];
      }
      return result;
    }
  } // namespace

  PiecewisePolynomial::PiecewisePolynomial(const std::function<double(double)> &f, const double begin,
                                           const double end, const double length)
  {
    const unsigned int n_first = std::max(1., std::ceil((end - begin) / length));
    double scale = 0;
    for (unsigned int k = 0; k < n_first; ++k)
      approximate(f, begin + (end - begin) * k / n_first, begin + (end - begin) * (k + 1) / n_first,
                  1e-6 * length, scale);
    ends.push_back(end);
    index();
  }

  void PiecewisePolynomial::approximate(const std::function<double(double)> &f, const double begin,
                                        const double end, const double shortest, double &scale)
  {
    std::array<double, n> values;
    for (unsigned int i = 0; i < n; ++i)
    {
      values[i] = f(0.5 * (begin + end) + 0.5 * (end - begin) * cosines.values[1][i]);
      scale = std::max(scale, std::abs(values[i]));
    }
    const std::array<double, n> c = chebyshev(values);
    // f is not known better than its argument
    double slope = 0;
    for (unsigned int j = 1; j < n; ++j)
      slope += j * j * std::abs(c[j]) * 2 / (end - begin);
    const double rounding = 1e-14 * scale + 1e-15 * std::max(std::abs(begin), std::abs(end)) * slope;
    if (std::abs(c[n - 1]) + std::abs(c[n - 2]) > rounding && end - begin > shortest)
    {
      approximate(f, begin, 0.5 * (begin + end), shortest, scale);
      approximate(f, 0.5 * (begin + end), end, shortest, scale);
      return;
    }
    ends.push_back(begin);
    pieces.push_back(powers(c));
  }

  PiecewisePolynomial PiecewisePolynomial::lines(const std::vector<double> &x, const std::vector<double> &y)
  {
    PiecewisePolynomial result;
    result.ends = x;
    for (std::size_t k = 0; k + 1 < x.size(); ++k)
      result.pieces.push_back(Piece{{0.5 * (y[k] + y[k + 1]), 0.5 * (y[k + 1] - y[k])}});
    result.index();
    return result;
  }

  PiecewisePolynomial PiecewisePolynomial::spline(const std::vector<double> &x, const std::vector<double> &y)
  {
    // second derivatives at the points by the tridiagonal equations of continuous first ones
    const std::size_t m = x.size();
    std::vector<double> second(m, 0.), upper(m, 0.);
    for (std::size_t k = 1; k + 1 < m; ++k)
    {
      const double left = x[k] - x[k - 1], right = x[k + 1] - x[k];
      const double pivot = 2 * (left + right) - left * upper[k - 1];
      upper[k] = right / pivot;
      second[k] = (6 * ((y[k + 1] - y[k]) / right - (y[k] - y[k - 1]) / left) - left * second[k - 1]) / pivot;
    }
    for (std::size_t k = m - 1; k-- > 1;)
      second[k] -= upper[k] * second[k + 1];
    PiecewisePolynomial result;
    result.ends = x;
    for (std::size_t k = 0; k + 1 < m; ++k)
    {
      const double h = x[k + 1] - x[k], s = h * h / 4;
      const double mean = 0.5 * (second[k] + second[k + 1]), slope = 0.5 * (second[k + 1] - second[k]);
      // y'' = mean + slope eta, integrated twice over eta in (-1, 1)
      result.pieces.push_back(
          Piece{{0.5 * (y[k] + y[k + 1]) - 0.5 * s * mean, 0.5 * (y[k + 1] - y[k]) - s * slope / 6,
                 0.5 * s * mean, s * slope / 6}});
    }
    result.index();
    return result;
  }

  PiecewisePolynomial PiecewisePolynomial::integral() const
  {
    PiecewisePolynomial result;
    result.ends = ends;
    double before = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k)
    {
      const double half = 0.5 * (ends[k + 1] - ends[k]);
      Piece piece{};
      for (unsigned int j = 0; j + 1 < n; ++j)
        piece[j + 1] = half * pieces[k][j] / (j + 1);
      double at_begin = 0, at_end = 0;
      for (unsigned int j = 1; j < n; ++j)
      {
        at_begin += j % 2 == 0 ? piece[j] : -piece[j];
        at_end += piece[j];
      }
      piece[0] = before - at_begin;
      before += at_end - at_begin;
      result.pieces.push_back(piece);
    }
    result.index();
    return result;
  }

  void PiecewisePolynomial::index()
  {
    const std::size_t n_intervals = 2 * pieces.size();
    per_length = n_intervals / (ends.back() - ends.front());
    first.resize(n_intervals + 1);
    unsigned int k = 0;
    for (std::size_t i = 0; i <= n_intervals; ++i)
    {
      const double x = ends.front() + i / per_length;
      while (k + 1 < pieces.size() && ends[k + 1] < x)
        ++k;
      first[i] = k;
    }
  }

  unsigned int PiecewisePolynomial::find(const double x) const
  {
    const double place = (x - ends.front()) * per_length;
    unsigned int k = first[place <= 0 ? 0 : std::min<std::size_t>(place, first.size() - 1)];
    while (k > 0 && x < ends[k])
      --k;
    while (k + 1 < pieces.size() && x >= ends[k + 1])
      ++k;
    return k;
  }

  double PiecewisePolynomial::value(const double x) const
  {
    const unsigned int k = find(x);
    const Piece &piece = pieces[k];
    const double y = (2 * x - ends[k] - ends[k + 1]) / (ends[k + 1] - ends[k]);
    return polynomial(piece.data(), n, y);
  }

  void PiecewisePolynomial::values(const double *x, const std::size_t m, double *result) const
  {
    for (std::size_t i = 0; i < m;)
    {
      // as many as lie on the same piece
      const unsigned int k = find(x[i]);
      const double per_half = 2 / (ends[k + 1] - ends[k]);
      const std::size_t first = i;
      do
      {
        result[i] = (2 * x[i] - ends[k] - ends[k + 1]) * 0.5 * per_half;
        ++i;
      } while (i < m && (x[i] < ends[k + 1] || k + 1 == pieces.size()));
      wide_polynomial(pieces[k].data(), n, result + first, result + first, i - first);
    }
  }

  PiecewisePolynomial::Value PiecewisePolynomial::at(const double x) const
  {
    const unsigned int k = find(x);
    const Piece &piece = pieces[k];
    const double per_half = 2 / (ends[k + 1] - ends[k]);
    const double y = (2 * x - ends[k] - ends[k + 1]) / (ends[k + 1] - ends[k]);
    double value = piece[n - 1], first_derivative = 0, second = 0;
    for (unsigned int j = n - 1; j-- > 0;)
    {
      second = second * y + first_derivative;
      first_derivative = first_derivative * y + value;
      value = value * y + piece[j];
    }
    return {value, first_derivative * per_half, 2 * second * per_half * per_half};
  }
} // namespace vibrocontact

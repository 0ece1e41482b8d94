#include <vibrocontact/numerics/chebyshev_fit.h>
#include <vibrocontact/numerics/piecewise_polynomial.h>
#include <vibrocontact/numerics/polynomial.h>
#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/numerics/zero_crossing.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int n = PiecewisePolynomial::n_coefficients;
  } // namespace

  PiecewisePolynomial::PiecewisePolynomial(const std::function<double(double)> &f, const double begin,
                                           const double end, const double length,
                                           const std::vector<double> &breaks)
  {
    double scale = 0, from = begin;
    const auto append = [&](const double to)
    {
      const unsigned int n_first = std::max(1., std::ceil((to - from) / length));
      for (unsigned int k = 0; k < n_first; ++k)
        approximate(f, from + (to - from) * k / n_first,
                    k + 1 == n_first ? to : from + (to - from) * (k + 1) / n_first, 1e-6 * length, scale);
      from = to;
    };
    for (const double place : breaks)
      if (place > from && place < end)
        append(place);
    append(end);
    ends.push_back(end);
    index();
  }

  void PiecewisePolynomial::approximate(const std::function<double(double)> &f, const double begin,
                                        const double end, const double shortest, double &scale)
  {
    const ChebyshevFit fit(f, begin, end, scale);
    if (!fit.resolved() && end - begin > shortest)
    {
      approximate(f, begin, 0.5 * (begin + end), shortest, scale);
      approximate(f, 0.5 * (begin + end), end, shortest, scale);
      return;
    }
    ends.push_back(begin);
    pieces.push_back(fit.powers());
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

  PiecewisePolynomial PiecewisePolynomial::monotone(const std::vector<double> &x,
                                                    const std::vector<double> &y)
  {
    const std::size_t m = x.size();
    std::vector<double> h(m - 1), secant(m - 1), slope(m, 0.);
    for (std::size_t k = 0; k + 1 < m; ++k)
    {
      h[k] = x[k + 1] - x[k];
      secant[k] = (y[k + 1] - y[k]) / h[k];
    }
    for (std::size_t k = 1; k + 1 < m; ++k)
      if (secant[k - 1] * secant[k] > 0)
      {
        const double left = 2 * h[k] + h[k - 1], right = h[k] + 2 * h[k - 1];
        slope[k] = (left + right) / (left / secant[k - 1] + right / secant[k]);
      }
    // at an end by three points, not beyond what keeps the first interval monotone
    const auto at_end = [](const double h0, const double h1, const double s0, const double s1)
    {
      const double value = ((2 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
      if (value * s0 <= 0)
        return 0.;
      return s0 * s1 < 0 && std::abs(value) > 3 * std::abs(s0) ? 3 * s0 : value;
    };
    slope[0] = m > 2 ? at_end(h[0], h[1], secant[0], secant[1]) : secant[0];
    slope[m - 1] = m > 2 ? at_end(h[m - 2], h[m - 3], secant[m - 2], secant[m - 3]) : secant[0];
    PiecewisePolynomial result;
    result.ends = x;
    for (std::size_t k = 0; k + 1 < m; ++k)
    {
      // Hermite's cubic in eta from -1 to 1
      const double mean = 0.5 * (y[k] + y[k + 1]), rise = 0.5 * (y[k + 1] - y[k]), a = 0.5 * h[k] * slope[k],
                   b = 0.5 * h[k] * slope[k + 1];
      result.pieces.push_back(Piece{
          {mean - 0.25 * (b - a), 1.5 * rise - 0.25 * (a + b), 0.25 * (b - a), 0.25 * (a + b) - 0.5 * rise}});
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
    const std::size_t interval = place <= 0 ? 0 : std::min<std::size_t>(place, first.size() - 1);
    // among the pieces that begin in the interval, of which uneven points make many
    const std::size_t last = first[std::min(interval + 1, first.size() - 1)];
    unsigned int k =
        std::upper_bound(ends.begin() + first[interval] + 1, ends.begin() + last + 1, x) - ends.begin() - 1;
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
      } while (i < m && (x[i] >= ends[k] || k == 0) && (x[i] < ends[k + 1] || k + 1 == pieces.size()));
      wide_polynomial(pieces[k].data(), n, result + first, result + first, i - first);
    }
  }

  PiecewisePolynomial::Value PiecewisePolynomial::at(const double x) const
  {
    return of_piece(find(x), x);
  }

  PiecewisePolynomial::Value PiecewisePolynomial::before(const double x) const
  {
    const unsigned int k = find(x);
    return of_piece(k > 0 && x <= ends[k] + join_rounding() ? k - 1 : k, x);
  }

  PiecewisePolynomial::Value PiecewisePolynomial::after(const double x) const
  {
    const unsigned int k = find(x);
    return of_piece(k + 1 < pieces.size() && x >= ends[k + 1] - join_rounding() ? k + 1 : k, x);
  }

  double PiecewisePolynomial::join_rounding() const
  {
    return 1e-14 * std::max(std::abs(ends.front()), std::abs(ends.back()));
  }

  double PiecewisePolynomial::first_reach(const double value) const
  {
    const auto end_value = [&](const std::size_t k) { return polynomial(pieces[k].data(), n, 1.); };
    std::size_t low = 0, high = pieces.size();
    while (low < high)
    {
      const std::size_t middle = (low + high) / 2;
      if (end_value(middle) < value)
        low = middle + 1;
      else
        high = middle;
    }
    if (low == pieces.size())
      return std::numeric_limits<double>::infinity();
    const auto left_over = [&](const double y)
    { return polynomial(pieces[low].data(), n, 2 * y - 1) - value; };
    const double place = left_over(0) >= 0 ? 0. : root_between(left_over, 0., 1.);
    return ends[low] + place * (ends[low + 1] - ends[low]);
  }

  PiecewisePolynomial::Value PiecewisePolynomial::of_piece(const unsigned int k, const double x) const
  {
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

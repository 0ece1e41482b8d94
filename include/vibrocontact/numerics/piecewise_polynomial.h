#pragma once

#include <array>
#include <functional>
#include <vector>

namespace vibrocontact
{
  /// A function of one variable as polynomials on intervals, for fast values and derivatives of what is slow to
  /// evaluate (expressions, sums of hundreds of waves) or known at points only.
  class PiecewisePolynomial
  {
  public:
    static constexpr unsigned int n_coefficients = 16;

    struct Value
    {
      double value, first, second;
    };

    PiecewisePolynomial() = default;
    /// Interpolates f in Chebyshev points on intervals that are halved until the last coefficients are rounding
    /// (numerics/chebyshev_fit.h), or the interval is 1e-6 of `length`, as where f is singular.
    /// @param length of the first intervals; @param breaks ascending, where intervals have to end (find_breaks())
    PiecewisePolynomial(const std::function<double(double)> &f, double begin, double end, double length,
                        const std::vector<double> &breaks = {});
    /// Natural cubic spline through points, x ascending: two continuous derivatives.
    static PiecewisePolynomial spline(const std::vector<double> &x, const std::vector<double> &y);
    /// Cubics through points that are monotone wherever the points are, with one continuous derivative: at each point the
    /// weighted harmonic mean of the slopes beside it, zero at a turn (Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5
    /// (1984) 300).
    static PiecewisePolynomial monotone(const std::vector<double> &x, const std::vector<double> &y);
    /// Straight lines between points.
    static PiecewisePolynomial lines(const std::vector<double> &x, const std::vector<double> &y);

    /// Integral from the beginning.
    PiecewisePolynomial integral() const;

    double value(double x) const;
    /// at m places, fast where neighbours lie on one piece
    void values(const double *x, std::size_t m, double *result) const;
    Value at(double x) const;
    /// At the end of one piece and the beginning of the next, of the one or the other; x may be off it by rounding.
    Value before(double x) const;
    Value after(double x) const;
    /// First x with this value, of a function that does not fall; infinite if there is none.
    double first_reach(double value) const;
    double begin() const { return ends.front(); }
    double end() const { return ends.back(); }
    bool empty() const { return pieces.empty(); }

  private:
    using Piece = std::array<double, n_coefficients>;

    void approximate(const std::function<double(double)> &f, double begin, double end, double shortest,
                     double &scale);
    void index();
    unsigned int find(double x) const;
    Value of_piece(unsigned int k, double x) const;
    double join_rounding() const;

    /// piece k is sum_j pieces[k][j] y^j, y from -1 to 1 between ends[k] and ends[k + 1]
    std::vector<double> ends;
    std::vector<Piece> pieces;
    /// first piece of each of equal intervals
    std::vector<unsigned int> first;
    double per_length = 0;
  };
} // namespace vibrocontact

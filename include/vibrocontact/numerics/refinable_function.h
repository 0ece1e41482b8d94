#pragma once

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// A function made of copies of itself at half the scale, phi(x) = sum_i p_i phi(2 x - i), sum p_i = 2, int phi = 1,
  /// zero outside [0, support], support = L - 1 for L coefficients (Daubechies, Ten Lectures on Wavelets, 1992; Beylkin,
  /// SIAM J. Numer. Anal. 29, 1992, 1716-1740, for the integrals between two of them).
  ///
  /// Its symbol has the factor ((1 + z)/2)^order: phi reproduces polynomials below that degree. One factor less,
  ///
  ///   phi'(x) = psi(x) - psi(x - 1),   sum psi_i z^i = 2 / (1 + z) sum p_i z^i,
  ///
  /// gives the derivative, psi again being such a function with sum psi(k) = 1. So derivatives are differences of a
  /// function whose values at the integers are the eigenvector of [psi_{2i-j}] for eigenvalue 1 and whose values between
  /// follow digit by digit, v(x) = T_b1 T_b2 ... v(0), v_i(x) = psi(x + i), x = 0.b1b2... in binary, (T_b)_ij =
  /// psi_{2i+b-j}: stable, and for every number that a computer has.
  class RefinableFunction
  {
  public:
    /// more digits than the results have: what is built from them loses some
    using Mask = std::vector<long double>;

    /// @param mask p_0 .. p_{L-1}; @param order factors (1 + z)/2 of its symbol, at least 1
    RefinableFunction(Mask mask, unsigned int order);

    unsigned int support() const { return mask.size() - 1; }
    const Mask &coefficients() const { return mask; }
    unsigned int order() const { return n_factors; }

    /// Sobolev exponent: derivatives of an order below it are square-integrable (1/2 for Haar, 7/2 for cubic splines, 1.415
    /// for six Daubechies coefficients). order - log4 of the spectral radius of the transfer operator of what is left
    /// of the symbol (Eirola, SIAM J. Math. Anal. 23, 1992, 1015-1030).
    double smoothness() const;

    /// Whether the d-th derivative has point values, d <= 3: it is continuous, or piecewise constant (then from the right).
    bool has_values(unsigned int d) const { return d < derivatives.size(); }
    /// phi^(d)(x + i), i = 0 .. support - 1, for x in [0, 1); only if has_values(d).
    std::vector<double> values(double x, unsigned int d) const;

    /// int phi(x) e^(-j omega x) dx, the product of the symbol at omega/2, omega/4, ...
    std::complex<double> fourier_transform(double omega) const;

  private:
    /// psi of the d-th derivative: mask and values at 0 .. size of mask - 2
    struct Derivative
    {
      std::vector<double> mask, integers;
    };
    Mask mask;
    unsigned int n_factors;
    /// sum i p_i / 2, the mean of phi
    double mean;
    std::vector<Derivative> derivatives;
  };

  /// B-spline of this order (4: cubic, 1: Haar) on the knots 0, 1, .., order.
  RefinableFunction b_spline(unsigned int order);
  /// Orthogonal with n_coefficients / 2 vanishing moments, from Boost.Math's filters. @param n_coefficients 4, 6, .. 38
  /// @throws InputError if there is no such filter
  RefinableFunction daubechies(unsigned int n_coefficients);

  /// int chi(x) phi^(d)(x - k) dx for k = first, first + 1, ...; zero for all others.
  struct ConnectionCoefficients
  {
    int first = 0;
    std::vector<double> values;
    double operator()(int k) const;
  };

  /// The integrals of Beylkin's recursion between two functions, exactly: the correlation x -> int chi(y) phi(y + x) dy is
  /// refinable itself, its mask half the convolution of that of phi with that of chi reversed, and they are its d-th
  /// derivative at the integers. sum_k k^i G_k = d! for i = d and 0 for i < d. Where derivatives stand makes only a sign.
  /// @throws InputError if the recursion does not determine them (four Daubechies coefficients by themselves, d = 2)
  ConnectionCoefficients connection_coefficients(const RefinableFunction &phi, const RefinableFunction &chi,
                                                 unsigned int d);
} // namespace vibrocontact

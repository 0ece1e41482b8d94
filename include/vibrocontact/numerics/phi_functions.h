#pragma once

#include <complex>

namespace vibrocontact
{
  /// phi_0(x) = e^x,  phi_n(x) = (phi_(n-1)(x) - 1/(n-1)!) / x = sum_k x^k / (k + n)!
  ///
  /// They are the exact integrals of an exponential times a polynomial force in a step h, with x = lambda h:
  ///
  ///   int_0^h e^(lambda (h - s)) (s/h)^n ds = h n! phi_(n+1)(x)
  ///
  /// Small |x| by the series, since the quotients lose all digits there. Accurate to rounding for Re x <= 0;
  /// nothing grows there (Higham, Functions of Matrices, 2008, section 10.7.4).
  std::complex<double> phi(unsigned int n, std::complex<double> x);
} // namespace vibrocontact

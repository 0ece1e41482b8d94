#pragma once

#include <vibrocontact/base/dense.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// All modes of a small system, K x = w^2 M x, x^T M x = 1.
  struct DenseModes
  {
    /// w^2 [1/s^2], 0 of coordinates without any stiffness to the last digit; as many as coordinates
    std::vector<double> squares;
    /// square, one after the other [1/sqrt(kg)]
    DenseMatrix shapes;
  };

  /// Coordinates that nothing couples do not mix, so that equal frequencies of two planes keep theirs. Coordinates without stiffness
  /// move freely, and the others relative to them: with f free, c the others,
  ///
  ///   x_f = -M_ff^-1 M_fc x_c,     K_cc x_c = w^2 (M_cc - M_cf M_ff^-1 M_fc) x_c
  ///
  /// @param what the system is, for the message @throws ConvergenceError if M is not positive definite
  DenseModes dense_modes(const DenseMatrix &stiffness, const DenseMatrix &mass, const std::string &what);

  /// A system between its first coordinates alone and modes with these held (Craig & Bampton, AIAA J. 6, 1968): x = T (x_b, q),
  ///
  ///   T = [ 1               0   ]
  ///       [ -K_ii^-1 K_ib   Phi ]
  ///
  /// with the modes Phi up to an angular frequency; n x (n_interface + modes).
  DenseMatrix fixed_interface_basis(const DenseMatrix &stiffness, const DenseMatrix &mass,
                                    unsigned int n_interface, double highest_omega, const std::string &what);

  /// T^T A T
  DenseMatrix projected(const DenseMatrix &A, const DenseMatrix &T);
} // namespace vibrocontact

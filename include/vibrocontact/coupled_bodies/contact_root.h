#pragma once

#include <vibrocontact/coupled_bodies/contact_receptance.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// A root of F(s) x = 0.
  struct ContactRoot
  {
    /// [1/s]
    std::complex<double> s;
    /// forces (N, z), largest component 1
    std::vector<std::complex<double>> x;
    /// left vector, y^T F = 0 with y^T F'(s) x = 1, if it was asked for: with any parameter p of F
    ///
    ///   ds/dp = - y^T (dF/dp) x
    std::vector<std::complex<double>> y;
    /// |F x| / (|F| |x|) with rows and columns of F scaled to 1 [-]
    double residual = 0;
    unsigned int iterations = 0;
  };

  /// Newton's iteration of the nonlinear eigenproblem, bordered by a fixed combination of the unknowns,
  ///
  ///   [ F(s)   F'(s) x ] [ dx ]     [ F(s) x ]
  ///   [ c^H    0       ] [ ds ] = - [ 0      ],      c^H x = 1,
  ///
  /// of second order at a simple root. The matrix is made anew while steps do not fall by ten at a stroke; near a root one is
  /// enough, and F(s) x needs no F. Rows and columns are scaled by the F of the start.
  /// @param x near that of the root, or empty: the start is the direction in which F(start) is nearest to singular, by inverse
  /// iteration from there
  /// @throws ConvergenceError if s does not settle to 1e-12 of its size in 30 iterations
  ContactRoot contact_root(const ContactReceptance &F, const std::complex<double> &start,
                           std::vector<std::complex<double>> x = {}, bool with_left_vector = false);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/coupled_bodies/rolling_equilibrium.h>

#include <vector>

namespace vibrocontact
{
  /// A direction along the contact plane at a point: (x, y), a unit vector.
  struct ContactDirection
  {
    unsigned int point;
    double x, y;
  };

  /// What friction does to small changes at the closed points of an equilibrium (Lai et al. 2018, Eqs 15-18;
  /// doc/theory.md, "Steady sliding and its stability"):
  ///
  ///   R = E N + E_z z,     sliding point:  T = -mu N t + z b - N (dmu/ds) ds_t t,   z = -ds_b / mobility
  ///                        sticking point: z are the two components of T, ds = 0
  ///
  /// t = s/|s| is the slip direction of each point, b across it. The last term of T stands if friction
  /// depends on the slip speed.
  struct SlidingFrame
  {
    /// points in compression, ascending; c of them
    std::vector<unsigned int> points;
    /// E: e_n - mu t of each of them, 3 n x c
    DenseMatrix normal;
    /// of z: directions b of sliding points, x and y of sticking ones
    std::vector<ContactDirection> across;
    /// |s| / (mu N) of each of them, 0 where the point sticks [m/(s N)]
    std::vector<double> mobility;
    /// slip directions t of the points whose friction depends on the speed, and N dmu/d|s| there [N s/m]
    std::vector<ContactDirection> along;
    std::vector<double> falling;
    unsigned int n_stick = 0;

    /// Drops the directions of sliding points, whose damping then is left out.
    void keep_sticking_only();
  };

  SlidingFrame sliding_frame(const RollingEquilibrium &equilibrium);

  /// E_z: unit forces in directions, 3 n x directions.
  DenseMatrix forces_along(const std::vector<ContactDirection> &directions, unsigned int n);
  /// direction . (row_x, row_y) of a matrix of 3 n rows.
  DenseMatrix rows_along(const DenseMatrix &matrix, const std::vector<ContactDirection> &directions,
                         unsigned int n);
} // namespace vibrocontact

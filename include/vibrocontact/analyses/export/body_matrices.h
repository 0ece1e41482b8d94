#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/bodies/reduced_body.h>

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A reduced body as matrices: M q'' + C q' + (K + i H) q = T^T f, u = T q at its contact points.
  ///
  /// The coordinates are its modes, M = 1 [kg], K = w^2, C = 2 zeta w, and behind them one without mass for each root l of
  /// its residual flexibility W~ = sum of l x x^T, of stiffness 1: T = [Psi, sqrt(l) x]. So T K^-1 T^T is its whole
  /// compliance, also where W~ is singular, and nothing is inverted.
  struct BodyMatrices
  {
    std::string name;
    unsigned int n_modes = 0, n_rigid_modes = 0;
    /// n square, n = n_modes + rank of W~; one of the last two is empty: H if the loss couples modes, C otherwise
    DenseMatrix mass, stiffness, damping, structural_damping;
    /// T, 3 n_points x n; rows as contact_row(): z of all points, then x, then y
    DenseMatrix recovery;
    /// motions of the coordinates where the whole body moves by one along x, y, z; n x 3
    DenseMatrix translations;
    /// W~ [m/N]
    DenseMatrix residual;
    /// contact points; [m], contact frame
    std::vector<dealii::Point<3>> points;
    /// of the modes [rad/s], [-], names
    std::vector<double> omega, damping_ratio;
    std::vector<std::string> labels;
  };

  /// @pre no poles, no load, no relaxation: nothing of these is in the matrices
  BodyMatrices body_matrices(const ReducedBody &body);

  /// x' = A x + B f, u = C x + D f of the same body: x = [q; q'] of its modes, D = W~, f and u at the contact points by the
  /// rows of T. A loss that couples modes has no real form: its diagonal alone is taken.
  struct StateSpace
  {
    DenseMatrix A, B, C, D;
  };
  StateSpace state_space(const BodyMatrices &body);

  /// The files of Type = matrices in a folder of their own: Matrix Market, dofs.csv, groups.csv, and body.prm, the section that
  /// reads them. On one rank. @throws OutputError
  void write_matrices(const BodyMatrices &body, const std::string &folder);
  /// The same and the state space as HDF5 (doc/matrices.md). On one rank. @throws OutputError
  void write_matrices_hdf5(const BodyMatrices &body, const std::string &file);
  void write_state_space(const BodyMatrices &body, const std::string &file);
} // namespace vibrocontact

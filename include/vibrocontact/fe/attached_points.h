#pragma once

#include <vibrocontact/fe/elastic_body.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/petsc_sparse_matrix.h>

#include <vector>

namespace vibrocontact
{
  /// A rigid mass of a body (PointMass) as its matrices see it. It follows the mean motion of its part of the boundary: the
  /// translation t of its centroid c and rotation theta that fit the displacement best,
  ///
  ///   int |u - t - theta x (x - c)|^2 dA = min,    q = (t, theta) = T u,
  ///
  /// so that a rigid motion is followed exactly and the part stays as soft as it is. Every point of the mass moves by
  /// t + theta x a, a its way from c. Sums over its points are matrices in q, and T^T (.) T those of the body:
  ///
  ///   mass        sum m A^T A,      A = [1, -a x]
  ///   load        sum A^T f,        f = m (g + Omega^2 r)
  ///   stiffening  of a body under the stress of its loads: less sum m Omega^2 A^T (1 - e e^T) A, and how f turns:
  ///               the second-order motion theta x (theta x a) / 2 of its points, with theta of second order too
  ///   coriolis    sum m A^T (e x) A
  ///
  /// Where the part is rigid (hold_rigid_groups()), T is that of the six dofs which are left.
  struct AttachedPoint
  {
    /// unconstrained ones with T, 6 x dofs [-, 1/m]; on all ranks
    std::vector<dealii::types::global_dof_index> dofs;
    dealii::FullMatrix<double> motion;
    /// centroid of its part of the boundary [m]
    dealii::Point<3> centroid;
    /// 6 square
    dealii::FullMatrix<double> mass, stiffening, coriolis;
    std::array<double, 6> load;
  };

  /// Of all masses of a body. Collective.
  std::vector<AttachedPoint> attached_points(const ElasticBody<3> &body);

  /// Makes the parts of the boundary rigid whose mass is rigid with them: their dofs follow six of their own exactly, by lines
  /// of the body's constraints. Behind all other constraints. Collective.
  /// @throws InputError for a part some of whose nodes are held, glued or rigid already
  void hold_rigid_groups(ElasticBody<3> &body);

  /// The same, and what else is in the way of the masses of a body is refused. Collective.
  void attach_masses(ElasticBody<3> &body);

  /// Places of the masses in a matrix: all dofs of a mass couple.
  void add_places(const std::vector<AttachedPoint> &points, const dealii::IndexSet &locally_owned,
                  dealii::DynamicSparsityPattern &pattern);

  /// Adds T^T (6 x 6) T of one of their matrices. Before compress().
  void add_masses(const std::vector<AttachedPoint> &points,
                  dealii::FullMatrix<double> AttachedPoint::*const part,
                  dealii::PETScWrappers::MPI::SparseMatrix &matrix);
  void add_loads(const std::vector<AttachedPoint> &points, dealii::PETScWrappers::MPI::Vector &load);
} // namespace vibrocontact

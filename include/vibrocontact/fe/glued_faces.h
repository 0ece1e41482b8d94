#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Two parts of a body's boundary that are glued, and what they are called.
  struct GluedBoundaries
  {
    dealii::types::boundary_id follower, leader;
    std::string follower_name, leader_name;
  };

  /// Glues boundaries whose meshes do not match, by dual mortar elements: the displacement u_s of the follower equals the leader's
  /// u_m in the mean over the follower's shape functions,
  /// \f[ \int \psi_i (u_s - u_m)\, dA = 0, \quad \int \psi_i \varphi_j\, dA = \delta_{ij} \int \varphi_j\, dA, \quad
  ///     u_s = D^{-1} M u_m, \f]
  /// which enters the constraints as hanging nodes do: M, K and loads stay symmetric and definite and have no new unknowns.
  /// Wohlmuth, A mortar finite element method using dual spaces for the Lagrange multiplier, SIAM J. Numer. Anal. 38 (2000).
  ///
  /// The dual functions psi_i make D diagonal, so that a node follows the leader's nodes in its own neighbourhood alone. Standard
  /// functions would need a solution with D, whose inverse is full: each node would follow the whole group, and the stiffness would
  /// hold a full block of the group's size.
  ///
  /// On quadratic triangles corner functions have the mean zero, D would be singular. There the dual functions are those of the
  /// transformed ones phi_c + alpha sum phi_e (corners, alpha = 1/5) and (1 - 2 alpha) phi_e (edges): Popp, Wohlmuth, Gee & Wall,
  /// Dual quadratic mortar finite element methods for 3D finite deformation contact, SIAM J. Sci. Comput. 34 (2012).
  ///
  /// Linear displacements pass exactly, and since the psi_i of a face sum to one, so does a constant stress. Where a node of the
  /// follower is bound already - held, hanging, or glued before - its psi_i is given to its free neighbours, so that the sum stays.
  ///
  /// Where faces are facets of a curved surface, follower and leader lie a little apart, and a rotation would strain them: each node
  /// that is off the mean of its leaders by r then follows their rotation too, u_s = D^{-1} M u_m + omega x r, with the
  /// omega that fits their displacements by least squares. A rigid motion leaves no stress on any surface.
  ///
  /// @param entry where it stands, for messages and the log
  /// @param locally_relevant, constraints of the body; every rank gets the dofs and the lines of all glued faces
  /// @throws InputError for faces of a follower that are off the leader or beside it, and for a separate patch of the leader
  ///   on which nothing lies - with their number and the place of the first. Collective.
  void glue_faces(const dealii::DoFHandler<3> &dof_handler, const dealii::Mapping<3> &mapping,
                  const std::vector<GluedBoundaries> &pairs, const std::string &entry,
                  dealii::IndexSet &locally_relevant, dealii::AffineConstraints<double> &constraints);
} // namespace vibrocontact

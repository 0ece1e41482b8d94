#pragma once

#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/matrices/stored_matrix.h>
#include <vibrocontact/scene/matrix_nodes.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Looks at the diagonal of a lower triangle, before anything is factorised.
  /// @param file for messages
  /// @param dofs each of which has to have a positive entry (a stiffness of displacements); empty: 0 is allowed
  /// @throws InputError for a negative entry, or one of 0 beside others in its row: no semi-definite matrix has those
  void check_diagonals(const std::vector<StoredEntry> &triangle, const std::string &file, unsigned int n,
                       const std::vector<MatrixDof> &dofs);

  /// By one factorisation of A + 1e-10 diag(A): how many roots are negative (Sylvester's law of inertia). A diagonal matrix
  /// needs none. Collective. @param what stiffness or mass
  /// @throws InputError if there is a negative root
  void check_semidefinite(const dealii::PETScWrappers::MPI::SparseMatrix &matrix,
                          const SecondOrderSystem &system, const std::string &file, const std::string &what);
} // namespace vibrocontact

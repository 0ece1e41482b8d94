#pragma once

#include <vibrocontact/base/dense.h>

#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>

#include <vector>

namespace vibrocontact
{
  /// V^T A V of a symmetric matrix, replicated. Collective.
  DenseMatrix projected_matrix(const dealii::PETScWrappers::MPI::SparseMatrix &A,
                               const std::vector<dealii::PETScWrappers::MPI::Vector> &V);
  /// The same of an antisymmetric matrix. Collective.
  DenseMatrix projected_antisymmetric_matrix(const dealii::PETScWrappers::MPI::SparseMatrix &A,
                                             const std::vector<dealii::PETScWrappers::MPI::Vector> &V);
} // namespace vibrocontact

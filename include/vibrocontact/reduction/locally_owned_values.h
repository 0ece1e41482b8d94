#pragma once

#include <deal.II/lac/petsc_vector.h>

#include <vector>

namespace vibrocontact
{
  /// The rows of a distributed vector that this rank has.
  std::vector<double> locally_owned_values(const dealii::PETScWrappers::MPI::Vector &vector);

  /// Those of n vectors from `first` on, one column after the other.
  std::vector<double> locally_owned_values(const std::vector<dealii::PETScWrappers::MPI::Vector> &vectors,
                                           unsigned int first, unsigned int n);

  /// vector <- values of these rows
  void set_locally_owned_values(const double *values, dealii::PETScWrappers::MPI::Vector &vector);
} // namespace vibrocontact

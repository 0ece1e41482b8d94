#pragma once

#include <vibrocontact/fe/second_order_system.h>

#include <vector>

namespace vibrocontact
{
  /// dofs up to which unreduced finite elements go to LAPACK (some 20 s on one core)
  constexpr unsigned int most_dense_dofs = 1500;

  /// The matrices of a small body without its held and hanging dofs, which are coupled to none. Replicated.
  struct DenseSystem
  {
    /// place of each dof of the system among the N that move, invalid_unsigned_int for the others
    std::vector<unsigned int> place;
    /// [kg], [N/m]; N square
    DenseMatrix mass, stiffness;

    unsigned int n_dofs() const { return mass.m(); }
  };

  /// N: dofs that move, those without mass (a massless contact node) included. Collective.
  unsigned int n_moving_dofs(const SecondOrderSystem &system);

  /// Collective.
  DenseSystem dense_system(const SecondOrderSystem &system);

  /// Vectors of the system by the dofs that move, one column each; N x vectors.size(). Collective.
  DenseMatrix dense_vectors(const SecondOrderSystem &system, const DenseSystem &dense,
                            const std::vector<dealii::PETScWrappers::MPI::Vector> &vectors);
} // namespace vibrocontact

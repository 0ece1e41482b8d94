#pragma once

#include <vibrocontact/fe/contact_trace.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>

#include <string>

namespace vibrocontact
{
  /// A body after assembly: M U'' + (1 + i eta) K U = F + P_c^T R, without dimension, mesh or element from here on.
  ///
  /// Hanging nodes are condensed and held dofs eliminated: a constrained row keeps its diagonal entry in the
  /// stiffness and has zero mass, so it shows as an infinite eigenvalue and never as a spurious mode.
  struct SecondOrderSystem
  {
    std::string body;
    MPI_Comm communicator = MPI_COMM_NULL;
    dealii::IndexSet locally_owned;
    /// M [kg], K [N/m]: symmetric, same sparsity
    dealii::PETScWrappers::MPI::SparseMatrix mass, stiffness;
    /// imaginary part of the hysteretic stiffness, sum of eta_e K_e over cells and pads [N/m]; empty if lossless
    dealii::PETScWrappers::MPI::SparseMatrix loss_stiffness;
    bool has_loss = false;
    /// loads on the body (Eq. 6: gravity, surface traction) [N]; empty if there are none
    dealii::PETScWrappers::MPI::Vector load;
    bool has_load = false;
    /// mass of the body from its volume and density [kg]
    double total_mass = 0;
    /// translations and rotations that cost no energy: 0 for a held body or one on springs, 6 for a free solid
    unsigned int n_rigid_modes = 0;
    /// orthonormal (not mass-orthonormal) basis of those motions, n_rigid_modes vectors
    std::vector<dealii::PETScWrappers::MPI::Vector> rigid_motions;
    ContactTrace trace;
    /// hash of everything that determines the matrices and the trace (mesh, material, boundary, grid); cache key
    std::string key;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/fe/contact_trace.h>
#include <vibrocontact/fe/surface_trace.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct MaterialFlow;

  /// A body after assembly: M U'' + (1 + i eta) K U = F + P_c^T R, without dimension, mesh or element from
  /// here on.
  ///
  /// Hanging nodes are condensed and held dofs eliminated: a constrained row keeps its diagonal entry in the
  /// stiffness and has zero mass, so it shows as an infinite eigenvalue and never as a spurious mode.
  struct SecondOrderSystem
  {
    std::string body;
    MPI_Comm communicator = MPI_COMM_NULL;
    dealii::IndexSet locally_owned;
    /// M [kg], K [N/m]: symmetric; M has no place that K does not have, of a solid a third of them
    dealii::PETScWrappers::MPI::SparseMatrix mass, stiffness;
    /// imaginary part of the hysteretic stiffness, sum of eta_e K_e over cells and pads [N/m]; empty if
    /// lossless
    dealii::PETScWrappers::MPI::SparseMatrix loss_stiffness;
    bool has_loss = false;
    /// viscous damping C [N s/m]: symmetric, no place that K does not have; empty if there is none. Its part along each mode
    /// becomes a damping ratio, see modal_damping()
    dealii::PETScWrappers::MPI::SparseMatrix damping;
    bool has_damping = false;
    /// loads on the body (Eq. 6: gravity, surface traction) [N]; empty if there are none
    dealii::PETScWrappers::MPI::Vector load;
    bool has_load = false;
    /// mass of the body from its volume and density [kg]
    double total_mass = 0;
    /// motion where the whole body moves by one along x, y, z, of coordinates that are no displacements (a body that was
    /// reduced before); empty: by the direction of each dof
    std::vector<dealii::PETScWrappers::MPI::Vector> translations;
    /// translations and rotations that cost no energy: 0 for a held body or one on springs, 6 for a free
    /// solid
    unsigned int n_rigid_modes = 0;
    /// orthonormal (not mass-orthonormal) basis of those motions, n_rigid_modes vectors
    std::vector<dealii::PETScWrappers::MPI::Vector> rigid_motions;
    /// place [m, contact frame] and direction (0 x, 1 y, 2 z; beams: 3 to 5 rotations about x, y, z, 6
    /// warping or a coordinate without place) of each locally owned dof, in their order: what labels and the orientation of pairs look at
    std::vector<dealii::Point<3>> dof_position;
    std::vector<unsigned char> dof_direction;
    /// a held boundary alone carries the body (no springs): it follows a displacement of that boundary
    /// rigidly
    bool follows_hub = false;
    ContactTrace trace;
    /// flexibility of the contact points that the elements do not have (a beam's crown): added to their
    /// static compliance, 3 n square [m/N]; empty for solids
    DenseMatrix local_compliance;
    SurfaceTrace surface;
    /// of a body that turns past places that stand still (fe/material_flow.h); null: it does not
    std::shared_ptr<const MaterialFlow> flow = nullptr;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/scene/body_mesh.h>
#include <vibrocontact/scene/elastic_model.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/petsc_vector.h>

namespace vibrocontact
{
  /// A meshed body with its displacement space: mesh, mapping, FE_Q(degree)^dim - FE_SimplexP of tetrahedra, FE_WedgeP of
  /// prisms, degree 1 or 2 -, hanging-node and held constraints.
  ///
  /// It lives as long as fields are written; the analyses only see the SecondOrderSystem that it assembles.
  ///
  ///   BodyMesh (block, wheel, rail, mesh file) + ElasticModel -> ElasticBody -> assemble_body() ->
  ///   SecondOrderSystem
  template <int dim>
  class ElasticBody
  {
  public:
    ElasticBody(BodyMesh<dim> &&mesh, const ElasticModel<dim> &model, const unsigned int degree = 2);

    /// Displacement with hanging and held values filled in, ghosted, from a vector of owned values.
    dealii::PETScWrappers::MPI::Vector complete(const dealii::PETScWrappers::MPI::Vector &owned) const;

    const BodyMesh<dim> mesh;
    const ElasticModel<dim> model;
    const dealii::FESystem<dim> element;
    /// points of the reference cell at which the nodes of the element lie, one per dof of a cell
    const std::vector<dealii::Point<dim>> node_points;

  private:
    const std::unique_ptr<const dealii::Mapping<dim>> own_mapping;

  public:
    const dealii::Mapping<dim> &mapping;
    dealii::DoFHandler<dim> dof_handler;
    dealii::IndexSet locally_owned, locally_relevant;
    dealii::AffineConstraints<double> constraints;

    MPI_Comm communicator() const { return mesh.triangulation->get_communicator(); }
  };

  /// Orthonormal basis of the rigid motions (3 in 2d, 6 in 3d) on the unconstrained dofs.
  template <int dim>
  std::vector<dealii::PETScWrappers::MPI::Vector> rigid_motions(const ElasticBody<dim> &body);

  /// Of these what the supports leave: all without supports, none on springs, some where boundaries are held in some directions
  /// alone (a half of a symmetric body). Orthonormal.
  template <int dim>
  std::vector<dealii::PETScWrappers::MPI::Vector> free_rigid_motions(const ElasticBody<dim> &body);
} // namespace vibrocontact

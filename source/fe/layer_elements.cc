#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/layer_elements.h>
#include <vibrocontact/scene/body.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// dof of component c at each node of the bottom, as far as this rank owns it
    ContactTrace nodal_trace(const SecondOrderSystem &system, const ContactGrid &grid)
    {
      const unsigned int n = grid.n_points();
      std::vector<unsigned long long> dofs(3 * n, 0); // number + 1; 0: none or of another rank
      unsigned int k = 0;
      for (const auto dof : system.locally_owned)
      {
        const dealii::Point<3> &p = system.dof_position[k];
        const unsigned int direction = system.dof_direction[k++];
        if (std::abs(p[2]) > 1e-9 * grid.spacing_x)
          continue;
        const long i = std::lround((p[0] - grid.x_first) / grid.spacing_x),
                   j = grid.n_y == 1 ? 0 : std::lround((p[1] - grid.y_first) / grid.spacing_y);
        dofs[contact_row(n, (direction + 1) % 3, grid.index(i, j))] = dof + 1;
      }
      dealii::Utilities::MPI::max(dofs, system.communicator, dofs);
      ContactTrace trace;
      trace.grid = grid;
      trace.rows.resize(3 * n);
      for (unsigned int row = 0; row < 3 * n; ++row)
        if (dofs[row] > 0)
          trace.rows[row] = {{static_cast<dealii::types::global_dof_index>(dofs[row] - 1), 1.}};
      trace.surface_height.assign(n, 0.);
      trace.faces_up = false;
      return trace;
    }

    template <int dim>
    std::unique_ptr<SecondOrderSystem> assemble(const LayerParameters &layer, const ElasticMaterial &material,
                                                const std::string &name, const MPI_Comm communicator)
    {
      BodyMesh<dim> mesh = make_block<dim>(layer.block(), name, communicator);
      ElasticModel<dim> model;
      model.material = material;
      model.held = {mesh.boundary_id("top")};
      return assemble_body(ElasticBody<dim>(std::move(mesh), model, layer.degree));
    }
  } // namespace

  std::unique_ptr<SecondOrderSystem> assemble_layer(const LayerParameters &layer,
                                                    const ElasticMaterial &material, const std::string &name,
                                                    const ContactGrid *const grid,
                                                    const MPI_Comm communicator)
  {
    auto system = layer.plane_strain() ? assemble<2>(layer, material, name, communicator)
                                       : assemble<3>(layer, material, name, communicator);
    if (grid)
      system->trace = nodal_trace(*system, *grid);
    return system;
  }

  std::unique_ptr<SecondOrderSystem> LayerParameters::assemble(const BodyParameters &body, bool,
                                                               const ContactGrid *const grid,
                                                               const MPI_Comm communicator) const
  {
    return assemble_layer(*this, body.material, body.name, grid, communicator);
  }
} // namespace vibrocontact

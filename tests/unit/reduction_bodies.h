#pragma once

// Small bodies for the tests of the reduction, with a contact made of single dofs of their top face.

#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/scene/block.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace reduction_test
{
  struct Body
  {
    std::unique_ptr<vibrocontact::ElasticBody<3>> elastic;
    std::unique_ptr<vibrocontact::SecondOrderSystem> system;
  };

  /// Contact points: the dofs of the top face nearest to the middle, one cell each; rows sum over two
  /// neighbouring nodes so that the trace is more than a list of dofs.
  inline void add_trace(vibrocontact::SecondOrderSystem &system, const unsigned int n_points)
  {
    using dealii::types::global_dof_index;
    // (distance key, dof) per direction, on all ranks
    std::vector<std::pair<double, global_dof_index>> local[3];
    for (unsigned int i = 0; i < system.dof_position.size(); ++i)
    {
      const auto &p = system.dof_position[i];
      if (std::abs(p[2]) < 1e-12)
        local[system.dof_direction[i]].emplace_back(std::hypot(p[0] - 1e-3, p[1] - 2e-3),
                                                    system.locally_owned.nth_index_in_set(i));
    }
    auto &trace = system.trace;
    trace.grid.n_x = n_points;
    trace.grid.n_y = 1;
    trace.grid.spacing_x = trace.grid.spacing_y = 1e-3;
    trace.rows.resize(3 * n_points);
    trace.surface_height.assign(n_points, 0.);
    for (unsigned int direction = 0; direction < 3; ++direction)
    {
      std::vector<std::pair<double, global_dof_index>> all;
      for (const auto &part : dealii::Utilities::MPI::all_gather(system.communicator, local[direction]))
        all.insert(all.end(), part.begin(), part.end());
      std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
      const unsigned int component = (direction + 1) % 3; // x, y, z -> 1, 2, 0
      for (unsigned int i = 0; i < n_points; ++i)
      {
        auto &row = trace.rows[vibrocontact::contact_row(n_points, component, i)];
        row = {{all.at(i).second, 0.75}, {all.at(i + 1).second, 0.25}};
        std::sort(row.begin(), row.end());
      }
    }
  }

  inline Body make_body(const vibrocontact::BlockParameters &parameters,
                        const vibrocontact::ElasticModel<3> &model, const MPI_Comm communicator,
                        const unsigned int n_points, const unsigned int degree = 2)
  {
    vibrocontact::BodyMesh<3> mesh = vibrocontact::make_block<3>(parameters, "block", communicator);
    vibrocontact::ElasticModel<3> held = model;
    for (const auto &name : parameters.held)
      held.held.push_back(mesh.boundary_id(name));
    Body body;
    body.elastic = std::make_unique<vibrocontact::ElasticBody<3>>(std::move(mesh), held, degree);
    body.system = assemble_body(*body.elastic);
    if (n_points > 0)
      add_trace(*body.system, n_points);
    return body;
  }
} // namespace reduction_test

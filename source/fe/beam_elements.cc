#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/beam_elements.h>
#include <vibrocontact/fe/beam_space.h>
#include <vibrocontact/scene/body.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace vibrocontact
{
  using namespace dealii;
  using namespace beam_field;

  namespace
  {
    /// Energies per length of rail at x, without the pads.
    std::vector<BeamEnergy> rail_stiffness(const BeamRailParameters &rail, const ElasticMaterial &material)
    {
      const double E = material.young_modulus, G = material.mu(),
                   e = rail.centroid_height - rail.shear_centre_height,
                   polar = rail.moment_y + rail.moment_z + rail.area * e * e;
      return {{E * rail.area, {}, {{U, 1.}}},
              {E * rail.moment_y, {}, {{ty, 1.}}},
              {E * rail.moment_z, {}, {{tz, 1.}}},
              {rail.shear_coefficient_z * G * rail.area, {{ty, 1.}}, {{W, 1.}}},
              {rail.shear_coefficient_y * G * rail.area, {{tz, -1.}}, {{V, 1.}}},
              {G * rail.torsion_constant, {}, {{tx, 1.}}},
              {G * (polar - rail.torsion_constant), {{p, -1.}}, {{tx, 1.}}},
              {E * rail.warping_constant, {}, {{p, 1.}}}};
    }

    std::vector<BeamEnergy> rail_mass(const BeamRailParameters &rail, const double density)
    {
      const double e = rail.centroid_height - rail.shear_centre_height;
      return {{density * rail.area, {{U, 1.}}, {}},
              {density * rail.area, {{V, 1.}, {tx, -e}}, {}},
              {density * rail.area, {{W, 1.}}, {}},
              {density * (rail.moment_y + rail.moment_z), {{tx, 1.}}, {}},
              {density * rail.moment_y, {{ty, 1.}}, {}},
              {density * rail.moment_z, {{tz, 1.}}, {}},
              {density * rail.warping_constant, {{p, 1.}}, {}}};
    }

    /// Energies of one whole pad.
    std::vector<BeamEnergy> pad_stiffness(const BeamRailParameters &rail)
    {
      const double spread = rail.foot_width * rail.foot_width / 12;
      return {{rail.pad_stiffness_x, {{U, 1.}, {ty, -rail.centroid_height}}, {}},
              {rail.pad_stiffness_x * spread, {{tz, 1.}}, {}},
              {rail.pad_stiffness_y, {{V, 1.}, {tx, rail.shear_centre_height}}, {}},
              {rail.pad_stiffness_z, {{W, 1.}}, {}},
              {rail.pad_stiffness_z * spread, {{tx, 1.}}, {}}};
    }

    /// Orthonormal basis of the six motions of a rail that nothing holds.
    std::vector<PETScWrappers::MPI::Vector> rigid_motions(const SecondOrderSystem &system, const double lever)
    {
      // value of a motion in a field at x
      const auto motion = [lever](const unsigned int m, const unsigned int field, const double x)
      {
        if (m < 3)
          return field == m ? 1. : 0.;
        if (field == m)
          return 1.;
        if (m == tx)
          return field == V ? lever : 0.; // about the centroid
        return m == ty ? (field == W ? -x : 0.) : (field == V ? x : 0.);
      };
      std::vector<PETScWrappers::MPI::Vector> motions;
      for (unsigned int m = 0; m < 6; ++m)
      {
        motions.emplace_back(system.locally_owned, system.communicator);
        for (unsigned int i = 0; i < system.dof_direction.size(); ++i)
          motions[m](system.locally_owned.nth_index_in_set(i)) =
              motion(m, system.dof_direction[i], system.dof_position[i][0]);
        motions[m].compress(VectorOperation::insert);
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (unsigned int k = 0; k < m; ++k)
            motions[m].add(-(motions[m] * motions[k]), motions[k]);
        motions[m] /= motions[m].l2_norm();
      }
      return motions;
    }

    ContactTrace beam_trace(const BeamRailParameters &rail, const BeamSpace &space, const std::string &name,
                            const ContactGrid &grid)
    {
      if (grid.traction != TractionShape::constant)
        throw InputError("Contact/Quadrature is consistent, but the half-space under the contact of " + name +
                         " knows tractions that are constant on each cell only: set it to lumped.");
      ContactTrace trace;
      trace.grid = grid;
      trace.rows.resize(3 * grid.n_points());
      auto under_contact = space.dof_handler.begin_active();
      while (under_contact->vertex(1)[0] < 1e-9)
        ++under_contact;
      const BeamPlace fields(space, under_contact, 0.);
      const double crown = rail.crown_height(rail.lateral_position);
      for (unsigned int i = 0; i < grid.n_points(); ++i)
      {
        const auto motion = crown_motion(rail, grid.x(i), grid.y(i));
        for (unsigned int c = 0; c < 3; ++c)
        {
          std::map<types::global_dof_index, double> row;
          fields.add(row, motion[c], 1.);
          trace.rows[contact_row(grid.n_points(), c, i)].assign(row.begin(), row.end());
        }
        const double y = rail.lateral_position + grid.y(i);
        if (rail.crown_radius > 0 && !(std::abs(y) < rail.crown_radius))
          throw InputError("The contact grid leaves the crown of " + name +
                           ": make Contact/Half width smaller or Crown radius larger.");
        trace.surface_height.push_back(rail.crown_height(y) - crown);
      }
      return trace;
    }
  } // namespace

  std::unique_ptr<SecondOrderSystem>
  assemble_beam_rail(const BeamRailParameters &rail, const ElasticMaterial &material, const std::string &name,
                     const ContactGrid *const grid, const MPI_Comm communicator)
  {
    const BeamSpace space(rail);
    const auto &dof_handler = space.dof_handler;
    auto system = std::make_unique<SecondOrderSystem>();
    system->body = name;
    system->communicator = communicator;
    system->locally_owned = Utilities::create_evenly_distributed_partitioning(
        Utilities::MPI::this_mpi_process(communicator), Utilities::MPI::n_mpi_processes(communicator),
        dof_handler.n_dofs());
    system->has_loss = material.loss_factor > 0 || !rail.anechoic_lengths.empty() ||
                       (rail.has_pads() && rail.pad_loss_factor > 0);
    DynamicSparsityPattern pattern(dof_handler.n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, pattern);
    std::vector<PETScWrappers::MPI::SparseMatrix *> matrices = {&system->mass, &system->stiffness};
    if (system->has_loss)
      matrices.push_back(&system->loss_stiffness);
    for (auto *const matrix : matrices)
      matrix->reinit(system->locally_owned, system->locally_owned, pattern, communicator);

    const auto elastic = rail_stiffness(rail, material), inert = rail_mass(rail, material.density),
               pads = pad_stiffness(rail);
    const QGauss<1> gauss(rail.degree + 1);
    FEValues<1> values(space.element, gauss, update_values | update_gradients | update_JxW_values);
    const unsigned int n = space.element.n_dofs_per_cell();
    FullMatrix<double> mass(n), stiffness(n), springs(n);
    std::vector<types::global_dof_index> dofs(n);
    const std::vector<double> supports = rail.supports();
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      mass = stiffness = springs = 0;
      const double middle = cell->center()[0], left = cell->vertex(0)[0], right = cell->vertex(1)[0];
      const bool on_pad =
          std::any_of(supports.begin(), supports.end(),
                      [&](const double support) { return std::abs(middle - support) < rail.pad_length / 2; });
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        add_energies(stiffness, elastic, values, q, values.JxW(q));
        add_energies(mass, inert, values, q, values.JxW(q));
        if (on_pad)
          add_energies(springs, pads, values, q, values.JxW(q) / rail.pad_length);
      }
      // a point on a node belongs to the cell to its left
      const bool is_first = left < -rail.length / 2 + 1e-9;
      for (const double support : supports)
        if (rail.pad_length == 0 && support > left + (is_first ? -1e-9 : 1e-9) && support < right + 1e-9)
        {
          FEValues<1> point(space.element, Quadrature<1>(Point<1>((support - left) / (right - left))),
                            update_values | update_gradients);
          point.reinit(cell);
          add_energies(springs, pads, point, 0, 1.);
        }
      const unsigned int piece = rail.anechoic_piece(middle);
      const double loss = piece > 0 ? rail.anechoic_loss(piece) : material.loss_factor;
      for (unsigned int a = 0; a < n; ++a)
        if (system->locally_owned.is_element(dofs[a]))
          for (unsigned int b = 0; b < n; ++b)
          {
            system->mass.add(dofs[a], dofs[b], mass(a, b));
            system->stiffness.add(dofs[a], dofs[b], stiffness(a, b) + springs(a, b));
            if (system->has_loss)
              system->loss_stiffness.add(dofs[a], dofs[b],
                                         loss * stiffness(a, b) + rail.pad_loss_factor * springs(a, b));
          }
    }
    for (auto *const matrix : matrices)
      matrix->compress(VectorOperation::add);

    system->total_mass = material.density * rail.area * rail.length;
    std::vector<Point<1>> places(dof_handler.n_dofs());
    DoFTools::map_dofs_to_support_points(MappingQ1<1>(), dof_handler, places);
    std::vector<unsigned char> field(dof_handler.n_dofs());
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned int k = 0; k < n; ++k)
        field[dofs[k]] = space.element.system_to_component_index(k).first;
    }
    const double axis = rail.centroid_height - rail.crown_height(rail.lateral_position);
    for (const auto dof : system->locally_owned)
    {
      system->dof_position.emplace_back(places[dof][0], -rail.lateral_position, axis);
      system->dof_direction.push_back(field[dof]);
    }
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      SurfaceTrace &line = system->surface;
      const int first = line.points.size();
      line.quads.push_back({{first, first + 1, first + 1, first}});
      for (unsigned int v = 0; v < 2; ++v)
      {
        line.points.emplace_back(cell->vertex(v)[0], -rail.lateral_position, axis);
        for (unsigned int d = 0; d < 3; ++d)
          line.rows.push_back({{cell->vertex_dof_index(v, d), 1.}});
      }
    }
    if (!rail.has_pads())
    {
      system->rigid_motions = rigid_motions(*system, rail.centroid_height - rail.shear_centre_height);
      system->n_rigid_modes = system->rigid_motions.size();
    }
    if (grid)
      system->trace = beam_trace(rail, space, name, *grid);
    return system;
  }

  std::vector<TraceRow> beam_rail_rows(const BeamRailParameters &rail, const std::string &name,
                                       const double x, const double y, const double length)
  {
    if (std::abs(x) + length / 2 > rail.length / 2 * (1 + 1e-9))
      throw InputError("The place x = " + std::to_string(x) + " m is not on the rail " + name +
                       ", which reaches from " + std::to_string(-rail.length / 2) + " to " +
                       std::to_string(rail.length / 2) + " m.");
    const BeamSpace space(rail);
    const QGauss<1> gauss(rail.degree + 1);
    std::vector<std::map<types::global_dof_index, double>> rows(3);
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      // the part of the piece on this cell; a piece without length belongs to one cell
      const double left = cell->vertex(0)[0], right = cell->vertex(1)[0];
      const double from = std::max(left, x - length / 2), to = std::min(right, x + length / 2);
      const bool is_point = length < 1e-9;
      if (is_point ? !(x >= left && (x < right || right >= rail.length / 2 * (1 - 1e-12))) : to <= from)
        continue;
      for (unsigned int q = 0; q < (is_point ? 1 : gauss.size()); ++q)
      {
        const double place = is_point ? x : from + gauss.point(q)[0] * (to - from),
                     weight = is_point ? 1. : gauss.weight(q) * (to - from) / length;
        const BeamPlace fields(space, cell, place);
        const auto motion = crown_motion(rail, 0., y);
        for (unsigned int c = 0; c < 3; ++c)
          fields.add(rows[c], motion[c], weight);
      }
    }
    std::vector<TraceRow> result;
    for (const auto &row : rows)
      result.emplace_back(row.begin(), row.end());
    return result;
  }

  std::unique_ptr<SecondOrderSystem> BeamRailParameters::assemble(const BodyParameters &body, bool,
                                                                  const ContactGrid *const grid,
                                                                  const MPI_Comm communicator) const
  {
    return assemble_beam_rail(*this, body.material, body.name, grid, communicator);
  }

  std::vector<TraceRow> BeamRailParameters::surface_rows(const std::string &name, const double x,
                                                         const double y, const double length) const
  {
    return beam_rail_rows(*this, name, x, y, length);
  }
} // namespace vibrocontact

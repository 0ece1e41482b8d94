#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/contact_refinement.h>
#include <vibrocontact/scene/mesh_quality.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  void ContactRefinement::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.add_parameter(
        "Contact cell size", cell_size,
        "Largest edge of the cells under the contact grid; quadratic cells of 2 mm carry a grid of 1 mm. "
        "Zero: the mesh is not refined. Units: m.",
        Double(0, 1));
    prm.add_parameter("Refinement margin", margin,
                      "How far the fine cells reach beyond the contact grid; at least one of them. Units: m.",
                      Double(0, 1));
    prm.add_parameter("Refinement depth", depth, "How far the fine cells reach below the surface. Units: m.",
                      Double(0, 1));
  }

  void ContactRefinement::add_entries(EntriesRead &entries, const std::string &section,
                                      const BodyUse &use) const
  {
    entries.add_if(use.contact, "the body is in contact", section, "Contact cell size");
    entries.add_if(use.contact && cell_size > 0, "the body is in contact and has a Contact cell size",
                   section, "Refinement margin, Refinement depth");
  }

  void ContactRefinement::check(const std::string &section) const
  {
    std::ostringstream text;
    if (cell_size > 0 && cell_size < 5e-5)
      text << section << "/Contact cell size is " << cell_size
           << " m: sizes below 5e-5 m need too many cells.";
    else if (cell_size > 0 && margin < 0.999 * cell_size)
      text << section << "/Refinement margin is " << margin << " m, less than one fine cell (" << cell_size
           << " m): hanging nodes would lie on the contact grid.";
    if (!text.str().empty())
      throw InputError(text.str());
  }

  template <int dim>
  void refine_at_contact(BodyMesh<dim> &mesh, const ContactGrid &grid, const ContactRefinement &parameters,
                         const unsigned int degree)
  {
    if (parameters.cell_size <= 0)
      return;
    auto &triangulation = *mesh.triangulation;
    Point<dim> low, high;
    low[0] = grid.x_first - grid.spacing_x / 2;
    high[0] = low[0] + grid.n_x * grid.spacing_x;
    if (dim == 3)
    {
      low[1] = grid.y_first - grid.spacing_y / 2;
      high[1] = low[1] + grid.n_y * grid.spacing_y;
    }

    const auto overlaps = [&](const auto &cell, const double margin, const double depth)
    {
      Point<dim> a = low, b = high;
      for (unsigned int d = 0; d < dim - 1; ++d)
      {
        a[d] -= margin;
        b[d] += margin;
      }
      a[dim - 1] = -depth;
      b[dim - 1] = depth;
      const auto bounds = cell->bounding_box().get_boundary_points();
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double slack = 1e-3 * (bounds.second[d] - bounds.first[d]);
        if (bounds.second[d] < a[d] + slack || bounds.first[d] > b[d] - slack)
          return false;
      }
      return true;
    };

    // Size of the coarse contact cells under the grid; the coarse mesh is the same on every rank.
    double size = 0;
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && mesh.contact_boundaries.count(cell->face(f)->boundary_id()) &&
            overlaps(cell, 0., 1e-2 * cell->diameter()))
          for (unsigned int d = 0; d < dim - 1; ++d)
            size = std::max(size, cell->face(f)->bounding_box().side_length(d));
    const int n_levels =
        size > 0 ? std::max(0, int(std::ceil(std::log2(size / (1.05 * parameters.cell_size))))) : 0;
    if (n_levels > 0 && !mesh.is_hypercube())
    {
      std::ostringstream text;
      text << "The faces at the contact of body " << mesh.name << " measure " << size << " m, more than the "
           << parameters.cell_size
           << " m of its Contact cell size, and tetrahedra and prisms are not refined here: mesh it finer "
              "there "
              "(gmsh: a size field), or take the mesh as it is with Contact cell size = 0.";
      throw InputError(text.str());
    }
    if (n_levels > 7)
    {
      std::ostringstream text;
      text << "The coarse cells of body " << mesh.name << " at the contact measure " << size
           << " m, more than 7 halvings above the cell size of " << parameters.cell_size
           << " m asked for at the contact: refine the mesh there, or give it in other units (entry Unit of "
              "a mesh file).";
      throw InputError(text.str());
    }

    for (int level = 0; level < n_levels; ++level)
    {
      // Coarser levels reach further out, so that sizes double ring by ring.
      const double cell = size / std::pow(2., level + 1);
      const double reach = std::max(0., cell - parameters.cell_size);
      // one long cell of the coarse mesh does not make all others finer than asked for
      const auto is_long = [&](const auto &active)
      {
        double length = 0;
        for (unsigned int d = 0; d < dim - 1; ++d)
          length = std::max(length, active->bounding_box().side_length(d));
        return length > 1.05 * parameters.cell_size;
      };
      for (const auto &active : triangulation.active_cell_iterators())
        if (active->is_locally_owned() && active->level() == level && is_long(active) &&
            overlaps(active, parameters.margin + reach, parameters.depth + reach))
          active->set_refine_flag();
      unsigned int n_refined = 0;
      for (const auto &active : triangulation.active_cell_iterators())
        n_refined += active->is_locally_owned() && active->refine_flag_set();
      check_number_of_cells<dim>(
          double(triangulation.n_global_active_cells()) +
              (std::pow(2., dim) - 1) *
                  Utilities::MPI::sum(double(n_refined), triangulation.get_communicator()),
          degree, mesh.name, "make its Contact cell size larger or Refinement margin and depth smaller");
      triangulation.execute_coarsening_and_refinement();
    }
  }

  std::vector<double> graded_divisions(const double total, const double fine, const double fine_length,
                                       const double coarse, const double ratio)
  {
    std::vector<double> divisions;
    double sum = 0;
    while (sum < fine_length - 1e-9 * total && sum + fine <= total)
    {
      divisions.push_back(fine);
      sum += fine;
    }
    const unsigned int n_fine = divisions.size();
    double rest = 0, size = fine;
    while (sum + rest < total * (1 - 1e-12))
    {
      size = std::min(size * ratio, coarse);
      divisions.push_back(size);
      rest += size;
    }
    for (unsigned int k = n_fine; k < divisions.size(); ++k)
      divisions[k] *= (total - sum) / rest;
    return divisions;
  }

  template void refine_at_contact(BodyMesh<2> &, const ContactGrid &, const ContactRefinement &,
                                  unsigned int);
  template void refine_at_contact(BodyMesh<3> &, const ContactGrid &, const ContactRefinement &,
                                  unsigned int);
} // namespace vibrocontact

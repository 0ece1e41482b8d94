#include <vibrocontact/scene/revolved_mesh.h>
#include <vibrocontact/scene/section_manifolds.h>

#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  std::unique_ptr<Triangulation<2>>
  section_triangulation(const SectionMesh &section, const SectionOutline &outline,
                        const std::map<std::string, types::boundary_id> &parts)
  {
    auto result = plane_cells(section);
    for (unsigned int k = 0; k < outline.rows.size(); ++k)
      if (outline.rows[k].is_arc)
        result->set_manifold(1 + k, PolarManifold<2>(outline.rows[k].centre));
    // edges between two regions that share an arc
    for (const auto &cell : result->active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f) && cell->neighbor(f)->material_id() != cell->material_id())
        {
          const unsigned int k = outline.find({cell->face(f)->vertex(0), cell->face(f)->vertex(1)});
          if (k < outline.rows.size() && outline.rows[k].is_arc)
            cell->face(f)->set_manifold_id(1 + k);
        }
    for (const auto &face : result->active_face_iterators())
      if (face->at_boundary())
      {
        const unsigned int k = outline.find({face->vertex(0), face->vertex(1)});
        if (k == outline.rows.size())
          continue;
        if (outline.rows[k].is_arc)
          face->set_manifold_id(1 + k);
        const auto part = parts.find(outline.rows[k].part);
        if (part != parts.end())
          face->set_boundary_id(part->second);
      }
    return result;
  }

  void refine_section(Triangulation<2> &triangulation, const types::boundary_id boundary, const double low,
                      const double high, const double size)
  {
    double height = 0;
    for (const auto &face : triangulation.active_face_iterators())
      if (face->at_boundary() && face->boundary_id() == boundary)
        height = face->center()[1];
    const auto distance = [&](const Point<2> &p) {
      return std::hypot(p[1] - height, std::max({low - p[0], p[0] - high, 0.}));
    };
    for (bool refined = true; refined;)
    {
      refined = false;
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        double length = 0, nearest = distance(cell->center());
        for (const unsigned int f : cell->face_indices())
          length = std::max(length, cell->face(f)->measure());
        for (const unsigned int v : cell->vertex_indices())
          nearest = std::min(nearest, distance(cell->vertex(v)));
        if (length > std::max(1.05 * size, 2 * nearest))
        {
          cell->set_refine_flag();
          refined = true;
        }
      }
      if (refined)
        triangulation.execute_coarsening_and_refinement();
    }
  }
} // namespace vibrocontact

#include <vibrocontact/base/data_directory.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/gmsh_file.h>
#include <vibrocontact/scene/mesh_quality.h>
#include <vibrocontact/scene/section.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  std::string mesh_directory()
  {
    return data_directory() + "/meshes";
  }

  namespace
  {
    /// A mesh in other units than its outline finds none of its parts.
    void check_extent(const std::vector<Point<2>> &vertices, const SectionOutline &outline,
                      const bool mirrored, const std::string &file)
    {
      Point<2> low(1e300, 1e300), high(-1e300, -1e300), mesh_low = low, mesh_high = high;
      const auto widen = [](Point<2> &a, Point<2> &b, const Point<2> &p)
      {
        for (unsigned int d = 0; d < 2; ++d)
        {
          a[d] = std::min(a[d], p[d]);
          b[d] = std::max(b[d], p[d]);
        }
      };
      for (const auto &row : outline.rows)
        for (const Point<2> &end : {row.start, row.end})
        {
          widen(low, high, end);
          if (mirrored)
            widen(low, high, Point<2>(-end[0], end[1]));
        }
      for (const Point<2> &p : vertices)
        widen(mesh_low, mesh_high, p);
      // arcs may bulge beyond their ends
      const double slack = 0.2 * low.distance(high);
      if (low.distance(mesh_low) < slack && high.distance(mesh_high) < slack)
        return;
      std::ostringstream text;
      text << "The section mesh " << file << " spans (" << mesh_low << ") to (" << mesh_high
           << ") m, its outline (" << low << ") to (" << high
           << ") m: they are not of one section; give the mesh in metres, the outline in mm.";
      throw InputError(text.str());
    }
  } // namespace

  SectionMesh SectionMesh::read(const std::string &file, const double scale, const unsigned int refinements,
                                const SectionOutline &outline, const bool mirrored,
                                const GroupMaterials &materials)
  {
    return make(GmshFile::read_section(file), file, scale, refinements, outline, mirrored, materials);
  }

  SectionMesh SectionMesh::make(const GmshFile &gmsh, const std::string &file, const double scale,
                                const unsigned int refinements, const SectionOutline &outline,
                                const bool mirrored, const GroupMaterials &materials)
  {
    const std::vector<unsigned int> numbers = material_numbers(gmsh.cells, materials, file);
    std::vector<Point<2>> nodes;
    for (const Point<3> &node : gmsh.nodes)
      nodes.emplace_back(scale * node[0], scale * node[1]);
    std::vector<CellData<2>> quads;
    for (const auto &q : gmsh.quadrilaterals)
    {
      CellData<2> cell;
      cell.vertices = {q[0], q[1], q[3], q[2]};
      const Tensor<1, 2> u = nodes[q[2]] - nodes[q[0]], w = nodes[q[3]] - nodes[q[1]];
      if (u[0] * w[1] - u[1] * w[0] < 0)
        std::swap(cell.vertices[1], cell.vertices[2]);
      cell.material_id = numbers[quads.size()];
      quads.push_back(cell);
    }
    check_cells(nodes, quads, file);
    SubCellData no_boundary;
    GridTools::delete_unused_vertices(nodes, quads, no_boundary);
    check_extent(nodes, outline, mirrored, file);
    GridTools::consistently_order_cells(quads);
    Triangulation<2> triangulation;
    triangulation.create_triangulation(nodes, quads, no_boundary);

    const unsigned int n_rows = outline.rows.size();
    const double signs[] = {1., -1.};
    for (const double sign : signs)
      if (refinements > 0 && (sign > 0 || mirrored))
        for (unsigned int k = 0; k < n_rows; ++k)
          if (outline.rows[k].is_arc)
          {
            const unsigned int id = 1 + k + (sign < 0 ? n_rows : 0);
            triangulation.set_manifold(
                id, PolarManifold<2>(Point<2>(sign * outline.rows[k].centre[0], outline.rows[k].centre[1])));
            for (const auto &face : triangulation.active_face_iterators())
              if (face->at_boundary() &&
                  outline.find({Point<2>(sign * face->vertex(0)[0], face->vertex(0)[1]),
                                Point<2>(sign * face->vertex(1)[0], face->vertex(1)[1])}) == k)
                face->set_manifold_id(id);
          }
    triangulation.refine_global(refinements);

    SectionMesh mesh;
    mesh.vertices = triangulation.get_vertices();
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      std::array<unsigned int, 4> vertices;
      for (unsigned int v = 0; v < 4; ++v)
        vertices[v] = cell->vertex_index(v);
      const Tensor<1, 2> u = cell->vertex(3) - cell->vertex(0), w = cell->vertex(2) - cell->vertex(1);
      if (u[0] * w[1] - u[1] * w[0] < 0)
        std::swap(vertices[1], vertices[2]);
      mesh.cells.push_back(vertices);
      mesh.materials.push_back(cell->material_id());
    }
    return mesh;
  }
} // namespace vibrocontact

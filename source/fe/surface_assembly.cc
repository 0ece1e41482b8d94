#include <vibrocontact/fe/surface_assembly.h>

#include <map>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// What the ranks exchange; the first dof of a vertex names it.
    struct Vertex
    {
      Point<3> place;
      std::array<TraceRow, 3> rows;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &place;
        for (auto &row : rows)
          archive &row;
      }
    };

    struct Piece
    {
      std::map<types::global_dof_index, Vertex> vertices;
      std::vector<std::array<types::global_dof_index, 4>> quads;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &vertices &quads;
      }
    };
  } // namespace

  template <int dim>
  SurfaceTrace make_surface_trace(const ElasticBody<dim> &body)
  {
    Piece own;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary())
        continue;
      const auto corners = body.mapping.get_vertices(cell);
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary())
          continue;
        std::array<types::global_dof_index, 4> quad;
        const ReferenceCell shape = cell->reference_cell();
        std::array<unsigned int, 4> around = {{0, 1, 3, 2}};
        if (dim == 2)
          around = {{0, 1, 1, 0}};
        else if (shape.face_reference_cell(f) == ReferenceCells::Triangle)
          around = {{0, 1, 2, 2}};
        for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int v = shape.face_to_cell_vertices(f, around[k], 1);
          quad[k] = cell->vertex_dof_index(v, 0);
          if (own.vertices.count(quad[k]))
            continue;
          Vertex &vertex = own.vertices[quad[k]];
          for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int direction = dim == 2 && d == 1 ? 2 : d;
            vertex.place[direction] = corners[v][d];
            const types::global_dof_index dof = cell->vertex_dof_index(v, d);
            if (!body.constraints.is_constrained(dof))
              vertex.rows[direction] = {{dof, 1.}};
            else
              vertex.rows[direction] = *body.constraints.get_constraint_entries(dof);
          }
        }
        own.quads.push_back(quad);
      }
    }

    SurfaceTrace surface;
    std::map<types::global_dof_index, int> number;
    for (const Piece &piece : Utilities::MPI::all_gather(body.communicator(), own))
    {
      for (const auto &[name, vertex] : piece.vertices)
        if (number.emplace(name, surface.points.size()).second)
        {
          surface.points.push_back(vertex.place);
          surface.rows.insert(surface.rows.end(), vertex.rows.begin(), vertex.rows.end());
        }
      for (const auto &names : piece.quads)
        surface.quads.push_back(
            {{number.at(names[0]), number.at(names[1]), number.at(names[2]), number.at(names[3])}});
    }
    return surface;
  }

  template SurfaceTrace make_surface_trace(const ElasticBody<2> &);
  template SurfaceTrace make_surface_trace(const ElasticBody<3> &);
} // namespace vibrocontact

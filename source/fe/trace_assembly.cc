#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/face_map.h>
#include <vibrocontact/fe/grid_quadrature.h>
#include <vibrocontact/fe/own_faces.h>
#include <vibrocontact/fe/trace_assembly.h>

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Range of cells 0..n-1 that [low, high] touches.
    std::pair<int, int> cell_range(const double low, const double high, const double first,
                                   const double spacing, const unsigned int n)
    {
      return {std::max(0, int(std::floor((low - first) / spacing + 0.5))),
              std::min(int(n) - 1, int(std::floor((high - first) / spacing + 0.5)))};
    }

    /// One trace in the making: the steps of make_contact_trace() and what they hand to each other.
    template <int dim>
    class TraceMaker
    {
    public:
      TraceMaker(const ElasticBody<dim> &body, const ContactGrid &grid, const ContactFrame &frame)
          : body(body), grid(grid), frame(frame), communicator(body.communicator()),
            rank(Utilities::MPI::this_mpi_process(communicator)), scalar(body.element.base_element(0)),
            n(grid.n_points()), x_low(grid.x_first - grid.spacing_x / 2),
            x_high(x_low + grid.n_x * grid.spacing_x), y_low(grid.y_first - grid.spacing_y / 2),
            y_high(y_low + grid.n_y * grid.spacing_y), shape(scalar.reference_cell()),
            square(body.mesh.geometry_degree), triangle(body.mesh.geometry_degree, true)
      {
      }

      ContactTrace make()
      {
        find_faces();
        const GridQuadrature quadrature = fitting_quadrature();
        find_points(quadrature);
        check_points(quadrature);
        // a rank finds what is wrong with its own faces alone
        on_all_ranks([&] { find_weights(quadrature); }, communicator);
        return joined_trace();
      }

    private:
      /// A contact face of this rank over or under the grid.
      struct Face
      {
        typename DoFHandler<dim>::active_cell_iterator cell;
        unsigned int number;
        std::vector<Point<dim>> positions;
      };
      /// Where a quadrature point of the grid was found.
      struct Hit
      {
        unsigned int face = numbers::invalid_unsigned_int;
        double height = 0;
        Point<dim - 1> s;
      };
      /// the three (two) dofs of a node
      using Key = std::array<types::global_dof_index, 3>;

      /// A place in the contact's frame.
      Point<dim> seen(const Point<dim> &place) const
      {
        if (dim == 2 || frame.is_usual())
          return place;
        const auto there = frame.coordinates({{place[0], place[1], place[dim - 1]}});
        Point<dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = there[d];
        return result;
      }

      bool is_triangle(const unsigned int f) const
      {
        return shape.face_reference_cell(f) == ReferenceCells::Triangle;
      }
      FaceMap<dim> &map_of(const unsigned int f) { return is_triangle(f) ? triangle : square; }

      static BoundingBox<dim> box(const std::vector<Point<dim>> &positions)
      {
        BoundingBox<dim> result(std::make_pair(positions[0], positions[0]));
        for (const auto &p : positions)
          result.merge_with(BoundingBox<dim>(std::make_pair(p, p)));
        result.extend(0.05 *
                      (result.get_boundary_points().second - result.get_boundary_points().first).norm());
        return result;
      }

      void find_faces()
      {
        std::vector<std::unique_ptr<FEValues<dim>>> face_nodes;
        for (unsigned int f = 0; f < shape.n_faces(); ++f)
          face_nodes.push_back(std::make_unique<FEValues<dim>>(
              body.mapping, scalar, map_of(f).support(shape, f), update_quadrature_points));
        for (const auto &[cell, f] : own_faces(body.dof_handler, body.mesh.contact_boundaries))
        {
          face_nodes[f]->reinit(typename Triangulation<dim>::active_cell_iterator(cell));
          std::vector<Point<dim>> positions = face_nodes[f]->get_quadrature_points();
          for (Point<dim> &position : positions)
            position = seen(position);
          const BoundingBox<dim> bounds = box(positions);
          if (bounds.upper_bound(0) < x_low || bounds.lower_bound(0) > x_high ||
              (dim == 3 && (bounds.upper_bound(1) < y_low || bounds.lower_bound(1) > y_high)))
            continue;
          faces.push_back({cell, f, positions});
        }
      }

      GridQuadrature fitting_quadrature()
      {
        // The grid's quadrature follows the smallest face near z = 0; where faces end inside sub-cells, many
        // small ones.
        double nearest = std::numeric_limits<double>::max();
        for (const Face &face : faces)
          nearest = std::min(nearest, std::abs(face.positions[0][dim - 1]));
        double h_x_min = 1e30, h_y_min = 1e30;
        nearest = Utilities::MPI::min(nearest, communicator);
        reach = nearest + (x_high - x_low) + (dim == 3 ? y_high - y_low : 0.);
        for (const Face &face : faces)
          if (std::abs(face.positions[0][dim - 1]) < reach)
          {
            FaceMap<dim> &map = map_of(face.number);
            map.reinit(face.positions);
            const auto length = map.extent();
            if (length[0] <= 0)
              continue;
            h_x_min = std::min(h_x_min, length[0]);
            h_y_min = std::min(h_y_min, dim == 3 ? length[1] : grid.spacing_y);
          }
        h_x_min = Utilities::MPI::min(h_x_min, communicator);
        h_y_min = Utilities::MPI::min(h_y_min, communicator);
        const auto n_fitting = [](const double spacing, const double h)
        { return std::min(16u, 2 * std::max(1u, unsigned(std::ceil(spacing / (2 * h) - 0.05)))); };
        unsigned int n_sub_x = n_fitting(grid.spacing_x, h_x_min);
        unsigned int n_sub_y = dim == 3 ? n_fitting(grid.spacing_y, h_y_min) : 1;
        bool aligned = true;
        for (const Face &face : faces)
          if (std::abs(face.positions[0][dim - 1]) < reach)
          {
            // faces of triangles end anywhere
            aligned = aligned && !is_triangle(face.number);
            if (!aligned)
              break;
            const Point<dim> &corner = face.positions.front(), &opposite = face.positions.back();
            const Point<dim> &along = face.positions[body.mesh.geometry_degree];
            const auto on_line = [](const double position, const double step)
            { return std::abs(position / step - std::round(position / step)) < 0.02; };
            for (const Point<dim> &p : {corner, opposite})
            {
              aligned = aligned && on_line(p[0] - x_low, grid.spacing_x / n_sub_x);
              if (dim == 3)
                aligned = aligned && on_line(p[1] - y_low, grid.spacing_y / n_sub_y);
            }
            if (dim == 3)
              aligned = aligned && std::min(std::abs(along[0] - corner[0]) / grid.spacing_x,
                                            std::abs(along[1] - corner[1]) / grid.spacing_y) < 0.02;
          }
        if (Utilities::MPI::max(aligned ? 0 : 1, communicator) == 1)
        {
          n_sub_x = std::max(n_sub_x, 10u);
          n_sub_y = dim == 3 ? std::max(n_sub_y, 10u) : 1;
        }
        return GridQuadrature(grid, n_sub_x, n_sub_y, scalar.degree <= 3 ? 2 : 3);
      }

      void find_points(const GridQuadrature &quadrature)
      {
        // Find every point; of several faces the one nearest to the tangent plane, then the first rank, has
        // it.
        const unsigned int n_q = quadrature.n_per_cell();
        hits.resize(n * n_q);
        std::vector<double> height(n * n_q, std::numeric_limits<double>::max());
        for (unsigned int k = 0; k < faces.size(); ++k)
        {
          FaceMap<dim> &map = map_of(faces[k].number);
          map.reinit(faces[k].positions);
          const BoundingBox<dim> bounds = box(faces[k].positions);
          const auto [i0, i1] = cell_range(bounds.lower_bound(0), bounds.upper_bound(0), grid.x_first,
                                           grid.spacing_x, grid.n_x);
          const auto [j0, j1] = dim == 3 ? cell_range(bounds.lower_bound(1), bounds.upper_bound(1),
                                                      grid.y_first, grid.spacing_y, grid.n_y)
                                         : std::pair<int, int>(0, 0);
          bool used = false;
          for (int j = j0; j <= j1; ++j)
            for (int i = i0; i <= i1; ++i)
              for (unsigned int q = 0; q < n_q; ++q)
              {
                const unsigned int point = grid.index(i, j);
                Point<dim - 1> target;
                target[0] = quadrature.px(point, q);
                if (dim == 3)
                  target[dim - 2] = quadrature.py(point, q);
                bool inside = true;
                for (unsigned int d = 0; d < dim - 1; ++d)
                  inside = inside && target[d] >= bounds.lower_bound(d) && target[d] <= bounds.upper_bound(d);
                Hit hit;
                if (!inside || !map.invert(target, hit.s, hit.height))
                  continue;
                double &best = height[point * n_q + q];
                if (std::abs(hit.height) < best - 1e-9)
                {
                  best = std::abs(hit.height);
                  hit.face = k;
                  hits[point * n_q + q] = hit;
                  used = true;
                }
              }
          if (used && std::abs(faces[k].positions[0][dim - 1]) < reach)
          {
            h_x = std::max(h_x, map.extent()[0]);
            h_y = std::max(h_y, map.extent()[1]);
          }
        }
        std::vector<double> lowest(height.size());
        Utilities::MPI::min(height, communicator, lowest);
        std::vector<unsigned int> claim(height.size(), numbers::invalid_unsigned_int);
        owner.resize(height.size());
        for (unsigned int k = 0; k < height.size(); ++k)
          if (hits[k].face != numbers::invalid_unsigned_int && height[k] <= lowest[k] + 1e-9)
            claim[k] = rank;
        Utilities::MPI::min(claim, communicator, owner);
      }

      void check_points(const GridQuadrature &quadrature) const
      {
        const unsigned int n_q = quadrature.n_per_cell();
        for (unsigned int k = 0; k < owner.size(); ++k)
          if (owner[k] == numbers::invalid_unsigned_int)
          {
            std::ostringstream text;
            text << "The contact grid leaves the surface of body " << body.mesh.name
                 << ": there is no contact face at x = " << 1e3 * quadrature.px(k / n_q, k % n_q)
                 << " mm, y = " << 1e3 * quadrature.py(k / n_q, k % n_q)
                 << " mm; make the grid smaller or move the contact (Contact/Lateral position).";
            throw InputError(text.str());
          }
        const auto refuse_fine = [&](const double spacing, const double h, const char *axis)
        {
          const double cell = Utilities::MPI::max(h, communicator);
          if (spacing * scalar.degree >= 0.95 * cell)
            return;
          std::ostringstream text;
          text
              << "Contact/Grid spacing is too fine for the mesh of body " << body.mesh.name << ": "
              << 1e3 * spacing << " mm along " << axis << " where its cells of degree " << scalar.degree
              << " measure " << 1e3 * cell
              << " mm, so that several contact points share one node; refine the mesh at the contact or take "
              << 1e3 * cell / scalar.degree << " mm or more.";
          throw InputError(text.str());
        };
        refuse_fine(grid.spacing_x, h_x, "x");
        if (dim == 3)
          refuse_fine(grid.spacing_y, h_y, "y");
      }

      /// A node as free nodes, a hanging one by those that carry it; empty if it is held.
      std::vector<std::pair<Key, double>> free_nodes(const Key &node) const
      {
        if (!body.constraints.is_constrained(node[0]))
          return {{node, 1.}};
        std::vector<std::pair<Key, double>> result;
        // all components hang on the same nodes, in the same order
        for (unsigned int c = 0; c < dim; ++c)
        {
          const auto &entries = *body.constraints.get_constraint_entries(node[c]);
          if (c == 0)
            for (const auto &[dof, share] : entries)
              result.push_back({{{dof, 0, 0}}, share});
          const bool alike =
              std::equal(entries.begin(), entries.end(), result.begin(), result.end(),
                         [](const auto &entry, const auto &first) { return entry.second == first.second; });
          AssertThrow(alike, ExcMessage("The components of a hanging node hang on different nodes."));
          for (unsigned int k = 0; k < entries.size(); ++k)
            result[k].first[c] = entries[k].first;
        }
        return result;
      }

      void find_weights(const GridQuadrature &quadrature)
      {
        const unsigned int n_q = quadrature.n_per_cell();
        weights.resize(n);
        surface_height.assign(n, 0.);
        const std::vector<Point<dim>> node_points = scalar_node_points<dim>(scalar);
        std::vector<types::global_dof_index> dofs(body.element.n_dofs_per_cell());
        for (unsigned int k = 0; k < owner.size(); ++k)
          if (owner[k] == rank)
          {
            const Face &face = faces[hits[k].face];
            const Point<dim> unit = on_face<dim>(shape, face.number, hits[k].s);
            const double w = quadrature.weight(k % n_q);
            n_up += seen(face.cell->face(face.number)->center())[dim - 1] > seen(face.cell->center())[dim - 1]
                        ? 1
                        : -1;
            face.cell->get_dof_indices(dofs);
            const auto tractions = quadrature.tractions(k / n_q, k % n_q);
            for (const auto &[point, tau] : tractions)
              surface_height[point] += tau * w * hits[k].height;
            for (unsigned int node = 0; node < scalar.n_dofs_per_cell(); ++node)
            {
              if (!lies_on_face<dim>(shape, face.number, node_points[node]))
                continue;
              const double N = scalar.shape_value(node, unit);
              if (N == 0)
                continue;
              Key key = {{0, 0, 0}};
              for (unsigned int c = 0; c < dim; ++c)
                key[c] = dofs[body.element.component_to_system_index(c, node)];
              const auto masters = free_nodes(key);
              if (masters.empty())
                throw InputError("The contact grid touches the held boundary of body " + body.mesh.name +
                                 "; make the grid smaller or move the contact.");
              for (const auto &[master, share] : masters)
                for (const auto &[point, tau] : tractions)
                  if (tau > 0)
                    weights[point][master] += tau * w * N * share;
            }
          }
      }

      ContactTrace joined_trace() const
      {
        ContactTrace trace;
        trace.grid = grid;
        trace.surface_height.resize(n);
        Utilities::MPI::sum(surface_height, communicator, trace.surface_height);
        trace.faces_up = Utilities::MPI::sum(n_up, communicator) > 0;
        trace.rows.resize(3 * n);
        trace.lifting.resize(3 * n);
        const auto all = Utilities::MPI::all_gather(communicator, weights);
        for (unsigned int i = 0; i < n; ++i)
        {
          std::map<Key, double> merged;
          for (const auto &part : all)
            for (const auto &entry : part[i])
              merged[entry.first] += entry.second;
          double sum = 0;
          for (const auto &entry : merged)
            sum += entry.second;
          AssertThrow(std::abs(sum - 1) < 1e-10,
                      ExcMessage("The weights of a contact point do not sum to one."));
          for (unsigned int c = 0; c < 3; ++c)
          {
            if (dim == 2 && c == 2)
              continue;
            auto &row = trace.rows[contact_row(n, c, i)];
            for (const auto &entry : merged)
              for (unsigned int d = 0; d < dim; ++d)
              {
                const double share = direction(c, d);
                if (std::abs(entry.second) > 1e-15 && share != 0)
                  row.emplace_back(entry.first[d], entry.second * share);
              }
            std::sort(row.begin(), row.end());
            trace.lifting[contact_row(n, c, i)] = direction(c, dim - 1);
          }
        }
        return trace;
      }

      /// Share of a component of the displacement in a component of the contact.
      double direction(const unsigned int c, const unsigned int d) const
      {
        return dim == 2 ? d == (c == 0 ? dim - 1 : c - 1) : frame.axes[c][d];
      }

      const ElasticBody<dim> &body;
      const ContactGrid &grid;
      const ContactFrame frame;
      const MPI_Comm communicator;
      const unsigned int rank;
      const FiniteElement<dim> &scalar;
      const unsigned int n;
      /// the rectangle that the grid covers [m]
      const double x_low, x_high, y_low, y_high;
      /// of the cells, and maps of their faces
      const ReferenceCell shape;
      FaceMap<dim> square, triangle;
      std::vector<Face> faces;
      /// faces further than this from z = 0 are another part of the surface; largest faces used [m]
      double reach = 0, h_x = 0, h_y = 0;
      /// per quadrature point: the face of this rank, and the rank whose face counts
      std::vector<Hit> hits;
      std::vector<unsigned int> owner;
      /// this rank's share of the weights of the scalar shape functions and of the heights [m]
      std::vector<std::map<Key, double>> weights;
      std::vector<double> surface_height;
      /// this rank's quadrature points on faces that look up less those on faces that look down
      int n_up = 0;
    };
  } // namespace

  template <int dim>
  ContactTrace make_contact_trace(const ElasticBody<dim> &body, const ContactGrid &grid,
                                  const ContactFrame &frame)
  {
    AssertThrow(dim == 3 || grid.n_y == 1, ExcMessage("The contact of a plane body is a line: n_y = 1."));
    return TraceMaker<dim>(body, grid, frame).make();
  }

  template ContactTrace make_contact_trace(const ElasticBody<2> &, const ContactGrid &, const ContactFrame &);
  template ContactTrace make_contact_trace(const ElasticBody<3> &, const ContactGrid &, const ContactFrame &);
} // namespace vibrocontact

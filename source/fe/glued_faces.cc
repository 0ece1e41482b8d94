#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/glued_faces.h>
#include <vibrocontact/fe/glued_surfaces.h>
#include <vibrocontact/fe/own_faces.h>
#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Dof = types::global_dof_index;
    /// factors of unknowns
    using Sum = std::map<Dof, double>;

    /// entries below this are round-off of ones
    constexpr double no_entry = 1e-14;

    void add(Sum &sum, const double factor, const Sum &other)
    {
      for (const auto &[dof, value] : other)
        sum[dof] += factor * value;
    }

    /// What the ranks exchange: faces by boundary, and what binds their unknowns already.
    struct Surfaces
    {
      std::map<types::boundary_id, std::vector<FaceOfDofs>> faces;
      std::map<Dof, Sum> lines;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &faces &lines;
      }
    };

    /// Which node of a cell each node of its face is.
    std::vector<unsigned int> nodes_of_face(const std::vector<Point<3>> &nodes, const ReferenceCell &shape,
                                            const unsigned int f, const unsigned int degree)
    {
      std::vector<unsigned int> result;
      const bool triangle = shape.face_reference_cell(f) == ReferenceCells::Triangle;
      for (const Point<2> &s : SurfaceFace::unit_nodes(triangle, degree))
      {
        const Point<3> p = on_face<3>(shape, f, s);
        const auto nearest =
            std::min_element(nodes.begin(), nodes.end(),
                             [&](const auto &a, const auto &b) { return a.distance(p) < b.distance(p); });
        result.push_back(nearest - nodes.begin());
      }
      return result;
    }

    Surfaces surfaces_of(const DoFHandler<3> &dof_handler, const Mapping<3> &mapping,
                         const AffineConstraints<double> &constraints,
                         const std::set<types::boundary_id> &boundaries)
    {
      const FiniteElement<3> &element = dof_handler.get_fe(), &scalar = element.base_element(0);
      const ReferenceCell shape = element.reference_cell();
      const std::vector<Point<3>> nodes = scalar_node_points<3>(scalar);
      FEValues<3> values(mapping, scalar, Quadrature<3>(nodes), update_quadrature_points);
      std::vector<std::vector<unsigned int>> on_faces;
      for (const unsigned int f : shape.face_indices())
        on_faces.push_back(nodes_of_face(nodes, shape, f, scalar.degree));
      std::vector<Dof> dofs(element.n_dofs_per_cell());
      Surfaces own;
      for (const auto &[cell, f] : own_faces(dof_handler, boundaries))
      {
        values.reinit(typename Triangulation<3>::active_cell_iterator(cell));
        cell->get_dof_indices(dofs);
        FaceOfDofs one;
        one.face.triangle = shape.face_reference_cell(f) == ReferenceCells::Triangle;
        one.face.degree = scalar.degree;
        for (const unsigned int k : on_faces[f])
        {
          one.face.nodes.push_back(values.quadrature_point(k));
          one.dofs.push_back(
              {{dofs[element.component_to_system_index(0, k)], dofs[element.component_to_system_index(1, k)],
                dofs[element.component_to_system_index(2, k)]}});
          for (const Dof dof : one.dofs.back())
            if (constraints.is_constrained(dof))
            {
              Sum &line = own.lines[dof];
              for (const auto &[other, factor] : *constraints.get_constraint_entries(dof))
                line[other] = factor;
            }
        }
        if (one.face.area_vector(one.face.middle()) * (one.face.place(one.face.middle()) - cell->center()) <
            0)
          one.face.side = -1;
        own.faces[cell->face(f)->boundary_id()].push_back(one);
      }
      Surfaces all;
      for (const Surfaces &piece : Utilities::MPI::all_gather(dof_handler.get_communicator(), own))
      {
        for (const auto &[boundary, faces] : piece.faces)
          all.faces[boundary].insert(all.faces[boundary].end(), faces.begin(), faces.end());
        all.lines.insert(piece.lines.begin(), piece.lines.end());
      }
      return all;
    }

    /// The equations of one direction, in the transformed unknowns of the followers that are free.
    ///
    /// A free follower's own number stands for its transformed unknown, all others for displacements.
    class Direction
    {
    public:
      Direction(const MortarMatrices &matrices, const unsigned int c, const std::map<Dof, Sum> &lines)
          : matrices(matrices), c(c), lines(lines)
      {
        for (const auto &[name, node] : matrices.followers)
          node_of[node.dofs[c]] = &node;
      }

      /// Lines of the free followers. @throws Singular if they are not determined
      std::map<Dof, Sum> solve()
      {
        std::map<Dof, Sum> rows;
        for (const auto &[dof, node] : node_of)
        {
          Sum row;
          add(row, node->area, transformed(*node));
          for (const auto &[leader, factor] : node->leaders)
            add(row, -factor, displacement(matrices.leaders.at(leader).second[c]));
          for (const auto &[free, share] : takers(*node))
            add(rows[free], share, row);
        }
        const std::map<Dof, Sum> unknowns = solution(rows);
        std::map<Dof, Sum> result;
        for (const auto &[dof, unknown] : unknowns)
        {
          Sum &line = result[dof];
          for (const auto &[other, factor] : displacement(dof))
            if (unknowns.count(other))
              add(line, factor, unknowns.at(other));
            else
              line[other] += factor;
        }
        return result;
      }

    private:
      bool is_free(const Dof dof) const { return lines.count(dof) == 0; }

      /// Of an unknown of the body.
      Sum displacement(const Dof dof) const
      {
        Sum result;
        const auto line = lines.find(dof);
        if (line != lines.end())
        {
          for (const auto &[other, factor] : line->second)
            add(result, factor, displacement(other));
          return result;
        }
        const auto node = node_of.find(dof);
        if (node == node_of.end() || node->second->corners.empty())
          return {{dof, 1.}};
        result[dof] = 1 - 2 * MortarMatrices::alpha;
        for (const Dof corner : node->second->corners)
          add(result, MortarMatrices::alpha, transformed(matrices.followers.at(corner)));
        return result;
      }

      /// The transformed unknown of a follower.
      Sum transformed(const MortarMatrices::Node &node) const
      {
        const Dof dof = node.dofs[c];
        if (is_free(dof))
          return {{dof, 1.}};
        Sum result;
        const double factor = node.corners.empty() ? 1 : 1 / (1 - 2 * MortarMatrices::alpha);
        add(result, factor, displacement(dof));
        for (const Dof corner : node.corners)
          add(result, -factor * MortarMatrices::alpha, transformed(matrices.followers.at(corner)));
        return result;
      }

      /// The free followers among which the multiplier of a node is divided; their shares' sum is one.
      Sum takers(const MortarMatrices::Node &node) const
      {
        if (is_free(node.dofs[c]))
          return {{node.dofs[c], 1.}};
        Sum result;
        double sum = 0;
        // a hanging node between free ones: the functions of the mesh without it
        for (const auto &[dof, factor] : lines.at(node.dofs[c]))
          if (node_of.count(dof) && is_free(dof) && factor > 0)
            sum += result[dof] = factor;
        if (result.empty())
          for (const Dof other : node.neighbours)
            if (is_free(matrices.followers.at(other).dofs[c]))
              sum += result[matrices.followers.at(other).dofs[c]] = 1;
        for (auto &entry : result)
          entry.second /= sum;
        return result;
      }

      /// Solves the rows for the free followers, each set of those that are coupled by itself: mostly single ones.
      static std::map<Dof, Sum> solution(const std::map<Dof, Sum> &rows)
      {
        std::map<Dof, Dof> parent;
        for (const auto &entry : rows)
          parent[entry.first] = entry.first;
        const auto root = [&](Dof dof)
        {
          while (parent[dof] != dof)
            dof = parent[dof] = parent[parent[dof]];
          return dof;
        };
        for (const auto &[dof, row] : rows)
          for (const auto &[other, factor] : row)
            if (rows.count(other) && factor != 0)
              parent[root(dof)] = root(other);
        std::map<Dof, std::vector<Dof>> sets;
        for (const auto &entry : rows)
          sets[root(entry.first)].push_back(entry.first);

        std::map<Dof, Sum> result;
        for (const auto &[first, set] : sets)
        {
          const unsigned int n = set.size();
          std::map<Dof, unsigned int> column;
          for (const Dof dof : set)
            for (const auto &entry : rows.at(dof))
              if (rows.count(entry.first) == 0)
                column.emplace(entry.first, column.size());
          FullMatrix<double> inverse(n, n), given(n, column.size()), solved(n, column.size());
          for (unsigned int i = 0; i < n; ++i)
            for (const auto &[dof, factor] : rows.at(set[i]))
              if (rows.count(dof))
                inverse(i, std::lower_bound(set.begin(), set.end(), dof) - set.begin()) = factor;
              else
                given(i, column.at(dof)) = factor;
          inverse.gauss_jordan();
          if (!column.empty())
            inverse.mmult(solved, given);
          for (unsigned int i = 0; i < n; ++i)
          {
            Sum &sum = result[set[i]];
            for (const auto &[dof, k] : column)
              if (std::abs(solved(i, k)) > no_entry)
                sum[dof] = -solved(i, k);
          }
        }
        return result;
      }

      const MortarMatrices &matrices;
      const unsigned int c;
      const std::map<Dof, Sum> &lines;
      std::map<Dof, const MortarMatrices::Node *> node_of;
    };

    /// An unknown in those that lines leave free.
    Sum resolved(const Dof dof, const std::map<Dof, Sum> &lines)
    {
      const auto line = lines.find(dof);
      if (line == lines.end())
        return {{dof, 1.}};
      Sum result;
      for (const auto &[other, factor] : line->second)
        add(result, factor, resolved(other, lines));
      return result;
    }

    /// What a node follows beside its mean if that is off it by @p r: omega x r of its leaders, by direction.
    std::array<Sum, 3> turned_with_leaders(const MortarMatrices &matrices, const MortarMatrices::Node &node,
                                           const Tensor<1, 3> &r, const std::map<Dof, Sum> &lines)
    {
      Point<3> middle;
      for (const auto &leader : node.leaders)
        middle += matrices.leaders.at(leader.first).first / double(node.leaders.size());
      Tensor<2, 3> inertia;
      for (const auto &leader : node.leaders)
      {
        const Tensor<1, 3> d = matrices.leaders.at(leader.first).first - middle;
        inertia += d * d * Tensor<2, 3>(unit_symmetric_tensor<3>()) - outer_product(d, d);
      }
      const Tensor<2, 3> inverse = invert(inertia);
      std::array<Sum, 3> result;
      for (const auto &leader : node.leaders)
      {
        const auto &[place, dofs] = matrices.leaders.at(leader.first);
        for (unsigned int c = 0; c < 3; ++c)
        {
          Tensor<1, 3> along;
          along[c] = 1;
          const Tensor<1, 3> way = cross_product_3d(inverse * cross_product_3d(place - middle, along), r);
          const Sum moved = resolved(dofs[c], lines);
          for (unsigned int d = 0; d < 3; ++d)
            add(result[d], way[d], moved);
        }
      }
      return result;
    }

    /// Lets followers that are off the mean of their leaders turn with them (glue_faces()). Nodes that are held or follow nodes
    /// elsewhere stay as they are.
    void follow_rotations(const MortarMatrices &matrices, const std::map<Dof, Point<3>> &places,
                          const std::map<Dof, Sum> &lines, std::map<Dof, Sum> &added)
    {
      constexpr double off = 1e-10;
      const std::map<Dof, Sum> means = added;
      for (const auto &[name, node] : matrices.followers)
      {
        Tensor<1, 3> r = node.place;
        double sum = 0, size = 0;
        bool known = true;
        for (const Dof dof : node.dofs)
          known = known && means.count(dof) > 0;
        if (!known)
          continue;
        for (const auto &[dof, factor] : means.at(node.dofs[0]))
        {
          const auto place = places.find(dof);
          known = known && place != places.end();
          if (!known)
            break;
          r -= factor * place->second;
          sum += factor;
        }
        for (const auto &leader : node.leaders)
          size = std::max(size, node.place.distance(matrices.leaders.at(leader.first).first));
        if (!known || std::abs(sum - 1) > off || r.norm() < off * size)
          continue;
        const std::array<Sum, 3> turned = turned_with_leaders(matrices, node, r, lines);
        if (std::any_of(turned.begin(), turned.end(),
                        [&](const Sum &one)
                        {
                          return std::any_of(one.begin(), one.end(),
                                             [&](const auto &entry) { return means.count(entry.first) > 0; });
                        }))
          continue;
        for (unsigned int d = 0; d < 3; ++d)
          add(added.at(node.dofs[d]), 1., turned[d]);
      }
    }
  } // namespace

  void glue_faces(const DoFHandler<3> &dof_handler, const Mapping<3> &mapping,
                  const std::vector<GluedBoundaries> &pairs, const std::string &entry,
                  IndexSet &locally_relevant, AffineConstraints<double> &constraints)
  {
    if (pairs.empty())
      return;
    std::set<types::boundary_id> boundaries;
    for (const GluedBoundaries &pair : pairs)
    {
      boundaries.insert(pair.follower);
      boundaries.insert(pair.leader);
    }
    Surfaces surfaces = surfaces_of(dof_handler, mapping, constraints, boundaries);
    std::map<Dof, Sum> &lines = surfaces.lines;
    std::map<Dof, Point<3>> places;
    for (const auto &[boundary, faces] : surfaces.faces)
      for (const FaceOfDofs &one : faces)
        for (unsigned int k = 0; k < one.dofs.size(); ++k)
          for (const Dof dof : one.dofs[k])
            places[dof] = one.face.nodes[k];
    for (const GluedBoundaries &pair : pairs)
    {
      const MortarMatrices matrices =
          mortar_matrices(surfaces.faces[pair.follower], surfaces.faces[pair.leader], entry,
                          pair.follower_name, pair.leader_name);
      std::map<Dof, Sum> added;
      for (unsigned int c = 0; c < 3; ++c)
        added.merge(Direction(matrices, c, lines).solve());
      follow_rotations(matrices, places, lines, added);
      lines.insert(added.begin(), added.end());
      std::string text = entry + ": " + std::to_string(matrices.followers.size()) + " nodes of " +
                         pair.follower_name + " follow " + std::to_string(matrices.leaders.size()) + " of " +
                         pair.leader_name;
      if (matrices.gap > 1e-9)
        text += ", up to " + number_text(1e3 * matrices.gap) + " mm apart";
      if (matrices.uncovered > 1e-6)
        text += ", " + number_text(100 * matrices.uncovered) + " % of its area lie on nothing";
      run_log().line(text);
    }

    for (const auto &[boundary, faces] : surfaces.faces)
      for (const FaceOfDofs &one : faces)
        for (const auto &dofs : one.dofs)
          locally_relevant.add_indices(dofs.begin(), dofs.end());
    for (const auto &[dof, line] : lines)
      for (const auto &other : line)
        locally_relevant.add_index(other.first);
    AffineConstraints<double> all(locally_relevant);
    for (const auto &line : constraints.get_lines())
      lines[line.index] = Sum(line.entries.begin(), line.entries.end());
    for (const auto &[dof, line] : lines)
    {
      all.add_line(dof);
      for (const auto &[other, factor] : line)
        if (std::abs(factor) > no_entry)
          all.add_entry(dof, other, factor);
    }
    all.close();
    constraints = std::move(all);
  }
} // namespace vibrocontact

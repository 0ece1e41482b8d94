#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/attached_points.h>
#include <vibrocontact/fe/own_faces.h>
#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Dof = types::global_dof_index;
    using RigidRow = std::array<double, 6>;

    /// A node of a group: dofs along x, y, z, place, and of each dof what it follows already.
    struct RigidNode
    {
      std::array<Dof, 3> dofs;
      Point<3> place;
      std::array<bool, 3> constrained;
      std::vector<Dof> leaders;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &dofs &place &constrained &leaders;
      }
    };

    /// By the dof along x, the same on all ranks.
    std::map<Dof, RigidNode> rigid_nodes_of(const ElasticBody<3> &body, const PointMass &mass)
    {
      std::map<Dof, RigidNode> own;
      const FiniteElement<3> &scalar = body.element.base_element(0);
      const std::vector<Point<3>> points = scalar_node_points<3>(scalar);
      FEValues<3> values(body.mapping, scalar, Quadrature<3>(points), update_quadrature_points);
      std::vector<Dof> dofs(body.element.n_dofs_per_cell());
      for (const auto &[cell, f] : own_faces(body.dof_handler, mass.boundaries))
      {
        values.reinit(typename Triangulation<3>::active_cell_iterator(cell));
        cell->get_dof_indices(dofs);
        for (unsigned int k = 0; k < points.size(); ++k)
        {
          if (!lies_on_face<3>(body.element.reference_cell(), f, points[k]))
            continue;
          RigidNode node;
          node.place = values.quadrature_point(k);
          for (unsigned int d = 0; d < 3; ++d)
          {
            node.dofs[d] = dofs[body.element.component_to_system_index(d, k)];
            node.constrained[d] = body.constraints.is_constrained(node.dofs[d]);
            if (!node.constrained[d])
              continue;
            const auto &entries = *body.constraints.get_constraint_entries(node.dofs[d]);
            // what is held follows nothing; marked as a leader that no group has
            if (entries.empty())
              node.leaders.push_back(numbers::invalid_dof_index);
            for (const auto &entry : entries)
              node.leaders.push_back(entry.first);
          }
          own[node.dofs[0]] = node;
        }
      }
      std::map<Dof, RigidNode> all;
      for (const auto &one : Utilities::MPI::all_gather(body.communicator(), own))
        all.insert(one.begin(), one.end());
      return all;
    }

    /// Motion of a dof under translations and rotations about the centroid, these times a length.
    RigidRow motion_of(const RigidNode &node, const unsigned int d, const Point<3> &centre,
                       const double length)
    {
      const Tensor<1, 3> r = (node.place - centre) / length;
      RigidRow row = {};
      row[d] = 1;
      const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
      // (theta x r)_d = theta_e r_f - theta_f r_e
      row[3 + e] = r[f];
      row[3 + f] = -r[e];
      return row;
    }

    double product_of_rows(const RigidRow &a, const RigidRow &b)
    {
      double sum = 0;
      for (unsigned int p = 0; p < 6; ++p)
        sum += a[p] * b[p];
      return sum;
    }

    /// Six dofs whose motions are as far from each other as those of any: the largest row left, six times.
    std::vector<unsigned int> choose_masters(std::vector<RigidRow> rows)
    {
      std::vector<unsigned int> chosen;
      for (unsigned int step = 0; step < 6; ++step)
      {
        unsigned int best = 0;
        for (unsigned int k = 1; k < rows.size(); ++k)
          if (product_of_rows(rows[k], rows[k]) > (1 + 1e-9) * product_of_rows(rows[best], rows[best]))
            best = k;
        const RigidRow way = rows[best];
        const double square = product_of_rows(way, way);
        if (!(square > 1e-12))
          break;
        chosen.push_back(best);
        for (RigidRow &row : rows)
        {
          const double share = product_of_rows(row, way) / square;
          for (unsigned int p = 0; p < 6; ++p)
            row[p] -= share * way[p];
        }
      }
      return chosen;
    }

    using RigidLines = std::map<Dof, std::vector<std::pair<Dof, double>>>;

    /// RigidLines of one group, which all its free dofs but six get.
    void add_rigid_lines(const std::string &body, const PointMass &mass,
                         const std::map<Dof, RigidNode> &nodes, const std::set<Dof> &led, RigidLines &lines)
    {
      std::set<Dof> own;
      Point<3> centre;
      for (const auto &named : nodes)
      {
        own.insert(named.second.dofs.begin(), named.second.dofs.end());
        centre += named.second.place / double(nodes.size());
      }
      const std::string where = body + "/Mesh/Mass/" + mass.name + "/Groups";
      unsigned int n_bound = 0;
      Point<3> first;
      double length = 0;
      for (const auto &named : nodes)
      {
        const RigidNode &node = named.second;
        length = std::max(length, node.place.distance(centre));
        // a node that hangs between others of the group moves with them
        bool bound = std::any_of(node.leaders.begin(), node.leaders.end(),
                                 [&](const Dof leader) { return own.count(leader) == 0; });
        for (const Dof dof : node.dofs)
          bound = bound || led.count(dof) > 0;
        if (bound && n_bound++ == 0)
          first = node.place;
      }
      if (n_bound > 0)
        throw InputError(where + ": " + std::to_string(n_bound) +
                         " nodes of what is to be rigid are held, glued, rigid with another mass, or hang "
                         "between nodes beside it, the first at (" +
                         number_text(first[0]) + ", " + number_text(first[1]) + ", " + number_text(first[2]) +
                         ") m: take faces there out of the groups, join masses on one group into one, or set "
                         "Rigid to false.");
      std::vector<RigidRow> rows;
      std::vector<Dof> dofs;
      for (const auto &named : nodes)
        for (unsigned int d = 0; d < 3; ++d)
          if (!named.second.constrained[d])
          {
            rows.push_back(motion_of(named.second, d, centre, length));
            dofs.push_back(named.second.dofs[d]);
          }
      const std::vector<unsigned int> masters = choose_masters(rows);
      AssertThrow(masters.size() == 6, ExcMessage(where + " has its nodes on one line."));
      FullMatrix<double> of_masters(6, 6), inverse(6, 6);
      for (unsigned int k = 0; k < 6; ++k)
        for (unsigned int p = 0; p < 6; ++p)
          of_masters(k, p) = rows[masters[k]][p];
      inverse.invert(of_masters);
      for (unsigned int k = 0; k < rows.size(); ++k)
      {
        if (std::count(masters.begin(), masters.end(), k) > 0)
          continue;
        auto &line = lines[dofs[k]];
        for (unsigned int j = 0; j < 6; ++j)
        {
          double factor = 0;
          for (unsigned int p = 0; p < 6; ++p)
            factor += rows[k][p] * inverse(p, j);
          if (std::abs(factor) > 1e-14)
            line.emplace_back(dofs[masters[j]], factor);
        }
      }
      run_log().line(body + ": " + std::to_string(nodes.size()) + " nodes are rigid with the mass " +
                     mass.name);
    }
  } // namespace

  void hold_rigid_groups(ElasticBody<3> &body)
  {
    RigidLines lines;
    std::set<Dof> led;
    for (const PointMass &mass : body.model.masses)
    {
      if (!mass.rigid)
        continue;
      const std::map<Dof, RigidNode> nodes = rigid_nodes_of(body, mass);
      add_rigid_lines(body.mesh.name, mass, nodes, led, lines);
      for (const auto &named : nodes)
        led.insert(named.second.dofs.begin(), named.second.dofs.end());
    }
    if (lines.empty())
      return;
    IndexSet relevant = body.locally_relevant;
    for (const auto &[dof, line] : lines)
    {
      relevant.add_index(dof);
      for (const auto &entry : line)
        relevant.add_index(entry.first);
    }
    AffineConstraints<double> all(relevant);
    for (const auto &line : body.constraints.get_lines())
    {
      all.add_line(line.index);
      all.add_entries(line.index, line.entries);
    }
    for (const auto &[dof, line] : lines)
    {
      all.add_line(dof);
      all.add_entries(dof, line);
    }
    all.close();
    body.locally_relevant = relevant;
    body.constraints = std::move(all);
  }
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/revolved_section.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    TraceRow merged(const std::map<types::global_dof_index, double> &weights,
                    const AffineConstraints<double> &constraints)
    {
      std::map<types::global_dof_index, double> free;
      for (const auto &[dof, weight] : weights)
        if (!constraints.is_constrained(dof))
          free[dof] += weight;
        else
          for (const auto &[other, factor] : *constraints.get_constraint_entries(dof))
            free[other] += factor * weight;
      return {free.begin(), free.end()};
    }
  } // namespace

  std::array<TraceRow, 3> RevolvedSection::node(const Point<2> &place, const std::string &what) const
  {
    const AffineConstraints<double> constraints = this->constraints(0);
    std::array<double, 3> distance;
    distance.fill(1e300);
    std::array<TraceRow, 3> result;
    double size = 0;
    for (unsigned int dof = 0; dof < n_dofs(); ++dof)
    {
      size = std::max(size, places[dof][1]);
      const double d = places[dof].distance(place);
      if (constraints.is_constrained(dof) || d >= distance[directions[dof]])
        continue;
      distance[directions[dof]] = d;
      result[directions[dof]] = {{dof, 1.}};
    }
    if (distance[axial] > 0.05 * size)
      throw InputError(what + " is " + number_text(distance[axial]) + " m away from the nearest node of " +
                       name + " that can move; give a place on the body.");
    run_log().line(what + ": nearest node " + number_text(1e3 * distance[axial]) + " mm away");
    return result;
  }

  TraceRow RevolvedSection::mean_over(const types::boundary_id boundary, const double low, const double high,
                                      const Component component, const std::string &what) const
  {
    std::map<types::global_dof_index, double> weights;
    std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
    double covered = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary() || cell->face(f)->boundary_id() != boundary)
          continue;
        const double from = cell->face(f)->vertex(0)[0], span = cell->face(f)->vertex(1)[0] - from;
        double s_0 = (low - from) / span, s_1 = (high - from) / span;
        if (s_0 > s_1)
          std::swap(s_0, s_1);
        s_0 = std::max(s_0, 0.);
        s_1 = std::min(s_1, 1.);
        if (!(s_1 - s_0 > 1e-9))
          continue;
        const QGauss<1> gauss(element.degree + 1);
        std::vector<Point<1>> points;
        for (const Point<1> &p : gauss.get_points())
          points.emplace_back(s_0 + (s_1 - s_0) * p[0]);
        FEFaceValues<2> values(mapping, element, Quadrature<1>(points, gauss.get_weights()), update_values);
        values.reinit(cell, f);
        cell->get_dof_indices(dofs);
        covered += std::abs(span) * (s_1 - s_0);
        for (unsigned int k = 0; k < dofs.size(); ++k)
          if (element.system_to_component_index(k).first == component)
            for (unsigned int q = 0; q < points.size(); ++q)
              if (const double N = values.shape_value(k, q); std::abs(N) > 1e-14)
                weights[dofs[k]] += std::abs(span) * (s_1 - s_0) * gauss.weight(q) * N;
      }
    if (!(covered > (high - low) * (1 - 1e-6)))
      throw InputError(
          what + " leaves the tread of body " + name + " between y = " + number_text(1e3 * low) + " and " +
          number_text(1e3 * high) +
          " mm of its section; make it smaller or move it (the contact by Contact/Lateral position).");
    for (auto &weight : weights)
      weight.second /= covered;
    return merged(weights, constraints(0));
  }

  RevolvedSection::Boundary RevolvedSection::boundary(const unsigned int n) const
  {
    const AffineConstraints<double> constraints = this->constraints(n);
    Boundary result;
    std::map<unsigned int, unsigned int> number_of;
    const auto point =
        [&](const typename DoFHandler<2>::active_cell_iterator &cell, const unsigned int vertex)
    {
      const auto [at, is_new] = number_of.emplace(cell->vertex_index(vertex), result.points.size());
      if (is_new)
      {
        result.points.push_back(places[cell->vertex_dof_index(vertex, 0)]);
        for (unsigned int c = 0; c < 3; ++c)
          result.rows.push_back(merged({{cell->vertex_dof_index(vertex, c), 1.}}, constraints));
      }
      return at->second;
    };
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          std::array<unsigned int, 2> edge;
          for (unsigned int v = 0; v < 2; ++v)
            edge[v] = point(cell, GeometryInfo<2>::face_to_cell_vertices(f, v));
          result.edges.push_back(edge);
        }
    return result;
  }
} // namespace vibrocontact

#pragma once

#include <vibrocontact/scene/contact_grid.h>

#include <utility>
#include <vector>

namespace vibrocontact
{
  /// Quadrature points of all contact cells: point, then sub-cell point.
  struct GridQuadrature
  {
    GridQuadrature(const ContactGrid &grid, const unsigned int n_sub_x, const unsigned int n_sub_y,
                   const unsigned int n_gauss)
        : grid(grid), x(n_sub_x, n_gauss), y(n_sub_y, n_gauss)
    {
    }
    unsigned int n_per_cell() const { return x.size() * y.size(); }
    double weight(const unsigned int k) const { return x.weights[k % x.size()] * y.weights[k / x.size()]; }
    double px(const unsigned int i, const unsigned int k) const
    {
      return grid.x(i) + (x.points[k % x.size()] - 0.5) * grid.spacing_x;
    }
    double py(const unsigned int i, const unsigned int k) const
    {
      return grid.y(i) + (y.points[k / x.size()] - 0.5) * grid.spacing_y;
    }

    /// Points whose traction reaches this quadrature point, with its value there; they sum to one.
    std::vector<std::pair<unsigned int, double>> tractions(const unsigned int point,
                                                           const unsigned int k) const;

  private:
    struct Line
    {
      Line(const unsigned int n_sub, const unsigned int n_gauss);
      unsigned int size() const { return points.size(); }
      std::vector<double> points, weights;
    };
    const ContactGrid &grid;
    const Line x, y;
  };
} // namespace vibrocontact

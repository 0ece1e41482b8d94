#include <vibrocontact/fe/grid_quadrature.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace vibrocontact
{
  GridQuadrature::Line::Line(const unsigned int n_sub, const unsigned int n_gauss)
  {
    const dealii::QGauss<1> gauss(n_gauss);
    for (unsigned int s = 0; s < n_sub; ++s)
      for (unsigned int q = 0; q < n_gauss; ++q)
      {
        points.push_back((s + gauss.point(q)[0]) / n_sub);
        weights.push_back(gauss.weight(q) / n_sub);
      }
  }

  std::vector<std::pair<unsigned int, double>> GridQuadrature::tractions(const unsigned int point,
                                                                         const unsigned int k) const
  {
    if (grid.traction == TractionShape::constant)
      return {{point, 1.}};
    // A hat that would stand outside the grid leaves its share to the point itself.
    const auto share = [](const double offset, const unsigned int index, const unsigned int size)
    {
      const int other = int(index) + (offset < 0 ? -1 : 1);
      const bool inside = other >= 0 && other < int(size);
      return std::make_pair(inside ? std::abs(offset) : 0., inside ? unsigned(other) : index);
    };
    const unsigned int i = point % grid.n_x, j = point / grid.n_x;
    const auto [wx, ix] = share(x.points[k % x.size()] - 0.5, i, grid.n_x);
    const auto [wy, jy] = share(y.points[k / x.size()] - 0.5, j, grid.n_y);
    return {{point, (1 - wx) * (1 - wy)},
            {grid.index(ix, j), wx * (1 - wy)},
            {grid.index(i, jy), (1 - wx) * wy},
            {grid.index(ix, jy), wx * wy}};
  }
} // namespace vibrocontact

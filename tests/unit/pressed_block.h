/// A rectangle of points on two half-spaces in time steps, shared by the tests of Newton's method.
#pragma once

#include <vibrocontact/contact/half_space.h>

#include <memory>

namespace pressed_block
{
  using namespace vibrocontact;

  /// 1 mm apart; slips are displacements over a step of 1e-4 s
  inline std::shared_ptr<const ContactOperator> response(const unsigned int n_x, const unsigned int n_y)
  {
    ContactGrid grid;
    grid.n_x = n_x;
    grid.n_y = n_y;
    grid.spacing_x = grid.spacing_y = 1e-3;
    DenseMatrix A = half_space_compliance(grid, {{210e9, 0.3}, {70e9, 0.33}});
    const unsigned int n = grid.n_points();
    for (unsigned int j = 0; j < 3 * n; ++j)
      for (unsigned int i = n; i < 3 * n; ++i)
        A(i, j) *= 1e4;
    return std::make_shared<DenseContactOperator>(std::move(A));
  }
} // namespace pressed_block

#pragma once

// A box of distorted cells, and what its stiffness makes of a displacement with constant strain (the patch test).

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/second_order_system.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrocontact
{
  const std::array<double, 3> sizes_of_distorted_box = {{0.3, 0.2, 0.1}};

  /// The box 0.3 x 0.2 x 0.1 m, distorted inside; its corner lies at the origin.
  inline dealii::Point<3> distorted_in_box(const dealii::Point<3> &p)
  {
    using dealii::numbers::PI;
    const double bump = std::sin(PI * p[0]) * std::sin(PI * p[1]) * std::sin(PI * p[2]);
    return {0.3 * (p[0] + 0.10 * bump), 0.2 * (p[1] - 0.08 * bump), 0.1 * (p[2] + 0.07 * bump)};
  }

  struct ConstantStrain
  {
    dealii::PETScWrappers::MPI::Vector displacement, force;
    /// dofs inside the box
    unsigned int n_inner = 0;
    /// largest force on them, which is zero if the strain is constant in every cell, over the largest of all
    double residual = 0;
  };

  /// u = gradient x on a free body of that shape. Collective.
  inline ConstantStrain constant_strain(const ElasticBody<3> &body, const SecondOrderSystem &system,
                                        const dealii::Tensor<2, 3> &gradient)
  {
    ConstantStrain result;
    result.displacement.reinit(body.locally_owned, body.communicator());
    result.force.reinit(body.locally_owned, body.communicator());
    for (unsigned int i = 0; i < system.dof_position.size(); ++i)
      result.displacement(body.locally_owned.nth_index_in_set(i)) =
          gradient[system.dof_direction[i]] * dealii::Tensor<1, 3>(system.dof_position[i]);
    result.displacement.compress(dealii::VectorOperation::insert);
    system.stiffness.vmult(result.force, result.displacement);
    double inner = 0;
    for (unsigned int i = 0; i < system.dof_position.size(); ++i)
    {
      bool inside = true;
      for (unsigned int d = 0; d < 3; ++d)
        inside = inside && system.dof_position[i][d] > 1e-9 &&
                 system.dof_position[i][d] < sizes_of_distorted_box[d] - 1e-9;
      result.n_inner += inside;
      if (inside)
        inner = std::max(inner, std::abs(double(result.force(body.locally_owned.nth_index_in_set(i)))));
    }
    result.n_inner = dealii::Utilities::MPI::sum(result.n_inner, body.communicator());
    result.residual = dealii::Utilities::MPI::max(inner, body.communicator()) / result.force.linfty_norm();
    return result;
  }
} // namespace vibrocontact

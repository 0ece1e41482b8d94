#pragma once

#include <vibrocontact/fe/elastic_body.h>

#include <array>
#include <map>

namespace vibrocontact
{
  /// Mean motion of parts of a body's boundary, as rows over its unconstrained dofs: translation of the centroid and rotation.
  struct GroupMotion
  {
    dealii::Point<3> centroid;
    /// int r r^T dA and int |r|^2 - r r^T dA, r the way from the centroid [m^4]
    dealii::Tensor<2, 3> second_moment, turning;
    /// of each dof, its part in translation [-] and rotation [1/m]; in ascending order, on all ranks
    std::map<dealii::types::global_dof_index, std::array<double, 6>> rows;
  };

  /// @throws InputError where no face is, and for more dofs than fit into a dense block of the matrices. Collective.
  GroupMotion group_motion(const ElasticBody<3> &body, const PointMass &mass);
} // namespace vibrocontact

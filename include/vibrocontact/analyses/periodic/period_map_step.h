#pragma once

#include <vibrocontact/analyses/periodic/period_map.h>

namespace vibrocontact
{
  /// Answers over a contact step of one length.
  struct PeriodMap::Step
  {
    double length;
    /// at the Gauss points
    std::vector<ForceAnswer> nodes;
    ForceAnswer end;
    /// drive at the Gauss points by state, s x n_states [1]; by force, s square [m/N]; for linear laws the forces by
    /// the drive
    DenseMatrix by_state, by_force, inverse;
    /// state at the end by force (subtracted), n_states x s
    DenseMatrix state_by_force;
  };
} // namespace vibrocontact

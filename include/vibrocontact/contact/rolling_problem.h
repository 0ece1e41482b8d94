#pragma once

#include <vibrocontact/contact/contact_problem.h>
#include <vibrocontact/contact/creep.h>

namespace vibrocontact
{
  /// Two half-spaces in steady rolling (what CONTACT models): gap = height_1 - height_2 of the undeformed
  /// surfaces, n values [m].
  ContactProblem half_space_rolling_problem(const ContactGrid &grid, const HalfSpacePair &pair,
                                            const CreepScheme &scheme, const Creepage &creepage,
                                            const std::vector<double> &gap, double friction);

  /// Any two bodies in steady rolling: compliance is the sum of both bodies' contact compliances, 3 n square
  /// [m/N] (errata: A_n = (P_c K^-1 P_c^T)_n, A_t = V d/dx (P_c K^-1 P_c^T)_t).
  ContactProblem rolling_problem(const ContactGrid &grid, DenseMatrix compliance, const CreepScheme &scheme,
                                 const Creepage &creepage, const std::vector<double> &gap, double friction);
} // namespace vibrocontact

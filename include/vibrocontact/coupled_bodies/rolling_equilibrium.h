#pragma once

#include <vibrocontact/contact/contact_problem.h>

#include <vector>

namespace vibrocontact
{
  /// A rolling equilibrium and what its slip depends on.
  struct RollingEquilibrium
  {
    /// R and y = (gap, slip) by contact_row(), status
    ContactSolution contact;
    /// mu of each point at its slip; n
    std::vector<double> friction;
    /// V [m/s]
    double speed = 0;
    /// the normal force is given, so that the approach moves and sum dN = 0; otherwise the hub is fixed
    bool force_given = false;
    /// dmu/d|s| of each point, n [s/m]; empty: friction is constant
    std::vector<double> friction_slope;
    /// d'(N) of each point by the normal law, n [m/N]; empty: the law is rigid
    std::vector<double> normal_compliance;
  };

  /// The equilibrium with the tangents of the contact's laws.
  RollingEquilibrium rolling_equilibrium(const ContactSolution &contact,
                                         const PointLaws<FrictionLaw> &friction,
                                         const PointLaws<NormalLaw> &normal, double speed, bool force_given);
} // namespace vibrocontact

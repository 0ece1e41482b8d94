#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// A straight bar along z that only stretches: E S u'' = rho S u_tt, its contact end in the plane z = 0.
  ///
  ///     z ^   | far end          body 1 stands above the plane, body 2 below it
  ///       |   |
  ///       +   o contact end
  struct BarParameters
  {
    /// [m], [m^2]
    double length = 1, section = 1e-4;
    /// elements along the bar and their polynomial degree
    unsigned int divisions = 20, degree = 3;
    /// "free" or "held"
    std::string far_end = "held";
    /// M = s M_consistent + (1 - s) M_lumped (row sums). Two-node elements of length h carry waves of wave number k at the
    /// frequency c k (1 + (2 s - 1) (k h)^2 / 24), which the theta method with steps dt lowers by (c k dt)^2 / 12: both
    /// cancel for s = 1/2 + (c dt / h)^2, at c dt = h to all orders (one-point integration of the mass)
    double consistent_mass = 1;
    /// the mass of the contact element goes to its inner node, so that the contact end has none: forces of rigid contact
    /// then converge (doc/theory.md, "Periodic motion")
    bool massless_contact_node = false;

    void declare_parameters(dealii::ParameterHandler &prm);
    void check(const std::string &section) const;
  };
} // namespace vibrocontact

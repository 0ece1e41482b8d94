#pragma once

#include <vibrocontact/scene/section.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A wheel's web made thicker or thinner without another drawing: the points of its section move along the axle, away from
  /// the middle of the web, while its cells stay what they are,
  ///
  ///     a -> a + change bump(r) (a - middle(r)) / thickness(r),     bump(r) = sin^2(pi (r - r_1) / (r_2 - r_1))
  ///
  /// between two radii. The web is thicker by `change` half way between them; at both, change and slope are 0. Frequencies,
  /// growth and receptances are smooth in it, so that they have a derivative to it (run/varied_cases.h).
  struct WebThickness
  {
    /// [m]
    double change = 0;
    /// r_1, r_2 [m]; empty: those of the section that comes with the program
    std::vector<double> radii;

    /// Entries `Web thickness change`, `Web radii`.
    void declare_parameters(dealii::ParameterHandler &prm);
    /// By how much a point (a, r) of the section moves [m]; null: the web is as drawn.
    /// @param usual radii if none are given; empty: there are none
    /// @param where section of the entries, for messages
    /// @throws InputError unless the outline has one web between the radii, and keeps it
    std::function<dealii::Point<2>(const dealii::Point<2> &)>
    motion(const SectionOutline &outline, const std::vector<double> &usual, const std::string &where) const;
  };
} // namespace vibrocontact

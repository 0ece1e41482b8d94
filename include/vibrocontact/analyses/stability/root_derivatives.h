#pragma once

#include <vibrocontact/run/analysis.h>

#include <memory>
#include <optional>

namespace vibrocontact
{
  /// Section Stability/Derivatives, about the first case of section Rolling: of the roots that grow and the three nearest to that
  ///
  ///   ds/dp = - y^T (dF/dp) x,     y^T F = 0,  F x = 0,  y^T F'(s) x = 1
  ///
  /// with dF/dp the central difference of the contact's own equations at fixed s, equilibrium and reductions of the bodies
  /// included (run/varied_cases.h), and beside it the difference of the roots themselves, followed into both cases:
  /// stability_derivatives.csv.
  ///
  /// With standard deviations sigma_i of the entries the growth scatters to first order by
  /// sqrt(sum of (d growth/dp_i sigma_i)^2); beside it mean, deviation and share of growing roots of the draws, in each of which
  /// the roots are followed: stability_scatter.csv, stability_draws.csv.
  ///
  /// `on.sweep` are varied_cases().
  std::unique_ptr<SweptAnalysis> root_derivatives(const AnalysisRun &on);

  /// What section Stability/Derivatives varies; none if it lists no entry. @throws InputError beside Stability/Sweep
  std::optional<Variations> variations_of_roots(const Parameters &parameters);
} // namespace vibrocontact

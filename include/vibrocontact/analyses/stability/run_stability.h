#pragma once

#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Of the roots that are unstable, of the nearest one if none is [Hz].
  std::vector<double> frequencies_that_matter(const StabilityResult &result);

  /// Doubts roots that grow beyond what the modes kept carry (StabilityResult::modes_reach).
  void judge_reach_of_modes(const std::vector<StabilityResult> &all, Results &results);

  /// The analysis `stability` of body 1 on body 2 with its output: results and stability.csv, a row per root.
  /// Every rank computes, rank 0 writes. Collective.
  void run_stability(const Parameters &parameters, const MeshedBodies &bodies,
                     const std::optional<MeasuredData> &measured, const std::string &folder,
                     Results &results);

  /// The same for each case of a sweep, with stability_sweep.csv and stability_map.csv: roots keep their names along the
  /// sweep. A case without an equilibrium in full sliding, or with a contact that reaches the edge of its grid, is left
  /// out and said; one that does not converge makes the run not converged.
  std::unique_ptr<SweptAnalysis> swept_stability(const AnalysisRun &on);

  /// Its row of the table of analyses.
  Analysis stability_analysis();
} // namespace vibrocontact

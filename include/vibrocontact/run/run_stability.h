#pragma once

#include <vibrocontact/analyses/stability.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/prepare_bodies.h>
#include <vibrocontact/run/stability_cases.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Of the roots that are unstable, of the nearest one if none is [Hz].
  std::vector<double> frequencies_that_matter(const StabilityResult &result);

  /// The analysis `stability` of body 1 on body 2 with its output: results and stability.csv, a row per root.
  /// Every rank computes, rank 0 writes. Collective.
  void run_stability(const Parameters &parameters, const MeshedBodies &bodies, const std::string &folder,
                     Results &results);

  /// The same for each case of a sweep, with stability_sweep.csv and stability_map.csv: bodies whose keys are
  /// equal are reduced once, roots keep their names along the sweep. A case without an equilibrium in full
  /// sliding, or with a contact that reaches the edge of its grid, is left out and said; one that does not
  /// converge makes the run not converged. Collective.
  /// @param save called after each case
  /// @throws InputError if no case is left
  void run_stability_sweep(const StabilityCases &sweep, const MeshedBodies &bodies, const std::string &folder,
                           Results &results, const std::function<void()> &save);

  /// Its row of the table of analyses.
  Analysis stability_analysis();
} // namespace vibrocontact

#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <functional>
#include <string>

namespace vibrocontact
{
  /// The analysis `quasi-static loading` of body 1 on body 2 with its output: results, loading.csv, loading_patch_<step>.csv. The
  /// bodies' contact compliance is computed first if it is not cached.
  ///
  /// Every rank goes through all steps, which gives the same numbers on all; rank 0 writes. Collective.
  /// @param save called when the bodies are reduced and after each step
  void run_loading(const Parameters &parameters, const MeshedBodies &bodies,
                   const std::optional<MeasuredData> &measured, const std::string &folder, Results &results,
                   const std::function<void()> &save);

  /// Its row of the table of analyses.
  Analysis loading_analysis();
} // namespace vibrocontact

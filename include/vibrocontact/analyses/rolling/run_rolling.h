#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <functional>
#include <string>

namespace vibrocontact
{
  /// The analysis `quasi-static rolling` of body 1 on body 2 with its output: results, rolling.csv and for
  /// each case contact_patch_<k>.csv and what `Output` asks for. The bodies' contact compliance is computed
  /// first if it is not cached.
  ///
  /// Every rank solves every case, since that is cheap (milliseconds) and gives the same numbers on all;
  /// rank 0 writes. Collective.
  /// @param save called when the bodies are reduced and after each case
  /// @return the last case
  RollingResult run_rolling(const Parameters &parameters, const MeshedBodies &bodies,
                            const std::optional<MeasuredData> &measured, const std::string &folder,
                            Results &results, const std::function<void()> &save);

  /// Deformation and stress of the meshed bodies under the contact forces of a case; of bodies whose
  /// reduction came from the cache only with Output/Deformation = always, since they have to be factorised for it. Collective.
  void write_deformation(const RollingResult &result, const Parameters &parameters,
                         const MeshedBodies &bodies, const std::string &folder);

  /// Its row of the table of analyses.
  Analysis rolling_analysis();
} // namespace vibrocontact

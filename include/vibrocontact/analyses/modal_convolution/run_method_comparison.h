#pragma once

#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <nlohmann/json.hpp>

#include <string>

namespace vibrocontact
{
  /// Every propagator on the bodies that have `Comparison/Rows`, each on its road: method_comparison.csv, and what
  /// results.json shows as `method_comparison[]`: `body`, `method`, `step_s`, `steps`, `memory_steps`,
  /// `error_displacement_m`, `error_force_N`, `error_impulse` (in their place `broke_down` if a method ends without
  /// finite numbers), `seconds_per_step`. Collective.
  nlohmann::ordered_json run_method_comparison(const Parameters &parameters, const MeshedBodies &bodies,
                                               const std::optional<MeasuredData> &measured,
                                               const std::string &folder);
} // namespace vibrocontact

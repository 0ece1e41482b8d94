#pragma once

#include <vibrocontact/base/table.h>
#include <vibrocontact/coupled_bodies/quasi_static_loading.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// One entry of analyses.quasi_static_loading.steps[] in results.json.
  nlohmann::ordered_json loading_step_json(const LoadHistory::Step &step, const LoadedState &state,
                                           const ContactInterface &interface);
  /// The same of contact k alone, in its own frame.
  nlohmann::ordered_json loading_step_json(const LoadedState &state, const ContactInterface &interface,
                                           unsigned int k);
  /// What the object has beside its steps: the end, energies and errors.
  nlohmann::ordered_json loading_json(const LoadHistory &history, const LoadingResult &result);

  /// All steps, a row each: loading.csv.
  Table loading_table(const nlohmann::ordered_json &steps);
  /// The patch of contact k after a step, a row per grid point: loading_patch_<step>.csv.
  Table loading_patch_table(const LoadedContact &contact, const PlacedContacts &contacts, unsigned int k);

  /// What the terminal ends with about analyses.quasi_static_loading of results.json, see Answer.
  std::vector<std::string> loading_answer(const nlohmann::ordered_json &loading);
} // namespace vibrocontact

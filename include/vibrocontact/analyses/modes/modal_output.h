#pragma once

#include <vibrocontact/analyses/modes/modal.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// analyses.modes.<body> in results.json.
  nlohmann::ordered_json modal_json(const ModalResult &result);

  /// Frequencies, damping and labels of a body: modes_<body>.csv.
  Table modal_table(const ModalResult &result);

  /// What the terminal ends with about analyses.modes of results.json, see Answer.
  std::vector<std::string> modes_answer(const nlohmann::ordered_json &bodies);
} // namespace vibrocontact

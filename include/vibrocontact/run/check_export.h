#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// Whether the analysis `export` writes a body: it has elements and modes.
  bool is_exported(const Parameters &parameters, const BodyParameters &body);

  /// What exported matrices cannot hold is refused before anything is computed: loads, several contacts, a wheel that turns.
  /// @throws InputError
  void check_export(const Parameters &parameters);
} // namespace vibrocontact

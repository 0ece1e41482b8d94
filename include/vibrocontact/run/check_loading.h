#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// Section Loading against bodies and contacts. @throws InputError
  void check_loading(const Parameters &parameters);
  /// Its history, of the lists or the table, against what friction bears. Collective. @throws InputError
  void check_load_history(const Parameters &parameters);
  /// What --check says of it: steps, what is given, and what they cost. Collective.
  void print_load_history(const Parameters &parameters);
} // namespace vibrocontact

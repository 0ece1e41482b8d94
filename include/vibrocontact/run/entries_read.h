#pragma once

#include <vibrocontact/run/entry_list.h>
#include <vibrocontact/run/parameters.h>

#include <string>

namespace vibrocontact
{
  /// What an analysis of analysis_types() reads with these parameters, whether it is listed or not. Whoever adds
  /// an entry adds it here, in entries_read.cc, or for a body in entries_of_bodies.cc.
  EntriesRead entries_read(const std::string &analysis, const Parameters &parameters);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <string>

namespace vibrocontact
{
  /// The analysis `transient` of body 1 on body 2 with its output: results and histories.h5. The bodies are
  /// reduced first if they are not cached. Every rank steps (the reduced problem is small and gives the same
  /// numbers on all), rank 0 writes. Collective.
  void run_transient(const Parameters &parameters, const MeshedBodies &bodies, const std::string &folder,
                     Results &results);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <string>

namespace vibrocontact
{
  /// The analysis `stability` of body 1 on body 2 with its output: results and stability.csv, a row per root.
  /// Every rank computes, rank 0 writes. Collective.
  void run_stability(const Parameters &parameters, const MeshedBodies &bodies, const std::string &folder,
                     Results &results);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <string>

namespace vibrocontact
{
  /// The analysis `transient` of body 1 on body 2 with its output: results and histories.h5. The bodies are
  /// reduced first if they are not cached. Every rank steps (the reduced problem is small and gives the same
  /// numbers on all), rank 0 writes. Collective.
  ///
  /// Checkpoints (marching/march_checkpoint.h) are written every Transient/Checkpoint interval, when SIGTERM or SIGINT
  /// comes, which stops the run (Results::stopped_by), and at the end, from where a later End time may
  /// continue.
  /// @param recorders beside the shipped ones
  /// @param resume continue from the checkpoint in the folder; from the beginning if there is none
  void run_transient(const Parameters &parameters, const MeshedBodies &bodies,
                     const std::optional<MeasuredData> &measured, const std::string &folder, bool resume,
                     Results &results, const std::vector<RecorderMaker> &recorders);

  /// Its row of the table of analyses.
  Analysis transient_analysis();
} // namespace vibrocontact

#pragma once

#include <vibrocontact/marching/march_checkpoint.h>
#include <vibrocontact/output/results.h>

#include <string>

namespace vibrocontact
{
  /// Says where the march goes on. Collective. @param name of the analysis
  /// @return false: at its beginning, there is no checkpoint
  /// @throws InputError, see MarchCheckpoint::read()
  bool resume_march(const std::string &name, March &march, const MarchCheckpoint &checkpoint,
                    const Recorders &recorders);

  /// The march from where it is to its end, to a signal or until a step does not converge. Every rank steps, rank 0
  /// writes. A checkpoint is written between two blocks every `interval` of wall time [s] (0: never), after blocks of more
  /// than a second (CheckpointSchedule), at a signal and at the end, from where a later End time may continue. A march that fails keeps the last one. Then the recorders
  /// finish their files. Collective.
  /// @param name of the analysis
  /// @param results learn of the signal and of a failure
  /// @return whether it came to its end
  bool run_march(const std::string &name, March &march, const MarchCheckpoint &checkpoint, double interval,
                 const Recorders &recorders, Results &results);
} // namespace vibrocontact

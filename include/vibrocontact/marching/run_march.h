#pragma once

#include <vibrocontact/marching/march_checkpoint.h>

#include <string>

namespace vibrocontact
{
  /// How a march ended.
  struct MarchEnd
  {
    /// at its end time; else it was stopped or failed
    bool is_whole = false;
    /// number of the signal that stopped it, or what would follow it, 0: none
    int stopped_by = 0;
    /// why it could not go on
    std::string failure;
  };

  /// Says where the march goes on. Collective. @return false: at its beginning, there is no checkpoint
  /// @throws InputError, see MarchCheckpoint::read()
  bool resume_march(March &march, const MarchCheckpoint &checkpoint, const Recorders &recorders);

  /// The march from where it is to its end, to a signal or until a step does not converge. Every rank steps, rank 0
  /// writes. A checkpoint is written between two blocks every `interval` of wall time [s] (0: never), at a signal and at
  /// the end, from where a later End time may continue. A march that fails keeps the last one. Then the recorders
  /// finish their files. Collective.
  /// @param name said with the time left
  MarchEnd run_march(const std::string &name, March &march, const MarchCheckpoint &checkpoint,
                     double interval, const Recorders &recorders);
} // namespace vibrocontact

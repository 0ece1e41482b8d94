#pragma once

#include <vibrocontact/analyses/transient/coarse_run.h>
#include <vibrocontact/analyses/transient/contact_stepper.h>
#include <vibrocontact/analyses/transient/recorder.h>
#include <vibrocontact/analyses/transient/transient_result.h>

#include <string>

namespace vibrocontact
{
  /// The transient's checkpoint in the output folder, checkpoint.h5: the state that the next step starts
  /// from, the sums so far, the same of the run with twice the step if there is one, what the recorders need, marks of bodies and modes, by which a resumed run sees
  /// that it has the same ones, and a sum over all of it. Numbers are kept bit for bit; the file appears
  /// whole or not at all, so that a run killed while writing leaves the one before.
  ///
  /// What a solver keeps from step to step (factorisations) is not in it: transient() starts with a fresh
  /// solver every steps_between_fresh_starts, and only there a checkpoint continues bit for bit.

  /// To be called by rank 0. @throws OutputError
  void write_checkpoint(const std::string &folder, const ContactPair &pair, DynamicState &state,
                        TransientResult &result, const Recorders &recorders, CoarseRun *coarse = nullptr);

  /// @throws InputError if there is a checkpoint beyond the end time [s]
  void check_end_time(const std::string &folder, double end_time);

  /// On every rank; recorders on rank 0. @return false: there is no checkpoint
  /// @throws InputError if it is damaged, of another version or of other bodies
  bool read_checkpoint(const std::string &folder, const ContactPair &pair, DynamicState &state,
                       TransientResult &result, const Recorders &recorders, CoarseRun *coarse = nullptr);
} // namespace vibrocontact

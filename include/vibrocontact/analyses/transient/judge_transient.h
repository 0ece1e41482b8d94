#pragma once

#include <vibrocontact/marching/transient_result.h>
#include <vibrocontact/output/results.h>

namespace vibrocontact
{
  /// Says on the screen and in `results` what the steps of a transient did to it: the estimated errors of the
  /// impulse and of the rms normal force (keys estimated_error, estimated_error_rms_force, error_estimate of
  /// analyses.transient) and what the energy account leaves open. Beyond 20 % of error or 5 % of the energy
  /// that there was the transient is a failure, its numbers are kept. So it is where most of the kinetic energy in the second half
  /// of the run is that of modes with fewer than eight steps in a period.
  /// Adapted steps are judged by their own errors; of bodies known by poles nothing is looked at.
  /// @param omega of the modes [rad/s]
  /// @param estimated null: errors were not estimated
  /// @param interrupted by a signal: what is not whole is no failure
  void judge_transient(const TransientResult &result, const std::vector<double> &omega, bool adapts_steps,
                       const StepErrors *estimated, bool interrupted, Results &results);
} // namespace vibrocontact

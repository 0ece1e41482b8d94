#pragma once

#include <vibrocontact/analyses/transient/contact_stepper.h>
#include <vibrocontact/analyses/transient/drive.h>
#include <vibrocontact/analyses/transient/transient_parameters.h>
#include <vibrocontact/analyses/transient/transient_result.h>

namespace vibrocontact
{
  /// The same run again with twice the step, beside the first one: what both differ by tells the error of the
  /// first (numerics/doubled_step.h). All that the next step depends on, for checkpoints.
  struct CoarseRun
  {
    DynamicState state;
    /// `seconds`: the cost of the estimate; not converged: it ended at `time`, for the reason in `message`
    TransientResult sums;
    StepErrors errors;
  };

  /// Parameters of the run with twice the step; of adapted steps all lengths are doubled, and the tolerance
  /// follows the error of a step, which is of third order.
  TransientParameters with_doubled_step(TransientParameters parameters);
} // namespace vibrocontact

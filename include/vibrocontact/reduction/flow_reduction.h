#pragma once

#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/fe/material_flow.h>
#include <vibrocontact/reduction/modes.h>

namespace vibrocontact
{
  /// MaterialFlow in the modes of the body at rest (bodies/rolling_modes.h). @param system with flow. Collective.
  FlowReduction reduce_flow(const SecondOrderSystem &system, Flexibility &flexibility, const Modes &modes);
} // namespace vibrocontact

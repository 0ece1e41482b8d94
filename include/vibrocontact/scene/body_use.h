#pragma once

namespace vibrocontact
{
  /// What an analysis needs of a body, which decides what entries of its section matter.
  struct BodyUse
  {
    /// points of its surface are in contact, its mesh is refined under them
    bool contact = false;
    /// places on it are excited and looked at
    bool points = false;
    /// forces that stand on it: gravity, tractions
    bool loads = false;
    /// it moves by its mass, in kept modes
    bool motion = false;
    /// it loses energy; by modal damping as section Modes scales it
    bool loss = false, scaled_damping = false;
    /// its contact points move along the road
    bool tangential = false;
    /// its own mass weighs on it
    bool heavy = false;
    /// some body of the scene touches in one point only
    bool in_a_point = false;
  };
} // namespace vibrocontact

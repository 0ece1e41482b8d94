#pragma once

#include "random_structure.h"

namespace vibrocontact
{
  /// A random structure of 9 points by 30 of its 90 modes, pressed by the hub or by a force, that slides along both axes.
  struct SlidingStructure
  {
    static constexpr double speed = 0.2;

    explicit SlidingStructure(const bool force_given) : whole(structure(90, 9)), pair(reduce(whole, 30, 2e-3))
    {
      // free columns around the contact
      for (const unsigned int open : {0, 1, 8})
        pair.interface.gap[open] = 1;
      contact.friction = 0.35;
      contact.creep_scheme = "first-order upwind";
      drive = [force_given](double)
      {
        Drive d;
        d.creepage.speed = speed;
        d.creepage.lateral = 0.5;
        d.creepage.longitudinal = 0.1;
        if (force_given)
          d.normal_force = 1500;
        else
          d.approach = 1e-3;
        return d;
      };
    }

    const Structure whole;
    ContactPair pair;
    ContactParameters contact;
    DriveFunction drive;
  };
} // namespace vibrocontact

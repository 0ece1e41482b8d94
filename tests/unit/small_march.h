/// A march of two points, for tests of checkpoints.
#pragma once

#include <vibrocontact/marching/transient_march.h>

namespace vibrocontact
{
  /// Flexibilities as small as they are, 1e-9 m/N, on two points.
  inline ContactPair small_pair(const bool with_mode)
  {
    ContactPair pair;
    pair.interface.contacts.only().n_x = 2;
    pair.interface.gap = {0., 1e-6};
    pair.residual.reinit(6, 6);
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        pair.residual(i, j) = i == j ? 2e-9 : 1e-10;
    if (!with_mode)
      return pair;
    pair.omega = {2000.};
    pair.damping_ratio = {1e-4};
    pair.modal_load = {0.};
    pair.trace.reinit(6, 1);
    pair.trace(0, 0) = 0.03;
    return pair;
  }

  inline TransientMarch march_of(const ContactPair &pair)
  {
    TransientParameters parameters;
    parameters.end_time = 1;
    return {parameters, {}, {}, pair, {}, {}};
  }
} // namespace vibrocontact

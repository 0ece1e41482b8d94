#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>

#include <cmath>
#include <string>

/// A bar of unit length, mass and stiffness (c = 1) held at its upper end, touching with its lower one: n modes of
/// sin((k - 1/2) pi (1 - z)), residual flexibility at the end as given.
inline vibrocontact::ContactPair held_bar(const unsigned int n_modes, const double residual)
{
  vibrocontact::ContactPair pair;
  vibrocontact::ContactGrid &grid = pair.interface.contacts.only();
  grid.n_x = grid.n_y = 1;
  grid.spacing_x = grid.spacing_y = 1;
  pair.interface.gap = {0.};
  pair.trace.reinit(3, n_modes);
  pair.participation.reinit(n_modes, 3);
  for (unsigned int k = 0; k < n_modes; ++k)
  {
    const double omega = (k + 0.5) * M_PI;
    pair.omega.push_back(omega);
    pair.damping_ratio.push_back(0);
    pair.labels.push_back("bar:" + std::to_string(k));
    pair.body.push_back(1);
    pair.modal_load.push_back(0);
    pair.trace(0, k) = std::sqrt(2.) * (k % 2 == 0 ? 1 : -1);
    pair.participation(k, 2) = std::sqrt(2.) / omega;
  }
  pair.residual.reinit(3, 3);
  for (unsigned int i = 0; i < 3; ++i)
    pair.residual(i, i) = residual;
  return pair;
}

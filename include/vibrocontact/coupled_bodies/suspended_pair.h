#pragma once

#include <vibrocontact/coupled_bodies/hub_coordinates.h>
#include <vibrocontact/coupled_bodies/hysteretic_loss.h>

namespace vibrocontact
{
  /// The pair with body 1 on a hub that moves instead of a held one: as many modes more as the hub has coordinates, those of
  /// body 1 first. Modes take the places of those they are most alike.
  /// @param preload forces on the rows of the pair at the equilibrium, which what carries the hub balances; 3 n, empty: none
  /// @param loss of the held pair, becomes that of this one; null: damping ratios are all that damps, which what carries the hub
  /// with a loss factor has as well
  /// @throws InputError if the unsprung mass is less than what the modes of body 1 move
  ContactPair suspended_pair(const ContactPair &held, const HubCoordinates &hub,
                             const DenseVector &preload = {}, HystereticLoss *loss = nullptr);
} // namespace vibrocontact

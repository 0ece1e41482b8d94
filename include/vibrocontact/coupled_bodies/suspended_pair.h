#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>

#include <vector>

namespace vibrocontact
{
  /// The pair with body 1 on a suspended hub instead of a held one: three modes more, those of body 1 first.
  /// @param reaction sum of the forces on body 1 along x, y, z at the equilibrium, which the preload balances
  /// @throws InputError if the unsprung mass is less than what the modes of body 1 move
  ContactPair suspended_pair(const ContactPair &held, const SuspensionParameters &suspension,
                             const std::vector<double> &reaction);
} // namespace vibrocontact

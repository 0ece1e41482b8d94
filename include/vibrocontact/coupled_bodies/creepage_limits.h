#pragma once

namespace vibrocontact
{
  /// Largest size of creepages [-] and spin [1/m], constant or over time.
  constexpr double most_creepage = 1, most_spin = 1000;
} // namespace vibrocontact

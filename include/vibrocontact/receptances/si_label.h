#pragma once

#include <array>
#include <optional>
#include <string>

namespace vibrocontact
{
  /// Powers of kg, m and s.
  using SiPowers = std::array<int, 3>;

  /// What a label of a unit stands for, if it is written in m, s, N, Hz and kg or their English names alone: in small letters
  /// or large ones, with powers as ^2, **2, 2 or a superscript, products by *, a dot, a space or nothing, quotients by /,
  /// brackets. "ms^-2" is m s^-2. Nothing: it is not, as with prefixes ("mm", "ms", "kN").
  std::optional<SiPowers> si_powers(const std::string &label);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/contact/laws/normal_law.h>

namespace vibrocontact
{
  /// One-sided linear spring N = k max(-g, 0). Numbers: amplitude [N] and exponent [1/m] of the exponential penalty, whose
  /// product is k [N/m], the stiffness of that law at touch.
  NormalLawEntry linear_spring();
} // namespace vibrocontact

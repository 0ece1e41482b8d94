#pragma once

#include <string>

namespace vibrocontact
{
  /// Version of the program, e.g. 0.1.0.
  std::string version();
  /// Git commit it was built from (12 digits), with "-dirty" if files differed from it, or "unknown" outside
  /// a checkout.
  std::string commit();
  /// Version of deal.II it runs with.
  std::string dealii_version();
} // namespace vibrocontact

#pragma once

#include <functional>
#include <string>

namespace vibrocontact
{
  /// A function of one variable from an entry of the parameter file, in deal.II's (muparser's) syntax, with
  /// pi.
  /// @param entry path of the entry; @param meaning of the variable and an example, for the message
  /// @throws InputError if it cannot be read
  std::function<double(double)> read_expression(const std::string &expression, const std::string &variable,
                                                const std::string &entry, const std::string &meaning);
} // namespace vibrocontact

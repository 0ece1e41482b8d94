#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// Entries of a section that the library does not know: those of a body or an analysis that a program of its own adds
  /// (doc/extending.md). Members are bound to entries by dealii::ParameterHandler::add_parameter().
  class ParameterGroup
  {
  public:
    virtual ~ParameterGroup() = default;
    virtual void declare_parameters(dealii::ParameterHandler &prm) = 0;
    /// Combinations, after reading. @param section for messages @throws InputError
    virtual void check(const std::string &section) const = 0;
  };
} // namespace vibrocontact

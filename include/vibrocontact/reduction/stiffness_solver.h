#pragma once

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>

namespace vibrocontact
{
  /// How K u = f of a solid body is solved.
  enum class StiffnessSolver
  {
    /// by the factors of K
    direct,
    /// by conjugate gradients with approximate factors as preconditioner
    iterative
  };

  /// @return as Solver/Method names it
  std::string name_of(StiffnessSolver solver);

  /// `subsection Solver` of a solid body.
  struct StiffnessSolverParameters
  {
    /// automatic: direct if the memory suffices by the estimate of its cost, otherwise iterative
    std::string method = "automatic";

    void declare_parameters(dealii::ParameterHandler &prm);

    /// @return the one that `method` names; none if it is automatic
    std::optional<StiffnessSolver> named() const;
  };
} // namespace vibrocontact

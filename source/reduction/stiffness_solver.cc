#include <vibrocontact/reduction/stiffness_solver.h>

namespace vibrocontact
{
  void StiffnessSolverParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Method", method,
                      "How static answers and modes of the body are solved. direct: by the factors of its "
                      "stiffness; iterative: by "
                      "conjugate gradients to a residual of 1e-12 with factors in single precision as "
                      "preconditioner, in less than "
                      "half the memory, for modes by Count only; automatic: direct where its estimated "
                      "memory is there, otherwise "
                      "iterative if Modes/Upper frequency is 0. Units: none.",
                      dealii::Patterns::Selection("automatic|direct|iterative"));
  }
} // namespace vibrocontact

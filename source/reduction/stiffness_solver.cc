#include <vibrocontact/base/named_table.h>
#include <vibrocontact/reduction/stiffness_solver.h>

namespace vibrocontact
{
  namespace
  {
    struct NamedSolver
    {
      std::string name;
      std::optional<StiffnessSolver> solver;
    };

    const std::vector<NamedSolver> &named_solvers()
    {
      static const std::vector<NamedSolver> rows = {{"automatic", std::nullopt},
                                                    {"direct", StiffnessSolver::direct},
                                                    {"iterative", StiffnessSolver::iterative}};
      return rows;
    }
  } // namespace

  std::string name_of(const StiffnessSolver solver)
  {
    for (const NamedSolver &row : named_solvers())
      if (row.solver == solver)
        return row.name;
    return "";
  }

  std::optional<StiffnessSolver> StiffnessSolverParameters::named() const
  {
    return find_named(named_solvers(), method, "solver of a stiffness").solver;
  }

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
                      dealii::Patterns::Selection(selection(names_of(named_solvers()))));
  }
} // namespace vibrocontact

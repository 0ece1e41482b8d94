#pragma once

#include <vibrocontact/contact/contact_problem.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  class ContactSolver;
  struct ContactSolverParameters;

  /// One row of the table of contact solvers.
  struct ContactSolverEntry
  {
    std::string name, help;
    std::unique_ptr<ContactSolver> (*create)(const ContactSolverParameters &);
  };
  using ContactSolvers = std::vector<ContactSolverEntry>;

  /// The shipped ones, semi-smooth newton and fixed point; a program may have more (run/tables.h). Made beside
  /// create_contact_solver().
  const ContactSolvers &contact_solvers();

  /// `subsection Contact / subsection Solver`
  struct ContactSolverParameters
  {
    std::string method = "semi-smooth newton";
    /// relative residual to be reached, see ContactResidual
    double tolerance = 1e-10;
    unsigned int max_newton_iterations = 60;
    unsigned int max_fixed_point_iterations = 20000;
    /// the paper's stop (section 5): relative change of the forces in one iteration
    double force_change = 1e-13;
    /// that `method` chooses from; never null
    std::shared_ptr<const ContactSolvers> methods = std::make_shared<const ContactSolvers>(contact_solvers());

    void declare_parameters(dealii::ParameterHandler &prm);
  };

  /// Solves a ContactProblem. A solver may keep factorisations between calls and is used for a sequence of
  /// related problems (sweep, time steps); the previous solution is the start of the next.
  class ContactSolver
  {
  public:
    virtual ~ContactSolver() = default;
    /// @param start state to begin from; empty: a cold start. Its status and forces are used, sizes must
    /// match. Returns the best state found with converged = false if the tolerance was not reached.
    virtual ContactSolution solve(const ContactProblem &problem, const ContactSolution &start) = 0;
  };

  /// Frictionless start: the normal forces of problem without tangential forces, by
  /// the constrained conjugate gradients of Polonsky & Keer, Wear 231 (1999) 206. Rough: it serves as a first
  /// guess.
  void frictionless_start(const ContactProblem &problem, double tolerance, ContactSolution &state);
} // namespace vibrocontact

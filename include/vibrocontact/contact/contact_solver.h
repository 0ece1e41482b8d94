#pragma once

#include <vibrocontact/contact/contact_problem.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  class CheckpointFile;
  class ContactSolver;
  struct ContactSolverParameters;

  /// One row of the table of contact solvers.
  struct ContactSolverEntry
  {
    std::string name, help;
    std::unique_ptr<ContactSolver> (*create)(const ContactSolverParameters &);
    /// whether it takes a problem; null: every one. Asked at every solution, and so of the kind of the problem alone
    bool (*takes)(const ContactProblem &) = nullptr;
    /// what `takes` asks for, for the message that refuses others
    std::string asks_for = {};
    /// entries of the section that it reads
    std::string entries = "Tolerance, Force change, Max Newton iterations, Max fixed point iterations";
    /// from so many points on it is faster by products alone, where these are fast and it converges (projected_jacobi.h); 0: it
    /// takes the matrix
    unsigned int points_by_products = 0;
  };
  using ContactSolvers = std::vector<ContactSolverEntry>;

  /// The shipped ones; a program may have more (run/tables.h). Made beside create_contact_solver().
  const ContactSolvers &contact_solvers();

  /// `subsection Contact / subsection Solver`
  struct ContactSolverParameters
  {
    std::string method = "automatic";
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

  /// Solves a ContactProblem, in place. A solver is used for a sequence of related problems (sweep, time steps); the previous
  /// solution is the start of the next. What it keeps between them (factors, inverses, work vectors) belongs to the operator,
  /// ContactProblem::A, and is made anew for another one.
  class ContactSolver
  {
  public:
    virtual ~ContactSolver() = default;
    /// @param state to begin from; empty: a cold start. Its status and forces are used, sizes must match. On return the best
    /// state found, with converged = false if the tolerance was not reached.
    virtual void solve(const ContactProblem &problem, ContactSolution &state) = 0;
    /// Makes what solve() keeps of a problem's operator. @throws InputError if the problem is none for this solver
    virtual void prepare(const ContactProblem &) {}
    /// Forgets, or makes anew, what depends on the problems before: called at fixed steps, it makes a resumed run equal to an
    /// uninterrupted one bit for bit.
    virtual void renew() {}
    /// What a checkpoint needs, after prepare().
    virtual void exchange(CheckpointFile &) {}

    /// A solution by itself, with the time that it took.
    ContactSolution solved(const ContactProblem &problem, ContactSolution start = {});
  };

  /// Frictionless start: the normal forces of problem without tangential forces, by
  /// the constrained conjugate gradients of Polonsky & Keer, Wear 231 (1999) 206. Rough: it serves as a first
  /// guess.
  void frictionless_start(const ContactProblem &problem, double tolerance, ContactSolution &state);
} // namespace vibrocontact

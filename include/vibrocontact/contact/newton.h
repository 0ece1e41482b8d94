#pragma once

#include <vibrocontact/contact/contact_solver.h>

namespace vibrocontact
{
  /// Semi-smooth Newton on the projections (Alart & Curnier, CMAME 92 (1991) 353), with a tangential rho of
  /// 0.4 of that of ContactResidual: a smaller one takes more steps, a larger one starts to cycle between
  /// stick and slip (doc/contact.md). Solutions are judged by ContactResidual all the same.
  ///
  /// Only points whose projected normal force is positive enter the linear system: their forces, one unknown more if
  /// the normal force is given. Its matrix is factorised by LAPACK and kept while the active points stay
  /// and the residual falls fast, or, from one problem of a march to the next, falls at all (NewtonFactorisation); with a fast product and many points the system is
  /// solved by GMRES instead.
  ///
  /// Declared fallback: a step that does not lower the residual below the largest of the last four is halved;
  /// if six halvings fail, the iteration stalls, the matrix is singular, or nothing touches although a force
  /// is given, fixed-point iterations run from the best state and Newton resumes (counted in
  /// ContactSolution::fallbacks). What is returned is finite; a start that is not counts as none.
  /// @throws ConvergenceError for a problem whose numbers are not finite
  class NewtonSolver : public ContactSolver
  {
  public:
    explicit NewtonSolver(const ContactSolverParameters &parameters);
    ~NewtonSolver() override;
    void solve(const ContactProblem &problem, ContactSolution &state) override;
    void renew() override;

  private:
    class Steps;
    std::unique_ptr<Steps> steps;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/contact/contact_solver.h>

namespace vibrocontact
{
  /// The paper's algorithm (Lai et al. 2018, section 5): R <- projections of R with constant rho, stopped on
  /// the change of the forces.
  ///
  /// rho is the smallest eigenvalue of the integrator condensed on the contact, that is one over the largest
  /// of the compliance A, found for the normal and the tangential block by power iteration. A given normal
  /// force moves the approach so that the projected forces sum to it.
  class FixedPointSolver : public ContactSolver
  {
  public:
    explicit FixedPointSolver(const ContactSolverParameters &parameters) : parameters(parameters) {}
    ContactSolution solve(const ContactProblem &problem, const ContactSolution &start) override;

  private:
    ContactSolverParameters parameters;
  };
} // namespace vibrocontact

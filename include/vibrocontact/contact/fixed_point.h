#pragma once

#include <vibrocontact/contact/contact_solver.h>

namespace vibrocontact
{
  /// The paper's algorithm (Lai et al. 2018, section 5): R <- projections of R with constant rho, stopped on
  /// the change of the forces.
  ///
  /// rho is the smallest eigenvalue of the integrator condensed on the contact, that is one over the largest
  /// singular value of the compliance A, found for the normal and the tangential block by power iteration
  /// over the points that carry forces: free points around the contact would only make it smaller. (A point
  /// that becomes loaded joins them at once, those without force are left out every hundred iterations.) A
  /// given normal force moves the approach so that the projected forces sum to it.
  ///
  /// In rolling A_t = V d/dx C is far from symmetric: in a large stick zone its eigenvalues have small real
  /// parts, and with that rho the iteration cycles. Declared strategy: when the largest change of the forces
  /// over a hundred iterations does not fall by a hundredth against the hundred before, the tangential rho is
  /// halved (counted in ContactSolution::fallbacks).
  class FixedPointSolver : public ContactSolver
  {
  public:
    explicit FixedPointSolver(const ContactSolverParameters &parameters) : parameters(parameters) {}
    ContactSolution solve(const ContactProblem &problem, const ContactSolution &start) override;

  private:
    ContactSolverParameters parameters;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/contact/contact_solver.h>

namespace vibrocontact
{
  /// The paper's algorithm (Lai et al. 2018, section 5): R <- projections of R with constant rho, stopped on
  /// the change of the forces.
  ///
  /// rho is meant to be the smallest eigenvalue of the integrator condensed on the contact: one over the
  /// growth |A v| of a power iteration with the compliance A, for the normal and the tangential block, over
  /// the points that carry forces: free points around the contact would only make it smaller. (A point that
  /// becomes loaded joins them at once, those without force are left out every hundred iterations.) The
  /// normal block is symmetric, and its growth the largest eigenvalue; the tangential block of rolling is
  /// not, and its growth only an estimate, no bound (the largest singular value may be greater). A given
  /// normal force moves the approach so that the projected forces sum to it.
  ///
  /// In rolling A_t = V d/dx C is far from symmetric: in a large stick zone its eigenvalues have small real
  /// parts, and with that rho the iteration cycles. Declared strategy: when the largest change of the forces
  /// over a hundred iterations does not fall by a hundredth against the hundred before, the tangential rho is
  /// halved (counted in ContactSolution::fallbacks).
  class FixedPointSolver : public ContactSolver
  {
  public:
    explicit FixedPointSolver(const ContactSolverParameters &parameters) : parameters(parameters) {}
    void solve(const ContactProblem &problem, ContactSolution &state) override;

  private:
    ContactSolverParameters parameters;
  };
} // namespace vibrocontact

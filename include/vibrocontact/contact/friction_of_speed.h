#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/contact/newton_jacobian.h>

#include <functional>
#include <vector>

namespace vibrocontact
{
  /// |slip| of each point from the rows of y = (gap, slip_x, slip_y); n [m/s]
  std::vector<double> slip_speed(const ContactSolution &solution);

  /// What a change of the slip speed makes of the tangential forces of a point that projections hold: r P dmu/ds [Ns/m], and the
  /// direction of its slip. Zero where it does not slip.
  struct SpeedDependence
  {
    Vector2 force, direction;
  };
  /// @param row derivatives of the projections at the point, which have mu r @param normal_force P [N] @param slip that friction sees [m/s]
  SpeedDependence speed_dependence(const NewtonJacobian::Row &row, double mu, double normal_force,
                                   const FrictionLaw &law, const Vector2 &slip);

  /// Solves a contact problem whose friction may depend on the slip speed: with problem.mu alone if it does not.
  ///
  /// The slip speed in mu is that of rolling and modes; the rate of the residual displacements d(W~ R)/dt is no part of
  /// it. A contact point without mass on a spring W~ would jump at once under a falling characteristic (its growth rate
  /// 1 / (W~ N |dmu/ds|) is that of no mode), which the reduction cannot mean.
  ///
  /// An outer loop repeats the solution with problem.mu = mu(speed of the last solution) until no mu changes by more than
  /// 1e-9 of the largest. Its contraction is N |dmu/ds| times the slip per tangential force: in a time step that is of the
  /// order of the step (theta h N |dmu/ds| Psi_t Psi_t^T), so that the loop converges for small steps. Where more friction
  /// means less slip and that more friction, mu would jump about the solution: such points go by secants. A loop that does
  /// not converge within 100 rounds is returned as not converged. problem.mu is left as it was last used, a good start for
  /// the next step.
  /// @param state start and solution, as in ContactSolver::solve()
  /// @param speed the slip speed of each point that counts in mu, from a solution
  void solve_with_friction_of_speed(
      ContactProblem &problem, ContactSolver &solver, ContactSolution &state,
      const std::function<std::vector<double>(const ContactSolution &)> &speed = slip_speed);
} // namespace vibrocontact

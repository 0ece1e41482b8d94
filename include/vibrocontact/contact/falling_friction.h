#pragma once

#include <vibrocontact/contact/contact_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <vector>

namespace vibrocontact
{
  /// Friction that falls with the slip speed (Stribeck's curve without its viscous branch), or rises:
  ///
  ///   mu(s) = mu_k (1 + (ratio - 1) exp(-s / v)),     ratio = mu_s / mu_k,     s = |slip| [m/s]
  ///
  /// Graph: from mu_s at rest to mu_k, by 63 % of the way at s = v; down for ratio > 1, up for ratio < 1, 1: Coulomb's.
  /// Tangent: dmu/ds = -(mu_s - mu_k) / v exp(-s / v), a damping N dmu/ds along the slip, negative if falling: a
  /// mass m that slides under the force N gains -N (dmu/ds) / (2 m) of growth rate, under rising friction it loses it.
  ///
  /// The slip speed in mu is that of rolling and modes; the rate of the residual displacements d(W~ R)/dt is
  /// no part of it. A contact point without mass on a spring W~ would jump at once under a falling
  /// characteristic (its growth rate 1 / (W~ N |dmu/ds|) is that of no mode), which the reduction cannot
  /// mean.
  struct FallingFriction
  {
    double ratio = 1, velocity = 0.1;

    void declare_parameters(dealii::ParameterHandler &prm);
    bool acts() const { return ratio != 1; }
    /// mu(s) / mu_k [-] and its derivative [s/m]
    double factor(double speed) const;
    double slope(double speed) const;
  };

  /// |slip| of each point from the rows of y = (gap, slip); n [m/s]
  std::vector<double> slip_speed(const DenseVector &y);

  /// Solves a contact problem whose friction depends on the slip speed. An outer loop repeats the solution
  /// with problem.mu = mu(speed of the last solution) until no mu changes by more than 1e-9 of mu_k. Its
  /// contraction is N |dmu/ds| times the slip per tangential force: in a time step that is of the order of
  /// the step (theta h N |dmu/ds| Psi_t Psi_t^T), so that the loop converges for small steps; a loop that
  /// does not within 100 rounds is returned as not converged. problem.mu is left as it was last used, a good
  /// start for the next step.
  /// @param speed the slip speed of each point that counts in mu, from a solution
  ContactSolution
  solve_with_falling_friction(ContactProblem &problem, ContactSolver &solver, const ContactSolution &start,
                              const FallingFriction &falling, double mu_k,
                              const std::function<std::vector<double>(const ContactSolution &)> &speed);
} // namespace vibrocontact

#pragma once

#include <string>
#include <vector>

namespace vibrocontact
{
  /// One time step of one mode, q'' + 2 zeta w q' + w^2 q = p(t), linear in the state and in the modal force
  /// at both ends of the step:
  ///
  ///   (q1, v1) = T (q0, v0) + g0 p0 + g1 p1
  ///
  /// Whoever makes the coefficients, the contact problem of the step only sees g1: what the reaction at the
  /// end of the step does to displacement and velocity at its end. q in m sqrt(kg), p in N/sqrt(kg).
  struct ModalStep
  {
    /// transition of the state: rows q1, v1; columns q0, v0
    double T[2][2];
    /// displacement [s^2] and velocity [s] per force at the beginning and at the end of the step
    double g0[2], g1[2];
  };

  /// How the force of the contact acts within a step.
  enum class ReactionWeighting
  {
    /// like all other forces: theta p1 + (1 - theta) p0, or linear in the step for the exact propagator
    as_other_forces,
    /// p1 alone, as the paper has it: first order, and early by half a step (doc/theory.md, "Time steps")
    end_of_step
  };

  /// Jean's theta method (Lai et al. 2018, section 5; doc/theory.md, "Time steps"):
  ///
  ///   v1 - v0 = h [theta f1 + (1 - theta) f0],   q1 - q0 = h [theta v1 + (1 - theta) v0]
  ///   f = p - 2 zeta w v - w^2 q
  ///
  /// theta = 1/2 keeps the energy of undamped modes; theta > 1/2 subtracts (theta - 1/2) w^2 h from their
  /// growth rates.
  ModalStep theta_step(double omega, double zeta, double theta, double step, ReactionWeighting weighting);

  /// The exact solution over the step for a force that is linear in it (constant p1 with end_of_step); any
  /// damping ratio, rigid modes included. No numerical damping, no error of frequency.
  ModalStep exact_step(double omega, double zeta, double step, ReactionWeighting weighting);
} // namespace vibrocontact

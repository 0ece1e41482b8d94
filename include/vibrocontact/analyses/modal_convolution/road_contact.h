#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/contact/contact_problem.h>
#include <vibrocontact/contact/laws/normal_laws.h>
#include <vibrocontact/propagators/step_weights.h>

namespace vibrocontact
{
  /// Laws of the points that touch a road.
  struct RoadLaws
  {
    PointLaws<NormalLaw> normal = create_normal_law("signorini");
    /// of bodies with rows forward; or none
    PointLaws<FrictionLaw> friction = {};
  };

  /// The common contact problem of a body on the road, in the steps of a modal convolution.
  ///
  /// The body has n normal rows (up) and, with friction, n along the road (forward). With u = u_free + M q, M = B + S,
  /// q = (N, T), it is, for rigid points and Coulomb's law,
  ///
  ///   gap  = u_n - u_r >= 0                                    at the end of the step
  ///   slip = (u_t - u_t at the beginning) / h + W              [m/s], mean of the step
  ///   0 <= N perp gap >= 0,   |T| <= mu N,   T = -mu N slip / |slip| where it slips
  ///
  /// that is A = (M_nn, M_nt; M_tn / h, M_tt / h). slip > 0: body 1 moves forward over the road, T > 0 pushes it
  /// forward; W is Road/Sliding speed. Where a point sticks its displacement follows the road exactly, whatever the
  /// number of steps: the friction is a constraint of displacements as the contact is, with the same behaviour of the
  /// force interpolations (doc/theory.md, "Corrections to the tyre paper"). With impulses capture and release are of second order; where
  /// slip changes its sign at once the instant is known to a step, amplitudes and energy to second order.
  ///
  /// Contact points stand still over the road while the material of a rolling body flows through them. Its slip has the
  /// transport besides, with the ring's coordinate and Omega = -V / R
  ///
  ///   slip = W + dv/dt + Omega (dv/dtheta + w)    (sliding, rate in place, hoop strain times rolling speed)
  ///
  /// and with a tread Omega d/dtheta of its deformation, which enters undeformed in front. It is the V-fold gradient of
  /// BodyInContact, at the end of the step. The slope of the road does not turn forces.
  ///
  /// @param matrix M; n_points rows (no friction), 2 n_points, or 3 n_points with the gradients of a body that rolls; the
  /// problem has n_points or 2 n_points; b is left zero.
  /// @param speed V, of a body that rolls with friction [m/s]
  ContactProblem road_contact_problem(const DenseMatrix &matrix, unsigned int n_points, const RoadLaws &laws,
                                      double time_step, double speed = 0);

  /// Gives a problem without friction products by FFT in place of its matrix where ProjectedJacobi takes it then: the points are
  /// evenly apart on a body that is alike everywhere, and their tread yields far more than the body.
  /// @param matrix that of the problem
  void use_even_line(ContactProblem &problem, const DenseMatrix &matrix);

  /// @param compliance M
  /// @throws InputError if the tangential motion of the points has no compliance
  void check_road_friction(const DenseMatrix &compliance);
} // namespace vibrocontact

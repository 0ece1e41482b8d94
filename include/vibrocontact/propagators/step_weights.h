#pragma once

#include <vibrocontact/propagators/propagator.h>

namespace vibrocontact
{
  /// Exact integrals of e^(lambda (h - s)) times an interpolated force over one step, per pole (phi functions):
  ///
  ///   now_k   what q_n adds to z_k(t_(n+1)),  per unit of left_k^T q
  ///   later_k what it adds within the step after (linear interpolation only)
  ///
  ///   impulse: now = h e^(lambda h);   constant: now = h phi_1;   linear: now = h phi_2, later = h (phi_1 - phi_2)
  ///
  /// and factor_k = e^(lambda h), what is left of z_k without forces.
  ///
  /// Poles that stand for a rest, lambda = -1 / beta (rest_by_poles()), go by the backward difference in every interpolation and
  /// method, as in the transient: factor = beta / (h + beta), now = h factor, later = 0. Points that follow forces by their
  /// rate alone would ring with forces linear in the step, and a rest of h >> beta would not feel impulses (doc/theory.md).
  struct StepWeights
  {
    std::vector<std::complex<double>> factor, now, later;
  };

  StepWeights step_weights(const BodyInContact &model, double time_step, ForceInterpolation interpolation);

  /// The same of Jean's theta method (Lai et al. 2018, section 5; doc/theory.md, "Time steps"), x = lambda h:
  ///
  ///   factor = (1 + (1 - theta) x) / (1 - theta x),     impulse: now = h factor
  ///   constant: now = h / (1 - theta x);     linear: now = theta h / (1 - theta x), later = (1 - theta) h / (1 - theta x)
  ///
  /// Linear forces are weighted as all others, constant ones are those of the end of the step, as the paper has them.
  StepWeights theta_weights(const BodyInContact &model, double time_step, ForceInterpolation interpolation,
                            double theta);

  /// B + S: displacement at the end of a step per force in it; n_rows square [m/N]
  DenseMatrix one_step_compliance(const BodyInContact &model, const StepWeights &weights);

  /// Longest step at which the forces of points that stay closed do not ring [s], from the contact's compliance S and
  /// g'(0+) = slope (row and force):
  ///
  ///   impulse: infinite
  ///   constant: infinite if S is positive definite, else 0 (error factor -1 per step: impacts become elastic)
  ///   linear: 2.7 sqrt(min_x x^T S x / x^T slope x), 0 without S (error factor -3.73)      (doc/theory.md)
  double critical_time_step(const DenseMatrix &S, const DenseMatrix &slope, ForceInterpolation interpolation);
  /// The same of the theta method: infinite for theta > 1/2 and for impulses; theta = 1/2 has the error factor -1 in forces of
  /// rigid points, 0, and none that grows otherwise.
  double critical_theta_step(const DenseMatrix &S, ForceInterpolation interpolation, double theta);

  /// What constant loads do to the rigid motions of a free body, which have no equilibrium: u(t) = a t^2 / 2, step by step.
  class FreeFall
  {
  public:
    /// Stands at the end of the first step.
    FreeFall(const BodyInContact &model, double time_step);
    void add_to(double *u) const;
    void add_rate_to(double *v) const;
    void advance() { ++step; }
    void exchange(CheckpointFile &file, const std::string &name);
    bool is_none() const { return acceleration.empty(); }

  private:
    /// of the rows [m/s^2]; empty if nothing falls
    std::vector<double> acceleration;
    double time_step;
    unsigned long step = 1;
  };

  /// Motion without contact forces: initial state and loads, evaluated step by step.
  ///
  ///   u(t) = u_static + 2 Re sum_k right_k e^(lambda_k t) (z_k(0) - z_static_k) + free fall,  z_static = -load / lambda
  class FreeMotion
  {
  public:
    /// Stands at the end of the first step.
    FreeMotion(const BodyInContact &model, const std::vector<std::complex<double>> &state, double time_step);
    /// adds the displacement to u; n_rows
    void add_to(double *u) const;
    /// the same of its velocity
    void add_rate_to(double *v) const;
    void advance();
    void exchange(CheckpointFile &file, const std::string &name);

  private:
    unsigned int n_rows;
    std::vector<double> constant;
    FreeFall fall;
    /// of the states that move at all: state, e^(lambda h), 2 right, lambda
    std::vector<std::complex<double>> moving, factor, shape, poles;
  };

  /// The past forces of a convolution in a checkpoint. @throws InputError if the run remembers another number
  void exchange_past_forces(CheckpointFile &file, std::vector<double> &forces);

  /// Samples of the Green's functions in the form that a convolution takes:
  ///
  ///   u(t_(n+1)) = u_free motion + sum_(m <= n) kernel_(n-m) q_m        (Eq. 5, corrected: doc/theory.md)
  ///
  /// each the exact integral of g times an interpolated force, from closed forms at each lag by itself (nothing is
  /// carried from lag to lag, so that the recursion has a second method beside it). Lag 0 includes S.
  /// @return kernel of rows i, j at [(i * n_rows + j)][lag]
  std::vector<std::vector<double>> step_kernel(const BodyInContact &model, double time_step,
                                               ForceInterpolation interpolation, unsigned long n_lags);

  /// Number of steps after which the driving-point g(t) stay below a share of their maximum: the paper's section 2.1
  /// with 0.01; most_steps, the run's length, if they do not (a pole without damping).
  unsigned long steps_of_memory(const BodyInContact &model, double time_step, double share,
                                unsigned long most_steps);
} // namespace vibrocontact

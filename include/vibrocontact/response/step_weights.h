#pragma once

#include <vibrocontact/response/response.h>

namespace vibrocontact
{
  /// Exact integrals of e^(lambda (h - s)) times an interpolated force over one step, per pole (phi functions):
  ///
  ///   now_k   what q_n adds to z_k(t_(n+1)),  per unit of left_k^T q
  ///   later_k what it adds within the step after (linear interpolation only)
  ///
  ///   impulse: now = h e^(lambda h);   constant: now = h phi_1;   linear: now = h phi_2, later = h (phi_1 - phi_2)
  struct StepWeights
  {
    std::vector<std::complex<double>> now, later;
  };

  StepWeights step_weights(const PoleModel &model, double time_step, ForceInterpolation interpolation);

  /// B + S: displacement at the end of a step per force in it; n_rows square [m/N]
  DenseMatrix one_step_compliance(const PoleModel &model, double time_step, ForceInterpolation interpolation);

  /// Longest step at which the forces of points that stay closed do not ring [s], from the contact's compliance S and
  /// g'(0+) = slope (row and force):
  ///
  ///   impulse: infinite
  ///   constant: infinite if S is positive definite, else 0 (error factor -1 per step: impacts become elastic)
  ///   linear: 2.7 sqrt(min_x x^T S x / x^T slope x), 0 without S (error factor -3.73)      (doc/theory.md)
  double longest_step(const DenseMatrix &S, const DenseMatrix &slope, ForceInterpolation interpolation);

  /// Motion without contact forces: initial state and loads, evaluated step by step.
  ///
  ///   u(t) = u_static + 2 Re sum_k right_k e^(lambda_k t) (z_k(0) - z_static_k),     z_static = -load / lambda
  class FreeMotion
  {
  public:
    /// Stands at the end of the first step.
    FreeMotion(const PoleModel &model, const std::vector<std::complex<double>> &state, double time_step);
    /// adds the displacement to u; n_rows
    void add_to(double *u) const;
    /// the same of its velocity
    void add_rate_to(double *v) const;
    void advance();
    void exchange(CheckpointFile &file, const std::string &name);

  private:
    unsigned int n_rows;
    std::vector<double> constant;
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
  std::vector<std::vector<double>> step_kernel(const PoleModel &model, double time_step,
                                               ForceInterpolation interpolation, unsigned long n_lags);

  /// Number of steps after which the driving-point g(t) stay below a share of their maximum: the paper's section 2.1
  /// with 0.01; most_steps, the run's length, if they do not (a pole without damping).
  unsigned long steps_of_memory(const PoleModel &model, double time_step, double share,
                                unsigned long most_steps);
} // namespace vibrocontact

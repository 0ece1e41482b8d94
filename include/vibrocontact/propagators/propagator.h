#pragma once

#include <vibrocontact/base/checkpoint_file.h>
#include <vibrocontact/base/dense.h>
#include <vibrocontact/bodies/body_in_contact.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// How a contact force is interpolated within a step of length h (entry Force shape); one unknown q per row and
  /// step (doc/theory.md, corrections to the tyre paper, says which one suits which contact).
  enum class ForceInterpolation : unsigned char
  {
    /// an impulse h q at the beginning of the step: rigid contact
    impulse,
    /// q all over the step, a zero-order hold: contact with a compliance, first order, stable for any step
    constant,
    /// linear from the q of the step before, q at the end, a first-order hold: contact with a compliance, second
    /// order, stable for h < 2.7 sqrt(S / g'(0))
    linear
  };

  /// impulse, constant, linear
  const std::vector<std::string> &force_interpolation_names();
  /// @throws InputError naming the shapes
  ForceInterpolation force_interpolation(const std::string &name);

  /// Displacement of a body known by its Green's functions, step by step, under forces that are found on the way:
  ///
  ///   u(t_(n+1)) = u_free(t_(n+1)) + (B + S) q_n        u_free: all forces before, loads, initial state
  ///
  ///   while (...)
  ///   {
  ///     find q with   gap = free_displacement() + compliance() q - road     (contact/active_set.h)
  ///     advance(q)
  ///   }
  ///
  /// Sizes: n_rows; u [m] away from the other body, q [N] > 0 pushes in that direction. B comes from the exact
  /// integral of g times the interpolated force over the step, S is the static residual (tread included).
  class Propagator
  {
  public:
    virtual ~Propagator() = default;
    unsigned int n_rows() const { return one_step.m(); }
    /// B + S, n_rows square [m/N]
    const DenseMatrix &compliance() const { return one_step; }
    /// u_free at the end of the next step; n_rows [m]
    const double *free_displacement() const { return free.data(); }
    /// Closes the step with its forces q; n_rows [N].
    virtual void advance(const double *q) = 0;
    /// Steps of one point in contact, each with 0 <= q perp u_free + (B + S) q - height >= 0 in closed form.
    /// @param heights, displacements, forces at the ends of the steps, n_steps each
    /// @return how many closed
    virtual unsigned long advance_in_contact(unsigned int n_steps, const double *heights,
                                             double *displacements, double *forces);
    /// What a checkpoint needs.
    virtual void exchange(CheckpointFile &file) = 0;

  protected:
    DenseMatrix one_step;
    std::vector<double> free;
  };

  /// State that a motion starts from: the poles' states z; n_poles.
  std::vector<std::complex<double>> state_at_rest(const BodyInContact &model);
  /// The equilibrium under the loads: z = -load / lambda.
  std::vector<std::complex<double>> state_in_equilibrium(const BodyInContact &model);

  /// What a propagator is made of.
  struct PropagatorSettings
  {
    /// [s]
    double time_step = 0;
    ForceInterpolation interpolation = ForceInterpolation::impulse;
    /// convolutions: how many of the newest forces count; 0: as many as the run has steps
    unsigned long memory = 0;
    unsigned long n_steps = 0;
    /// of the theta method
    double theta = 0.5;
  };
} // namespace vibrocontact

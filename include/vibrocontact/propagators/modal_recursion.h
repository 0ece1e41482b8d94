#pragma once

#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/propagators/step_weights.h>

namespace vibrocontact
{
  /// The propagator of the poles' states, exact or by the theta method, as its weights say: with p_k the state that the next step would end with if no force
  /// acted in it,
  ///
  ///   p_k <- factor_k p_k + w_k left_k^T q,      u_free = u_static + 2 Re sum_k right_k p_k
  ///   w_k  = factor_k now_k + later_k            (propagators/step_weights.h)
  ///
  /// Nothing grows with time, in contrast to the paper's Eqs 18, 19, 46 and 47. One state per shape serves all
  /// points; constant loads only move the origin of the states (z - z_static) and cost nothing, but for those that a free
  /// body falls under. Cost: 4 numbers read per state and point, 1 if right shapes are real and left ones proportional to
  /// them (real modes); forces that are zero are skipped if there are more than four points.
  class ModalRecursion final : public Propagator
  {
  public:
    ModalRecursion(const BodyInContact &model, const std::vector<std::complex<double>> &state,
                   const PropagatorSettings &settings, const StepWeights &weights);
    void advance(const double *q) override;
    unsigned long advance_in_contact(unsigned int n_steps, const double *heights, double *displacements,
                                     double *forces) override;
    void exchange(CheckpointFile &file) override;

  private:
    void show_many();
    void keep_real_shapes(const BodyInContact &model);

    unsigned int n_poles;
    /// padded number of states and of rows
    std::size_t n_states, n_padded;
    /// real parts, then imaginary parts: p, factor; w and 2 right of each row
    AlignedVector p, e, w, c;
    /// many rows: 2 right by columns, one per real and one per imaginary part of a state; u_free
    AlignedVector columns, u;
    /// few rows, right shapes real and left ones proportional to them: the shapes, p holds 2 p then
    bool real_shapes = false;
    std::vector<double> constant;
    FreeFall fall;
    std::vector<unsigned int> all, listed;
    std::vector<double> factors;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/propagators/step_weights.h>
#include <vibrocontact/propagators/thin_product.h>

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
  /// them (real modes). Of many points it is less (thin_product.h); of more than four, forces that are zero are
  /// skipped.
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
    /// padded number of states
    std::size_t n_states;
    /// real parts, then imaginary parts: p, factor; of few rows w and 2 right of each row
    AlignedVector p, e, w, c;
    /// of many rows
    RowsAndStates many;
    AlignedVector u;
    /// few rows, right shapes real and left ones proportional to them: the shapes, p holds 2 p then
    bool real_shapes = false;
    std::vector<double> constant;
    FreeFall fall;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/coupled_bodies/quasi_static_rolling.h>
#include <vibrocontact/marching/contact_stepper.h>
#include <vibrocontact/marching/drive.h>
#include <vibrocontact/marching/march_checkpoint.h>
#include <vibrocontact/marching/transient_parameters.h>
#include <vibrocontact/marching/transient_result.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// After so many steps the contact solver starts afresh, so that what it keeps from step to step need not
  /// be in a checkpoint: a run that continues there goes the same way bit for bit. A run that has gone on for long
  /// starts afresh seldom: what its solver keeps serves it for periods of its vibration.
  inline unsigned long steps_between_fresh_starts(const unsigned long steps_so_far)
  {
    constexpr unsigned long at_first = 50, later = 500, at_last = 2000;
    return steps_so_far < later ? at_first : steps_so_far < 2 * at_last ? later : at_last;
  }

  /// The same run again with twice the step, beside the first one: what both differ by tells the error of the
  /// first (numerics/doubled_step.h).
  struct Companion
  {
    /// as the other's, for with_doubled_step(parameters)
    DriveFunction drive;
    /// to begin with, that of the other
    DynamicState state;
    TransientResult sums;
    StepErrors errors;
  };

  /// Parameters of the run with twice the step; of adapted steps all lengths are doubled, and the tolerance
  /// follows the error of a step, which is of third order.
  TransientParameters with_doubled_step(TransientParameters parameters);

  /// Steps to the end time (Lai et al. 2018, section 5), steps_between_fresh_starts() of them in a block.
  ///
  /// A checkpoint holds the state that the next step starts from, the sums so far and the same of the run with twice the
  /// step, if there is one. What a solver keeps from step to step (factorisations) is not in it.
  class TransientMarch : public March
  {
  public:
    /// Called after every step; false: the march is over.
    using Observer = std::function<bool(const DynamicState &, const TransientResult &)>;

    /// @param pair is referred to
    /// @param companion follows the run and learns its errors; null: they are not estimated
    TransientMarch(const TransientParameters &parameters, const ContactSections &contact,
                   const ContactSolverParameters &solver, const ContactPair &pair, const DriveFunction &drive,
                   const Observer &observe, Companion *companion = nullptr);
    ~TransientMarch() override;

    double time() const override { return state.time; }
    double end_time() const override { return parameters.end_time; }
    bool is_over() override;
    /// @throws ConvergenceError after a step whose contact does not converge, with sums.converged = false
    void advance_block() override;
    void advance_part(unsigned int n_steps) override;
    bool is_between_blocks() const override
    {
      return sums.steps % steps_between_fresh_starts(sums.steps) == 0;
    }
    void exchange(CheckpointFile &file) override;
    Marks marks() const override;
    std::string pace() const override;

    /// to begin with, that at time zero
    DynamicState state;
    TransientResult sums;

  private:
    class Steps;
    void prepare();
    /// The coarse run up to the time of this one, and what both differ by when they are at the same time.
    void follow();

    const TransientParameters parameters, doubled;
    const ContactSections contact;
    const ContactSolverParameters solver;
    const ContactPair &pair;
    const DriveFunction drive;
    const Observer observe;
    Companion *const companion;
    std::unique_ptr<Steps> steps, coarse;
    bool goes_on = true;
  };

  /// The whole march from `state` on, without checkpoints. A step whose contact does not converge ends it, with
  /// converged = false and the states so far.
  TransientResult transient(const TransientParameters &parameters, const ContactSections &contact,
                            const ContactSolverParameters &solver, const ContactPair &pair,
                            const DriveFunction &drive, DynamicState &state,
                            const TransientMarch::Observer &observe, Companion *companion = nullptr);
} // namespace vibrocontact

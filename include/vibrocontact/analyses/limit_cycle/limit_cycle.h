#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_map.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_parameters.h>
#include <vibrocontact/analyses/limit_cycle/multipliers.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <optional>
#include <string>

namespace vibrocontact
{
  /// A periodic motion of the coupled bodies, and how it was found.
  struct LimitCycle
  {
    /// the unstable root of the equilibrium that it began from, or the nearest one to the motion that it began from
    StabilityRoot root;
    /// which motion that was; empty: it began from the root
    std::string motion;
    /// what the last start of Newton's method was made by
    std::string started_by;
    bool converged = false;
    /// why not
    std::string message;
    /// [s], in so many steps
    double period = 0;
    unsigned int n_steps = 0;
    /// at its begin, see CycleMap; |x(T) - x(0)| over |x(0) - equilibrium|
    DenseVector state;
    std::optional<double> residual;
    /// what a period changes a disturbance along the motion by, over itself; 0 for infinitely short steps
    double change_along = 0;
    /// nothing: not asked for, or not judged
    std::optional<CycleStability> stability;
    /// why the derivative by the state says nothing of what becomes of disturbances; empty: it does
    std::string not_judged{};
    /// Newton iterations, columns that derivatives were multiplied with, steps that were marched
    unsigned int newton_iterations = 0;
    unsigned long n_products = 0, n_marched_steps = 0;
    /// until it was found, and what its stability took [s]
    double seconds = 0, stability_seconds = 0;
  };

  /// The cycle that an unstable root grows to, without time going by: its amplitude is estimated by marches over a few
  /// periods (start_of_cycle()), then Newton's method closes it (CycleEquations).
  /// @param equilibrium at rest, with its contact
  /// @param from a motion near the cycle, of about the root's frequency, in place of what is estimated; null: there is none
  LimitCycle find_limit_cycle(CycleMap &map, const ContactPair &pair, const DynamicState &equilibrium,
                              const StabilityRoot &root, const LimitCycleParameters &parameters,
                              const DynamicState *from = nullptr);

  /// The same cycle by the steps of another map, from the state and the period that it was found with; not judged.
  LimitCycle find_again(CycleMap &map, const DynamicState &equilibrium, const LimitCycle &like,
                        const LimitCycleParameters &parameters);

  /// Whether what repeats itself is a motion (change_along), and what becomes of disturbances (stability); a cycle that is
  /// none, or whose stability is not found, has not converged. Where a point touches down and sticks at once no step gives the derivative
  /// by the moment of the touch: such a cycle stands by the estimate of its steps and is not judged.
  void judge_cycle(CycleMap &map, const LimitCycleParameters &parameters, LimitCycle &cycle);

  /// Steps of a period of a root.
  unsigned int steps_of_period(const StabilityRoot &root, const LimitCycleParameters &parameters);
} // namespace vibrocontact

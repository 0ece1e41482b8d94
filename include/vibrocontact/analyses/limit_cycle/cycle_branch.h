#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_family.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A cycle of a branch.
  struct CycleBranchPoint
  {
    double value = 0;
    /// 0, 1, ... in the order in which they were found
    unsigned int number = 0;
    LimitCycle cycle;
    /// whether a point sticks at some time of the period; whether one does what it does not at rest
    bool sticks = false, changes = false;
    /// of the motion about the equilibrium, see CycleMap [sqrt(J)]
    double size = 0;
  };

  /// One end of a branch.
  struct CycleBranchEnd
  {
    enum class Kind
    {
      /// the value is that of the range
      range,
      /// the amplitude vanishes: here motions begin. Where sliding is linear, the amplitude rises there at one value, to the first stick
      vanishes,
      /// Limit cycle/Branch/Most points were found
      most_points,
      /// Newton's method came no farther
      lost
    } kind = Kind::lost;
    /// why it was lost
    std::string reason;
    /// the value at which the amplitude is zero; of vanishes
    double onset = 0;
    /// whether the contact reached points that the map does not know, so that it may come farther with more
    bool left_its_points = false;
  };

  /// The cycles that are reached from one when an entry changes; neighbours in turn.
  struct CycleBranch
  {
    std::vector<CycleBranchPoint> points;
    /// at the first point and at the last one
    CycleBranchEnd ends[2];
    /// values at which the branch turns round
    std::vector<double> folds;
  };

  /// Follows a cycle both ways by pseudo-arc-length (Keller 1977): from the last cycle along the secant of the last two, then Newton's
  /// method on
  ///
  ///   x - Phi(x; T, v) = 0,    p . dx = 0,    t . (z - z0) = ds
  ///
  /// z: state, period and value v, each over its size; p as in CycleEquations, t the secant. Folds are passed. Steps grow where few
  /// iterations were needed and are halved where Newton's method fails.
  /// @param start a cycle that was found at `value` @param found hears of every point, as they are found; where it throws a
  /// ConvergenceError the branch is lost
  CycleBranch follow_cycle(const CycleFamily &family, const LimitCycle &start, double value,
                           const LimitCycleParameters &parameters,
                           const std::function<void(const CycleBranchPoint &, CycleAt &)> &found);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/analyses/limit_cycle/cycle_scene.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/pair_in_time.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  class Progress;

  /// What the cycles of a run are sought with.
  struct CycleSearch
  {
    const AnalysisRun &on;
    /// with its hub held
    std::shared_ptr<const ContactPair> held;
    RollingCase constants;
    CycleScene scene;
    std::vector<Probe> probes;
    /// the motion that they are sought from; nothing: from the roots
    std::optional<DynamicState> from;

    const LimitCycleParameters &own() const { return on.parameters.limit_cycle; }
    const ContactPair &pair() const { return *scene.pair; }
    /// The sentence says why the analysis has not converged.
    void refuse(const std::string &sentence) const;
  };

  /// Says in the log what is sought. @throws InputError, ConvergenceError if there is no equilibrium. Collective.
  CycleSearch prepare_search(const AnalysisRun &on, const PairInTime &in_time);

  /// That Limit cycle/Roots asks for, or the one that the motion of a transient is nearest to.
  /// @throws InputError if there is none of a frequency
  std::vector<StabilityRoot> roots_to_begin_from(const CycleSearch &search);

  /// A cycle as it was sought from one root.
  struct SoughtCycle
  {
    LimitCycle cycle;
    /// of its last march
    std::unique_ptr<CycleMap> map;
    /// which of spreads_of_contact its points have
    unsigned int spread = 0;
    /// nothing: it was not found
    std::optional<CyclePeriod> period;
    /// why it was not sought at all
    bool lacks_memory = false;
  };

  /// With more and more points, until the contact stays on them. Collective. @param progress hears of the steps marched
  SoughtCycle seek_cycle(const CycleSearch &search, const StabilityRoot &root, Progress &progress);
} // namespace vibrocontact

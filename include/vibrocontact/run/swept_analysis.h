#pragma once

#include <vibrocontact/base/shared_cases.h>

#include <functional>

namespace vibrocontact
{
  /// An analysis that runs through the cases of its sweep; run_sweep() shares them out over the ranks:
  ///
  ///     prepare 0 1 2 ...        all ranks together: bodies are reduced, what only all ranks can make
  ///     compute 0 | 1 | 2 ...    each on one rank alone
  ///     take    0 1 2 ...        all ranks, in order
  ///     finish                   all ranks
  class SweptAnalysis
  {
  public:
    virtual ~SweptAnalysis() = default;

    /// Cases one after the other on one rank.
    virtual unsigned int cases_per_chunk() const { return 1; }
    /// Makes what case k needs of all ranks. Collective.
    /// @throws InputError, which ends the run; ConvergenceError: what the case came to
    virtual void prepare(unsigned int k) = 0;
    /// What case k comes to, on a SingleRank. @throws what take() hears of, CaseStopped
    virtual PackedCase compute(unsigned int k) = 0;
    /// `outcome` returns what the case came to or throws InputError, ConvergenceError. Collective.
    virtual void take(unsigned int k, const std::function<PackedCase()> &outcome) = 0;
    /// After the last case, if any has a result: tables. Collective.
    virtual void finish() = 0;
  };

  /// A case was interrupted by this signal and left its checkpoint.
  struct CaseStopped
  {
    int signal;
  };
} // namespace vibrocontact

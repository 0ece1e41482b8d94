#pragma once

#include <deal.II/base/utilities.h>

#include <mpi.h>

#include <functional>
#include <vector>

namespace vibrocontact
{
  using PackedCase = std::vector<char>;

  /// share_cases() of outcomes that are packed already.
  void
  share_packed_cases(unsigned int n_cases, unsigned int chunk,
                     const std::function<std::function<PackedCase(unsigned int)>()> &begin_chunk,
                     const std::function<void(unsigned int, const std::function<PackedCase()> &)> &arrived,
                     MPI_Comm communicator);

  /// Computes the cases of a sweep, shared out over the ranks, and brings what each came to to all of them.
  ///
  ///     cases     0 1 2 3 | 4 5 6 7 | 8 9 ...      chunk = 4
  ///     rank 0    ------->           ------->      the rank that is free takes the next chunk
  ///     rank 1              ------->
  ///     arrived                                0 1 2 3 4 ...    on all ranks, in order
  ///
  /// A case may start from the one before it, within its chunk only. Where chunks begin does not depend on
  /// the ranks, so that any number of them gives the same numbers, bit for bit, whichever computed a case.
  /// One rank has each case arrive at once. More meet every few seconds (and after some chunks at least),
  /// so that little is lost if the run is killed.
  ///
  /// @param chunk number of cases in a chunk: 1 if none starts from another
  /// @param begin_chunk makes what computes the cases of a chunk, one after the other, from a cold start. No
  /// part of this may communicate, nor read files that all ranks read together
  /// @param arrived called on all ranks with each case in order; `outcome` returns it or throws what the case
  /// has thrown, see Failure. May communicate. What it throws ends the sweep and has to be thrown on all ranks
  /// @tparam Outcome what Boost can serialise
  template <typename Outcome>
  void
  share_cases(const unsigned int n_cases, const unsigned int chunk,
              const std::function<std::function<Outcome(unsigned int k)>()> &begin_chunk,
              const std::function<void(unsigned int k, const std::function<Outcome()> &outcome)> &arrived,
              const MPI_Comm communicator)
  {
    share_packed_cases(
        n_cases, chunk,
        [&]
        {
          return [solve = begin_chunk()](const unsigned int k)
          { return dealii::Utilities::pack(solve(k), false); };
        },
        [&](const unsigned int k, const std::function<PackedCase()> &packed)
        { arrived(k, [&] { return dealii::Utilities::unpack<Outcome>(packed(), false); }); },
        communicator);
  }
} // namespace vibrocontact

#pragma once

#include <vibrocontact/analyses/stability/sweep_case.h>
#include <vibrocontact/base/failure.h>

#include <functional>
#include <vector>

namespace vibrocontact
{
  /// What a case of a row came to.
  struct CaseOfRow
  {
    SolvedCase solved;
    /// in its place
    Failure failure;
  };

  /// The cases of a row of a map, in which one entry runs through its values, by roots that are followed from case to case:
  ///
  ///     o . . . . . . o . . . . . . . . . . . . . o     o  complete: all roots by LAPACK
  ///       ------------------------------------->        .  equilibrium, and Newton on F(s) x = 0 from the case before
  ///       <------------
  ///
  /// Followed are, through the whole row, the roots that grow in a complete case, those that would if their growth changed as much
  /// again as from one complete case to the next (if they decay by less than 5e-3 of their angular frequency), and beside those that grow the three nearest to that. The first step of a root is predicted by its
  /// derivative, others by the step before. One that grows in no complete case is dropped where following fails, as it does for a mode that hardly moves the
  /// contact. In each complete case every followed root has to be one of those that LAPACK lists, no
  /// two the same, and each that grows is followed. Beside a periodic rail one that decays fast, listed where poles have it, may be dropped. Where Newton's method does not lead to the next case, that case is solved
  /// completely as well and the predicted root taken from its list. A row that fails so is solved completely, case by case. So are rows of fewer
  /// than five cases.
  ///
  /// The complete cases within odd rows lie between those of even ones, so that those of a map make a finer net.
  /// @param reduced of each case, may throw @param bodies of each case @param number of the row
  /// @param keeps_pair the entry changes friction, load or creepage alone, so that the pair of the first case is that of all
  std::vector<CaseOfRow>
  followed_row(const std::vector<const SweepCase *> &row,
               const std::function<const std::vector<const ReducedBody *> &(unsigned int)> &reduced,
               const std::vector<const MeshedBodies *> &bodies, const std::optional<MeasuredData> &measured,
               unsigned int number, bool keeps_pair);
} // namespace vibrocontact

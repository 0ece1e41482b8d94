#pragma once

#include <vibrocontact/coupled_bodies/rolling_result.h>

#include <mpi.h>

#include <functional>
#include <memory>
#include <vector>

namespace vibrocontact
{
  /// Quasi-static rolling (Lai et al. 2018, section 4.1, Eq. 15): normal and tangential contact fully
  /// coupled, the solution of one case being the start of the next of its curve; every fourth case starts
  /// cold, so that the cases can be shared out over ranks. A case whose solver throws ConvergenceError counts
  /// as not converged, and the others go on.
  ///
  /// On two grids: each case is solved on both; see RollingGrids. A coarse grid that finds no solution, whose contact
  /// reaches its upstream side or is of fewer than four points, leaves the error unknown; where results are extrapolated the case then is not converged.
  ///
  /// @param finished called after each case, in order, whether it converged or not; on all ranks
  /// @param communicator the ranks that the cases are shared out over, see share_cases()
  /// @throws InputError if the contact reaches the edge of the grid
  std::vector<RollingResult>
  quasi_static_rolling(const RollingParameters &rolling, const ContactSections &contact,
                       const ContactSolverParameters &solver, const RollingGrids &grids,
                       const std::function<void(const RollingResult &, const ContactProblem &)> &finished,
                       MPI_Comm communicator = MPI_COMM_SELF);

  /// On one grid, without a stated error.
  /// @param operator_at makes the contact operator for a rolling speed; called once, all cases share it
  std::vector<RollingResult>
  quasi_static_rolling(const RollingParameters &rolling, const ContactSections &contact,
                       const ContactSolverParameters &solver, const ContactInterface &interface,
                       const std::function<std::shared_ptr<const ContactOperator>(double speed)> &operator_at,
                       const std::function<void(const RollingResult &, const ContactProblem &)> &finished,
                       MPI_Comm communicator = MPI_COMM_SELF);
} // namespace vibrocontact

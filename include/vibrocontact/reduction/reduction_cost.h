#pragma once

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What one step of a reduction costs: wall time on one idle core [s], memory over all ranks at its peak, with all that
  /// the body keeps from the steps before [byte].
  struct ReductionStage
  {
    std::string name;
    double seconds, bytes;
  };

  /// What the reduction of a solid body costs, told from its size before anything is made. Quadratic hexahedra, measured
  /// on the shipped wheel (287,175 dofs) and rail (199,785) with MUMPS and METIS:
  ///
  ///     matrices, mesh       5 kB per dof
  ///     factors              2.8 GB (n / 287,000)^1.25, with the workspace of MUMPS
  ///     count of modes       a second factorisation that keeps nothing: 0.7 of the first
  ///     modes                3 vectors per mode (the basis is twice as long as what is sought)
  ///     contact compliance   two dense matrices of the size of its rows
  struct ReductionCost
  {
    std::vector<ReductionStage> stages;
    /// largest over the stages, and what stays when they are done [byte]
    double peak = 0, kept = 0;
  };

  /// @param n_rows of the contact, 0 without; @param n_modes 0: no modes
  /// @param counts_first the modes up to a frequency are counted before they are sought
  ReductionCost reduction_cost(double n_dofs, double n_rows, double n_modes, bool counts_first);

  /// The same of a body that is solved wave by wave around its axle, measured on the section of the shipped wheel (3,900
  /// dofs, cubic): 40 ms for each number of waves, with modes and without. One number is held in memory at a time.
  /// @param n_waves that the compliance is summed over, 0: no contact; @param with_modes of some 24 numbers of waves
  ReductionCost revolved_cost(double n_dofs, double n_waves, bool with_modes);

  /// The same of a periodic rail, measured on the shipped section (813 dofs, quadratic): 2 s for the waves of the section under
  /// a contact, 0.13 s for each frequency of its poles, 1.5 s for each of a frequency response, with its decay rates along the track.
  /// @param n_rows of the contact, 0 without; @param n_of_poles, n_of_response frequencies, shared out over the ranks
  ReductionCost track_cost(double n_dofs, double n_rows, double n_of_poles, double n_of_response);
} // namespace vibrocontact

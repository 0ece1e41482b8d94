#pragma once

#include <vibrocontact/reduction/stiffness_solver.h>

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

  /// What is known of a solid body and its reduction before anything is made.
  struct ReductionSize
  {
    double n_dofs = 0;
    /// scene/mesh_compactness.h: 1 for a cube
    double compactness = 1;
    /// of the contact, 0 without
    double n_rows = 0;
    /// 0: no modes
    double n_modes = 0;
    /// the modes up to a frequency are counted before they are sought
    bool counts_first = false;
    /// the stress of its loads belongs to its stiffness (reduction/prestressed_body.h)
    bool prestressed = false;
  };

  /// What the reduction of a solid body costs, told from its size. Quadratic hexahedra, measured on cubes up to 1 million
  /// dofs (doc/scale.md), the shipped wheel (287,175) and rail (199,785) with MUMPS and METIS; c is the compactness:
  ///
  ///     matrices, mesh       4 kB per dof
  ///     factors              21 c n^(4/3) entries, each 11 bytes with the workspace of MUMPS
  ///     approximate factors  4.5 bytes for each of these entries, of which about half are kept
  ///     operations           0.2 e^(3/2) for e entries; approximate 2.6e12 (n / 1e6)^1.4 c^(3/2)
  ///     count of modes       a second factorisation that keeps nothing: 0.7 of the first
  ///     prestress            a factorisation before, and a count of negative eigenvalues if direct
  ///     modes                3 vectors per mode (the basis is twice as long as what is sought) and 19 blocks of 8; if
  ///                          iterative, with a second search
  ///     contact compliance   two dense matrices of the size of its rows; if iterative, five steps for each column, in
  ///                          blocks of 32
  struct ReductionCost
  {
    std::vector<ReductionStage> stages;
    StiffnessSolver solver = StiffnessSolver::direct;
    /// largest over the stages, and what stays when they are done [byte]
    double peak = 0, kept = 0;
  };

  ReductionCost reduction_cost(const ReductionSize &size, StiffnessSolver solver = StiffnessSolver::direct);

  /// The same of a body that is solved wave by wave around its axle, measured on the section of the shipped wheel (3,900
  /// dofs, cubic): 40 ms for each number of waves, with modes and without. One number is held in memory at a time.
  /// @param n_waves that the compliance is summed over, 0: no contact; @param with_modes of some 24 numbers of waves
  ReductionCost revolved_cost(double n_dofs, double n_waves, bool with_modes);

  /// The same of a periodic rail, measured on the shipped section (813 dofs, quadratic): 2 s for the waves of the section under
  /// a contact, 0.13 s for each frequency of its poles, 1.5 s for each of a frequency response, with its decay rates along the track.
  /// @param n_rows of the contact, 0 without; @param n_of_poles, n_of_response frequencies, shared out over the ranks
  ReductionCost track_cost(double n_dofs, double n_rows, double n_of_poles, double n_of_response);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/base/dense.h>

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A Floquet multiplier mu of a cycle of period T: what a small disturbance is multiplied with in a period.
  struct Multiplier
  {
    std::complex<double> value;
    /// ln |mu| / T [1/s], positive: it grows; |arg mu| / (2 pi T), known up to whole frequencies of the cycle [Hz]
    double growth = 0, frequency = 0;
  };

  struct CycleStability
  {
    /// of each pair one, the largest first, without the trivial one
    std::vector<Multiplier> multipliers;
    /// |mu - 1| of the disturbance along the cycle, which is 1
    double trivial_error = 0;
    /// growth that this is worth [1/s]: rates are known no better
    double uncertainty = 0;
    /// "stable"; "neutral": the largest growth is less than the uncertainty; else what the largest multiplier does: "fold",
    /// "period doubling", "torus"
    std::string verdict() const;
    /// Whether small disturbances die out; nothing: neutral.
    std::optional<bool> decided() const;
    bool is_stable() const { return decided() == true; }
    bool is_unstable() const { return decided() == false; }
  };

  /// The direction of the motion is taken out of the matrix, so that the other multipliers are left: the eigenvector of the trivial one,
  /// or, where another one has met it, that of the rate.
  /// @param monodromy derivative of the state after a period, of what lasts that long @param rate of the motion there
  /// @throws ConvergenceError if LAPACK finds no eigenvalues
  CycleStability cycle_stability(const DenseMatrix &monodromy, const DenseVector &rate, double period);
} // namespace vibrocontact

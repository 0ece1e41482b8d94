#pragma once

#include <vibrocontact/analyses/periodic/balance.h>

#include <complex>

namespace vibrocontact
{
  enum class StabilityMethod
  {
    none,
    monodromy,
    hill
  };

  /// Largest Floquet multiplier of the motion that the balance evaluated last. Two sources:
  ///
  /// - Real positive ones leave the unit circle where the branch turns. Whether their number above one is odd is the sign of
  ///   det R_c against that of very fast growth, so that stability changes exactly at folds. Their value is the zero of
  ///   PeriodicBalance::growth_determinant(), between growth rates where its signs differ.
  /// - The others come from a monodromy matrix: SlipMap on its own closed motion before rigid stops without relaxation,
  ///   impulses at the samples otherwise, Hill's method from there at stops that relax and where it is asked for.
  ///
  /// On a closed motion of SlipMap a real one far from one is taken from there, too, if it lies on the side that the sign says.
  /// @param mode_limit of impulses at samples: modes above so many times the frequency answer statically
  /// @throws ConvergenceError if the samples are too few for the fastest motion in contact
  std::complex<double> largest_multiplier(const PeriodicBalance &balance, StabilityMethod method,
                                          double mode_limit, unsigned int hill_harmonics);
} // namespace vibrocontact

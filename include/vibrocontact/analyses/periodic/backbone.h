#pragma once

#include <vibrocontact/analyses/periodic/response_curve.h>

#include <vector>

namespace vibrocontact
{
  /// Undamped, unforced periodic motions against a stop over their frequency: the nonsmooth modes, to which response curves
  /// of little damping and force cling (Legrand et al.; doc/theory.md, "Continuation and stability").
  ///
  /// Time could begin anywhere; a phase condition on the contact force of the first point, Im c_1 = 0 (its first harmonic is
  /// largest at phase 0), takes the place of the excitation: the amplitude of the force sin(2 pi f t) is one more unknown and
  /// comes out as zero, since without damping it would do work.
  struct Backbone
  {
    /// excitation.amplitude: what came out of the force, zero to the tolerance
    std::vector<BranchPoint> points;
    /// frequencies where no motion was found [Hz]
    std::vector<double> missed;
  };

  /// Where a harmonic meets a natural frequency of the body in flight, or of the body held at the stop (its force moves
  /// nothing there), the branch of so many harmonics leaves into a narrow tongue (internal_resonances()). Steps of the
  /// frequency go past it, each from the motion before or from a pulse at phase 0 that just closes the gap.
  ///
  /// @param balance by Fourier functions, of a body without damping
  /// @param first, last: frequencies [Hz], both above the first natural frequency for a gap > 0
  /// @throws InputError if the bases are not Fourier's
  Backbone follow_backbone(PeriodicBalance &balance, double first, double last, unsigned int n_points);

  /// A harmonic of the motion meets a natural frequency.
  struct InternalResonance
  {
    /// of the motion [Hz]
    double frequency;
    unsigned int harmonic, mode;
  };

  /// In order of frequency. @param natural frequencies [Hz] in flight, or held at the stop
  std::vector<InternalResonance> internal_resonances(const std::vector<double> &natural, double least,
                                                     double most, unsigned int n_harmonics);
} // namespace vibrocontact

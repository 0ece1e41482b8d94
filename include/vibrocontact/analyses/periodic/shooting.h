#pragma once

#include <vibrocontact/analyses/periodic/period_map.h>

namespace vibrocontact
{
  struct ShootingSettings
  {
    /// per period; 0: doubled until two solutions agree to `refinement`
    unsigned int n_steps = 0;
    /// Gauss points of a step: order 2 n_nodes in contact
    unsigned int n_nodes = 8;
    /// where the states are compared; negative: in the middle of the longest flight
    double phase = -1;
    /// largest |P(x) - x| / |x|; largest change of state and tip by a doubling of the steps, relative
    double tolerance = 1e-10, refinement = 1e-11;
    unsigned int max_iterations = 40;
    /// periods of motion before the first iteration
    unsigned int n_settling = 3;
  };

  /// [begin, end) in phases; end may exceed 1.
  struct ContactInterval
  {
    double begin, end;
  };

  /// A periodic motion, and all that others compare with.
  struct ShootingSolution
  {
    /// the map that it is a fixed point of; gives samples of `orbit` by its at()
    std::shared_ptr<const PeriodMap> map;
    /// where, and the state there
    double phase = 0;
    std::vector<double> state;
    Orbit orbit;
    std::vector<ContactInterval> contacts;
    /// contact force times time over a period [N s]; rms over the period of the energy of body and law [J]
    double impulse = 0, energy_norm = 0;
    /// derivative of the state after a period with respect to the state
    DenseMatrix monodromy;
    /// |P(x) - x| / |x|; change by the last doubling of the steps, 0 if it was not asked for
    double periodicity = 0, refinement = 0;
    unsigned int iterations = 0;
    double seconds = 0;

    MotionSample at(const double at_phase) const { return map->at(orbit, at_phase); }
  };

  /// A state at a phase; empty: motion without contact.
  struct ShootingStart
  {
    double phase = 0;
    std::vector<double> state;
  };

  /// Periodic motion by shooting: Newton's method on P(x) - x = 0 with the exact derivative of the period map P.
  ///
  /// @throws ConvergenceError if it does not converge
  ShootingSolution shoot(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law,
                         const HarmonicForce &force, const ShootingSettings &settings = {},
                         const ShootingStart &start = {});

  /// The same on a given map and phase, from a state; nothing is settled or refined. For branches of solutions.
  ShootingSolution shoot(std::shared_ptr<const PeriodMap> map, double phase, const std::vector<double> &start,
                         double tolerance = 1e-10, unsigned int max_iterations = 40);

  /// Floquet multipliers: eigenvalues of the monodromy matrix, the largest first.
  std::vector<std::complex<double>> floquet_multipliers(const DenseMatrix &monodromy);

  /// P(x; f) - x and its derivatives, for the continuation of branches in frequency.
  struct ShootingResidual
  {
    std::vector<double> value, by_frequency;
    DenseMatrix by_state;
  };
  /// by_frequency by central differences of 1e-6 f, for which the map is exact enough to leave 1e-9 of it.
  ShootingResidual shooting_residual(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law,
                                     const HarmonicForce &force, unsigned int n_steps, double phase,
                                     const std::vector<double> &x);

  /// What integrating in time from rest until the motion repeats leaves (stop of the paper: relative rms change of the tip's
  /// displacement between two periods below 1e-7).
  struct SettledMotion
  {
    unsigned int n_periods = 0;
    /// rms change of the tip over the last period; rms distance to the solution; both over the rms of the tip
    double change = 0, error = 0;
  };
  /// @throws ConvergenceError if `most_periods` are not enough
  SettledMotion settle(const ShootingSolution &solution, double stop = 1e-7,
                       unsigned int most_periods = 100000);
} // namespace vibrocontact

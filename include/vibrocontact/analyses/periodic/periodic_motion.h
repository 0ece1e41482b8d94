#pragma once

#include <vibrocontact/analyses/periodic/balance.h>

#include <vector>

namespace vibrocontact
{
  /// One period of a contact point at equal phases, phase 0 where the exciting force rises through zero; u > 0 towards the
  /// stop.
  struct PointHistory
  {
    /// [m], [m/s], [N]
    std::vector<double> displacement, velocity, contact_force;
    /// with friction: displacement and force on the body along both tangential directions
    std::vector<double> tangential_displacement[2], tangential_force[2];
  };

  /// A periodic motion in samples, and what is read off it.
  struct PeriodicMotion
  {
    std::vector<double> phase;
    std::vector<PointHistory> points;
    /// energy of the body and of the contact springs [J]; empty of a body known by its poles
    std::vector<double> energy;
    /// of the first point [m]
    double tip_max = 0, tip_min = 0;
    /// largest displacement beyond the gap, any point [m]
    double penetration = 0;
    /// of a period, by point [N s]
    std::vector<double> impulse;
    /// rms over the period of the energy [J]
    double energy_norm = 0;
  };

  /// Samples a solution of the balance. Energy: sum over modes (q'^2 + w^2 q^2) / 2, r^T S^-1 r / 2 of what the contact rows
  /// move by residual flexibility S (complete if the force acts on a contact point), and the contact law's own. Velocity of
  /// Haar functions as sampled_velocity().
  /// @param n_samples phases i / n_samples; a power of two for Daubechies' functions
  PeriodicMotion sample_motion(const PeriodicBalance &balance, const PeriodicSolution &solution,
                               unsigned int n_samples);

  /// |difference / size|; 0 if nothing differs, 1 if there is nothing to differ from
  double relative(double difference, double size);
  /// rms(a - b) / rms(b), as relative()
  double relative_error(const std::vector<double> &a, const std::vector<double> &b);
} // namespace vibrocontact

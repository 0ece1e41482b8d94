#pragma once

#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>
#include <vibrocontact/marching/probes.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A quantity at the ends of the steps of a period.
  struct CycleSignal
  {
    /// with its unit, as column of a table
    std::string name;
    std::vector<double> values;
    /// without corners, as velocities are and contact forces are not: extremes may lie between samples
    bool is_smooth = false;

    double mean() const;
    /// half the distance from least to largest
    double amplitude() const;
    /// about the mean
    double rms() const;
    /// amplitudes of the harmonics 0, 1, ..., of 0 the mean without its sign
    std::vector<double> harmonics() const;
  };

  /// A period of a cycle.
  struct CyclePeriod
  {
    std::vector<double> time;
    /// of each contact the normal force and the tangential ones on its first body, in its own directions
    std::vector<CycleSignal> forces;
    /// of all contacts
    CycleSignal stick_points, contact_points;
    /// powers: taken by friction, brought by the creepage, into body 1 by its velocity in place [W]
    CycleSignal friction_power, creepage_power, power_into_body_1;
    /// velocities of the probes [m/s]
    std::vector<CycleSignal> probes;

    /// The axial velocity of a wheel's rim, else that of the first probe; null: there are none.
    const CycleSignal *main_velocity() const;
    /// What a cycle is compared by: the same, or the force that changes most where there are no probes or the motion does not move it.
    const CycleSignal &main_signal() const;
    /// Force or velocity of a name that a period of the scene has.
    const CycleSignal &signal(const std::string &name) const;
    /// Whether another one of the scene is the same motion, as far as steps tell: its length to 1e-3, means, amplitudes and rms of forces and
    /// velocities to 1e-2 of the largest amplitude of them.
    bool is_same(const CyclePeriod &other) const;
  };

  /// The signals of a scene, without values yet.
  CyclePeriod silent_period(const PlacedContacts &contacts, const std::vector<Probe> &probes);
  /// Adds a state at a time after the begin of the period [s].
  void hear(const DynamicState &state, double time, const ContactPair &pair, const std::vector<Probe> &probes,
            CyclePeriod &period);

  /// Goes once more through a cycle that was found.
  /// @throws ConvergenceError, InputError if the contact reaches the end of its grid
  CyclePeriod listen_to_cycle(CycleMap &map, const LimitCycle &cycle, const ContactPair &pair,
                              const ContactSections &sections, const std::vector<Probe> &probes);
} // namespace vibrocontact

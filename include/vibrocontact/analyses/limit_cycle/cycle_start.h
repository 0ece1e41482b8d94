#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_map.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <complex>
#include <optional>

namespace vibrocontact
{
  /// The shape of an unstable root as a motion about the equilibrium.
  class RootMotion
  {
  public:
    /// @param equilibrium at rest, with the slips of its contact
    RootMotion(const CycleMap &map, const ContactPair &pair, const DynamicState &equilibrium,
               const StabilityRoot &root);

    /// The equilibrium, and the shape at such a velocity of the point that it moves fastest along the contact [m/s].
    DenseVector state(double velocity) const;
    /// Makes a motion larger or smaller, until velocity_in() is this [m/s].
    void scale(DenseVector &state, double velocity) const;
    /// How much of the shape's motion is in a state [m/s].
    double velocity_in(const DenseVector &state) const { return std::abs(amplitude_in(state)); }
    /// Where a state is on the way from the shape to the shape a quarter of a period later and on [rad].
    double phase_of(const DenseVector &state) const { return std::arg(amplitude_in(state)); }
    /// Both as one number, which turns forwards in a free motion [m/s].
    std::complex<double> amplitude_in(const DenseVector &state) const;
    /// Energy of that part, but for a factor that all roots have [J].
    double energy_in(const DenseVector &state) const
    {
      return std::norm(amplitude_in(state)) * shape.norm_sqr();
    }

    /// least slip of the loaded points at the equilibrium [m/s]: from such velocities on they stick
    double least_slip = 0;

  private:
    unsigned int n_motion;
    /// the equilibrium; the shape at unit velocity, and a quarter of a period later
    DenseVector equilibrium, shape, later;
  };

  /// A state near the cycle that a root grows to: velocities are tried until a motion of a few periods neither grows nor decays.
  struct CycleStart
  {
    DenseVector state;
    /// of the shape [m/s], growth there [1/s] and time that the motion takes to come round [s]
    double velocity = 0, growth = 0, period = 0;
  };
  /// @throws ConvergenceError if motions of all velocities tried grow, or all decay, or a step does not converge
  CycleStart start_of_cycle(CycleMap &map, const RootMotion &motion, const StabilityRoot &root);

  /// The same by few harmonics (CycleBalance), which are tried from motions of several velocities that have gone on for a few periods: much
  /// cheaper than to wait for growth to end. Nothing: none of them leads to a motion of its size.
  /// @param at_rest the equilibrium
  std::optional<CycleStart> start_by_harmonics(CycleMap &map, const RootMotion &motion,
                                               const StabilityRoot &root, const DynamicState &at_rest);

  /// A motion that takes about as long as the root's to come round. @throws ConvergenceError if it is rest, or a step does not converge
  CycleStart start_at(CycleMap &map, const RootMotion &motion, const StabilityRoot &root,
                      const DynamicState &state);

  /// The same by few harmonics of its contact forces: what a motion has beside them, as modes that hardly move the contact, is not in
  /// these. Nothing: it leads to no motion of its size.
  std::optional<CycleStart> start_by_harmonics_of(CycleMap &map, const RootMotion &motion,
                                                  const StabilityRoot &root, const DynamicState &at_rest,
                                                  const CycleStart &start);

  /// Of the roots that oscillate the one in whose shape a motion has the most energy. @throws ConvergenceError if there is none
  StabilityRoot nearest_root(const CycleMap &map, const ContactPair &pair, const DynamicState &equilibrium,
                             const std::vector<StabilityRoot> &roots, const DynamicState &state);

  /// Lets a motion go on for so many of its periods. @throws ConvergenceError
  void let_go_on(CycleMap &map, const RootMotion &motion, unsigned int n_periods, CycleStart &start);
} // namespace vibrocontact

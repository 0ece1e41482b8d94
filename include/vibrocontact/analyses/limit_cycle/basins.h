#pragma once

#include <vibrocontact/analyses/limit_cycle/basin_parameters.h>
#include <vibrocontact/analyses/limit_cycle/cycle_start.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A cycle as one that motions start from and go to.
  struct CycleOfBasin
  {
    /// in the results
    unsigned int number = 0;
    /// at its begin
    DynamicState state;
    StabilityRoot root;
    double period = 0;
    /// false: small disturbances grow out of it, so that no motion ends there; nothing: not known, of a neutral one
    std::optional<bool> is_stable;
  };

  /// A motion that starts between two cycles.
  struct BasinPath
  {
    std::array<unsigned int, 2> between = {{0, 0}};
    /// of the way from the first to the second where it starts
    double share = 0;
    /// ends of windows [s]; how much of the motion of each cycle is in them, over that of the cycle itself
    std::vector<double> time;
    std::vector<std::vector<double>> parts;
    /// the cycle that is left; nothing: none by then
    std::optional<unsigned int> winner;
    /// why it was followed no further before a cycle had won
    std::string message;
    double seconds = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      bool is_decided = winner.has_value();
      unsigned int who = winner.value_or(0);
      archive &between &share &time &parts &is_decided &who &message &seconds;
      if (is_decided)
        winner = who;
    }
  };

  /// Follows motions until one cycle is left.
  ///
  /// Time passes in windows of 20 periods of the slowest cycle. How much of a cycle is in one is what its frequency has, by a
  /// Hann window, in the amplitude of the shape of its root (RootMotion). A cycle has won when all parts are those of the cycle
  /// itself to a twentieth, and not farther from them than in the window before.
  class BasinMarch
  {
  public:
    /// All but the cycles are referred to. @param window map of a window_of() the cycles, of all points that may touch
    /// @throws ConvergenceError if a cycle is not followed for a window, or two are not told apart
    BasinMarch(CycleMap &window, const ContactPair &pair, const DynamicState &at_rest,
               const std::vector<CycleOfBasin> &cycles, const BasinParameters &parameters);

    BasinPath follow(const std::array<unsigned int, 2> &between, double share);

    std::optional<bool> is_stable(const unsigned int cycle) const { return cycles[cycle].is_stable; }
    /// of each cycle, of the shape of its root [m/s]
    std::vector<double> velocities;

  private:
    /// Of each cycle's motion in a window [m/s]: what its frequency has, and root mean square, of the amplitude of its root's shape.
    struct Velocities
    {
      std::vector<double> at_frequency, rms;
    };
    /// Goes on for a window.
    Velocities velocities_over_window(DenseVector &state);
    std::optional<unsigned int> winner_of(const BasinPath &path) const;
    /// Velocities to parts.
    void make_relative(std::vector<double> &parts) const;
    /// How far parts are from those of a cycle, the largest difference.
    double distance_from(unsigned int cycle, const std::vector<double> &parts) const;

    CycleMap &window;
    const BasinParameters &parameters;
    const std::vector<CycleOfBasin> cycles;
    const double length;
    DenseVector equilibrium;
    /// of the cycles: their begin without the equilibrium; their roots
    std::vector<DenseVector> motions;
    std::vector<RootMotion> roots;
    /// of each cycle itself: one its own, and of another one where shapes and frequencies are alike
    std::vector<std::vector<double>> own_parts;
  };

  /// Before cycles are sought. @param roots that they are sought from
  /// @throws InputError if time or steps of the motions do not suit them
  void check_basins(const std::vector<StabilityRoot> &roots, const BasinParameters &parameters);

  /// Length of a window [s], and in how many steps.
  double window_of(const std::vector<CycleOfBasin> &cycles);
  unsigned int steps_of_window(double length, const BasinParameters &parameters);

  /// Where on the way from one cycle to another starts begin to lead elsewhere.
  struct BasinBorder
  {
    std::array<unsigned int, 2> between = {{0, 0}};
    /// shares of neighbours, and who wins from them
    double low = 0, high = 0;
    std::array<unsigned int, 2> winners = {{0, 0}};
    /// Parts of the cycles near the unstable motion that divides the basins: of the motions from both neighbours in their mean, where
    /// they change least before they part. Several parts: it has several frequencies. Empty: only one of both was followed.
    std::vector<double> dividing;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &between &low &high &winners &dividing;
    }
  };

  struct BasinsBetween
  {
    /// by their share
    std::vector<BasinPath> paths;
    std::vector<BasinBorder> borders;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &paths &borders;
    }
  };

  /// Starts between two cycles at equal distances, and then halfway between neighbours that lead to different cycles, until they are
  /// BasinParameters::border apart. A cycle that is known to be stable is its own winner, one that is known to be unstable none's.
  BasinsBetween basins_between(BasinMarch &march, const std::array<unsigned int, 2> &between,
                               const BasinParameters &parameters);
} // namespace vibrocontact

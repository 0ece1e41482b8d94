#pragma once

#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/run/prepare_pair.h>
#include <vibrocontact/run/sweep_cases.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// The contacts of a case, at its own lateral position.
  PlacedContacts contacts_of_case(const SweepCase &one);

  /// The bodies of a case as stability takes them, without any equilibrium.
  struct PairOfCase
  {
    ContactPair pair;
    /// Stability/Loss = hysteretic
    std::optional<HystereticLoss> loss;
    const HystereticLoss *loss_or_null() const { return loss ? &*loss : nullptr; }
  };
  /// @param reduced_bodies null for bodies without mesh @param with_dampers of a wheel
  PairOfCase pair_of_case(const SweepCase &one, const std::optional<MeasuredData> &measured,
                          const std::vector<const ReducedBody *> &reduced_bodies,
                          const MeshedBodies &meshed_bodies, bool with_dampers = true);

  /// Section Rolling with the hub as it applies to the bodies.
  RollingParameters rolling_of_case(const SweepCase &one);

  /// Whether an entry changes friction, load or creepage alone, and no body.
  bool keeps_bodies(const std::string &entry);

  /// Bodies of the cases, each reduced once. Collective.
  class ReducedOfCases
  {
  public:
    explicit ReducedOfCases(const std::vector<MeshedBodies> &bodies) : bodies(bodies), reduced(bodies.size())
    {
    }
    /// @param with_poles of periodic rails, without which only known roots are followed
    void prepare(unsigned int k, bool with_poles = true);
    /// whether prepare() has succeeded
    bool has(const unsigned int k) const { return !reduced[k].empty(); }
    /// Null for bodies without mesh. @throws ConvergenceError if it has not
    const std::vector<const ReducedBody *> &of(unsigned int k) const;

  private:
    const std::vector<MeshedBodies> &bodies;
    std::map<const MeshedBody *, ReducedBody> all_reduced;
    /// with poles or at rest
    std::map<std::pair<const TrackBody *, bool>, ReducedBody> all_tracks;
    /// of each case, its bodies; empty: prepare() failed
    std::vector<std::vector<const ReducedBody *>> reduced;
  };

  /// A case with what its roots are followed by.
  struct SolvedCase
  {
    StabilityResult result;
    /// of the modes that the shapes of the roots are amplitudes of; empty: the roots were followed, and the path of each is the
    /// number of the root in the last case before that has them
    std::vector<std::string> labels;
    std::vector<double> omega;
    /// largest |F x| / (|F| |x|) of followed roots [-]
    double residual = 0;
    /// at the beginning of a row that was solved completely in place of following: why
    std::string not_followed;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &result &labels &omega &residual &not_followed;
    }
  };
} // namespace vibrocontact

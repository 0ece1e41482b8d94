#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/prepare_pair.h>

#include <memory>
#include <optional>
#include <string>

namespace vibrocontact
{
  /// Bodies that move in time, and what their periodic rails lose by the poles they move with.
  struct PairInTime
  {
    std::unique_ptr<const PreparedPair> prepared;
    /// of each unstable root frequency and growth, with the exact receptance and by the poles; null without a periodic rail
    nlohmann::ordered_json roots = nullptr;
    /// which growth the poles miss by more than 3 %, the worst, and what to do, in a sentence; empty: none
    std::string wrong = "";
  };

  /// The bodies of a scene for analyses whose losses are those of poles and modes. Beside a periodic rail the roots of the
  /// rolling equilibria are found with its exact receptance and hysteretic loss first; its passive poles then follow it in bands of
  /// +-2 % about those that grow, the four nearest at least. A root that grows by these poles alone gets a band as well, and where
  /// growth is off by more than 2 % the poles have to come nearer, in at most four fits, the last one that changes something. What is off by more
  /// than 3 % then is PairInTime::wrong: what moves with them is kept, but is no answer. Collective.
  /// @throws ConvergenceError if one remains, or an equilibrium or a root is not found
  PairInTime prepare_pair_in_time(const Parameters &parameters, const MeshedBodies &bodies,
                                  const std::optional<MeasuredData> &measured);
} // namespace vibrocontact

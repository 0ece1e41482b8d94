#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// results.json: title (of the file, if it has one), program (version, commit, dealii, ranks), input_files, status,
  /// complete, wall_s, finished (analyses that came to their end), not_converged and warnings (by analysis) about what did
  /// not converge and what is doubtful, messages of both, interrupted if a signal stopped the run,
  /// answers (what the terminal ends with), analyses with one object per analysis, reductions with one per meshed body.
  ///
  /// Analyses fill `analyses` ("modes", "quasi_static_rolling", ...) with plain numbers, lists and objects
  /// under the names of the interface, SI units in the names; Hz for frequencies. Filled on every rank,
  /// written by rank 0 through RunRecord.
  struct Results
  {
    std::string title;
    /// size and checksum of the files that entries name, by the path of the entry (base/input_files.h); not empty ones in
    /// results.json
    std::map<std::string, std::string> input_files;
    nlohmann::ordered_json analyses = nlohmann::ordered_json::object();
    /// see answers_json(); empty until the run has come to its end
    nlohmann::ordered_json answers = nlohmann::ordered_json::object();
    /// what the reductions of meshed bodies took, see reductions_json()
    nlohmann::ordered_json reductions = nlohmann::ordered_json::object();
    /// whether the run has come to its end; until then its status is "not converged"
    bool complete = false;
    /// analyses that have come to their end; a resumed run does not repeat them
    std::set<std::string> finished;
    /// signal that stopped the run (SIGTERM, SIGINT), 0: none; exit code 128 + signal
    int stopped_by = 0;
    /// A sentence about what an analysis has found; empty: about the run as a whole.
    struct Verdict
    {
      std::string analysis, message;
    };
    /// what did not converge, exit code 2; what did but is doubtful. Come by refuse() and doubt() (output/verdict.h).
    std::vector<Verdict> failures, warnings;
    bool converged() const { return failures.empty(); }
    /// the analysis that runs, which verdicts are of
    std::string running;
    /// Forgets an analysis that is computed again: that it came to its end, and what was said of it.
    void forget(const std::string &analysis);
    /// part of wall_s that the figures took; negative: none were drawn [s]
    double figures_seconds = -1;
    /// per rank, at the end of the run; empty before [MB]
    std::vector<double> peak_memory;
  };

  /// @throws ConvergenceError if a number of these analyses is not finite
  void check_finite(const nlohmann::ordered_json &analyses, const std::string &path = "analyses");

  /// Text of results.json. @throws ConvergenceError if a number is not finite
  std::string results_text(const Results &results, double wall_seconds);

  /// What the first rank has found alone, for all. Collective.
  void take_from_first_rank(nlohmann::ordered_json &object);

  /// What a results.json says about analyses that came to their end, for a run that goes on where it ended:
  /// what was said of others is left out, they are done again.
  /// @throws InputError if it is no such text
  Results results_of_text(const std::string &text);

  /// Largest resident memory of each rank so far, on every rank [MB]. Collective.
  std::vector<double> peak_memory_of_ranks();
} // namespace vibrocontact

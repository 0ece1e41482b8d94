#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// results.json: title (of the file, if it has one), program (version, commit, dealii, ranks), input_files, status,
  /// complete, wall_s, finished (analyses that came to their end), not_converged (by analysis) about what did
  /// not converge, messages about that and about what is doubtful, interrupted if a signal stopped the run,
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
    /// what did not converge: the analysis, empty for the run as a whole, and a sentence; exit code 2
    struct Failure
    {
      std::string analysis, message;
    };
    std::vector<Failure> failures;
    bool converged() const { return failures.empty(); }
    /// what did converge but is doubtful, a sentence with numbers each
    std::vector<std::string> warnings;
    /// part of wall_s that the figures took; negative: none were drawn [s]
    double figures_seconds = -1;
    /// per rank, at the end of the run; empty before [MB]
    std::vector<double> peak_memory;
  };

  /// @throws ConvergenceError if a number of these analyses is not finite
  void check_finite(const nlohmann::ordered_json &analyses, const std::string &path = "analyses");

  /// Text of results.json. @throws dealii::ExceptionBase if a number is not finite
  std::string results_text(const Results &results, double wall_seconds);

  /// What a results.json says about analyses that came to their end, for a run that goes on where it ended:
  /// the failures of others are left out, they are done again.
  /// @throws InputError if it is no such text
  Results results_of_text(const std::string &text);

  /// Largest resident memory of each rank so far, on every rank [MB]. Collective.
  std::vector<double> peak_memory_of_ranks();
} // namespace vibrocontact

#pragma once

#include <vibrocontact/run/analysis.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A number of the results of a case that its row in the table of the sweep has.
  struct MainNumber
  {
    /// with its unit, such as impulse_Ns
    std::string column;
    /// JSON pointer in Results::analyses, such as /transient/impulse_Ns; a case that has no number there leaves its cell empty
    std::string pointer;
  };

  /// The run of one case: on a SingleRank, into the folder and results that it is given.
  using PreparedRun = std::function<void(const AnalysisRun &)>;
  /// Makes what the run of a case needs of all ranks (bodies are reduced), and returns that run. Collective.
  using PrepareRun = std::function<PreparedRun(const AnalysisRun &)>;

  /// The sweep of an analysis each case of which is a run of its own: it writes what the analysis writes into sweep/<key>/<k>,
  /// its log too; what it puts into its results becomes element k of analyses.<key>_sweep.cases[], beside `swept` (the
  /// values), `folder` and `status` (`converged`, `not converged`, `failed` with its `reason`), and a row of
  /// <key>_sweep.csv has its main numbers. A case that does not converge or is refused makes the run not converged. <key>
  /// is results_key().
  std::function<std::unique_ptr<SweptAnalysis>(const AnalysisRun &)>
  swept_runs(const PrepareRun &prepare, const std::vector<MainNumber> &main_numbers);

  /// What the terminal ends with about analyses.<key>_sweep of results.json, see Answer.
  std::vector<std::string> sweep_answer(const nlohmann::ordered_json &sweep);
} // namespace vibrocontact

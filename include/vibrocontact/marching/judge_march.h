#pragma once

#include <vibrocontact/marching/march.h>
#include <vibrocontact/output/results.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Larger estimated errors make what was found by steps in time a failure [-].
  constexpr double most_step_error = 0.2;
  /// So does what its energy account leaves open, as a share of the energy that there was [-].
  constexpr double most_open_energy = 0.05;

  /// Estimated errors as a march tells and is judged by them.
  struct ErrorReport
  {
    struct Part
    {
      /// in results.json; of what, on the screen
      std::string key, of_what;
      /// relative [-], and what it is relative to [N], if that is said
      double error, size = 0;
    };

    /// name of the analysis and of its section
    std::string analysis, section;
    /// the second march, empty: there is none
    std::string method;
    std::vector<Part> parts;
  };

  /// On the screen and in the analysis' object of results.json: error_estimate and the keys of the parts.
  /// @return whether the errors are known
  bool say_errors(const MarchErrors &errors, const ErrorReport &report, nlohmann::ordered_json &json);
  /// Errors beyond most_step_error are a failure. @param advice a sentence behind it, or nothing
  void judge_errors(const MarchErrors &errors, const ErrorReport &report, const std::string &advice,
                    Results &results);
} // namespace vibrocontact

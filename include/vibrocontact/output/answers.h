#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The answer to the question that an analysis was asked, the last that the terminal shows: what grows, how
  /// large, how sure, and the files to look at next.
  struct Answer
  {
    /// as in entry Analyses
    std::string analysis;
    /// a sentence each, the first one is the answer
    std::vector<std::string> lines;
  };

  /// What the object of an analysis in results.json answers.
  struct AnswerKind
  {
    /// of the object, and what the terminal calls it
    std::string key, analysis;
    std::vector<std::string> (*answer)(const nlohmann::ordered_json &);
    /// where to look next; names may hold one *
    std::vector<std::string> files;
  };

  /// Made of the results alone (Results::analyses), so that every analysis, also one that a resumed run found
  /// done, has its own.
  /// @param folder of the results; files that are not there are not named
  std::vector<Answer> answers(const std::vector<AnswerKind> &kinds, const nlohmann::ordered_json &analyses,
                              const std::string &folder);

  /// `answers` of results.json: lists of lines by analysis.
  nlohmann::ordered_json answers_json(const std::vector<Answer> &answers);
} // namespace vibrocontact

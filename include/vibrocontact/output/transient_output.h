#pragma once

#include <vibrocontact/analyses/transient.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Histories of the resultants on body 1, a line per output instant.
  class TransientHistory
  {
  public:
    /// @param interval distance of the lines [s], 0: every state
    TransientHistory(const ContactPair &pair, const NormalLaw &law, double interval);
    /// Keeps the state if its time has come.
    void add(const DynamicState &state);
    /// histories.h5 with one array per column; on one rank. @throws OutputError
    void write(const std::string &file_name) const;

  private:
    const ContactPair &pair;
    const NormalLaw &law;
    const double interval;
    double next = 0;
    struct Column
    {
      std::string name;
      std::vector<double> values;
    };
    std::vector<Column> columns;
  };

  /// analyses.transient of results.json: sums of the run and the forces of its last state.
  nlohmann::ordered_json transient_json(const TransientResult &result, const DynamicState &last);
} // namespace vibrocontact

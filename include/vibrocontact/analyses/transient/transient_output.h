#pragma once

#include <vibrocontact/analyses/transient/state_recorder.h>
#include <vibrocontact/base/row_file.h>
#include <vibrocontact/marching/probes.h>
#include <vibrocontact/marching/transient_result.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Histories of the resultants on body 1 and of the probes (`<probe>_displacement_m`,
  /// `<probe>_velocity_m_s`), of several contacts also their own (`<contact>_normal_force_N`, ...), a line per output
  /// instant: histories.h5 with one array per column.
  class TransientHistory : public StateRecorder
  {
  public:
    /// @param interval distance of the lines [s], 0: every state
    TransientHistory(const ContactPair &pair, const PointLaws<NormalLaw> &law, double interval,
                     const std::vector<Probe> &probes, const std::string &folder);
    /// Keeps the state if its time has come.
    void add(const DynamicState &state) override;
    void exchange(CheckpointFile &file) override;
    void finish(bool at_the_end) override { rows.finish(at_the_end); }

  private:
    const ContactPair &pair;
    const PointLaws<NormalLaw> &law;
    const double interval;
    const std::vector<Probe> &probes;
    double next = 0;
    RowFile rows;
  };

  /// histories.h5 as histories.csv. @throws OutputError
  void write_history_table(const std::vector<Probe> &probes, const PlacedContacts &contacts,
                           const std::string &folder);

  /// `contact_states` of analyses.transient: how much of the time since `begin` points stick and contact is open, and
  /// the most points that stick and touch, from histories.h5.
  nlohmann::ordered_json contact_states_json(const std::string &folder, double begin);

  /// analyses.transient of results.json: sums of the run and the forces of its last state.
  /// `contacts` has those of each contact that has a name.
  nlohmann::ordered_json transient_json(const TransientResult &result, const DynamicState &last,
                                        const PlacedContacts &contacts);

  /// What the terminal ends with about analyses.transient of results.json, see Answer.
  std::vector<std::string> transient_answer(const nlohmann::ordered_json &transient);
} // namespace vibrocontact

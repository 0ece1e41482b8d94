#pragma once

#include <vibrocontact/analyses/transient/mode_projection.h>
#include <vibrocontact/analyses/transient/state_recorder.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The amplitudes of the modes of the contact over time, mode_amplitudes.csv: 1,024 to 2,048 lines whatever
  /// the length of the run (when there are more, every second one goes and the interval doubles).
  class ModeRecorder : public StateRecorder
  {
  public:
    ModeRecorder(ModeProjection projection, std::string folder);
    void add(const DynamicState &state) override;
    void exchange(CheckpointFile &file) override;
    void finish(bool at_the_end) override;

    /// `modes[]` of analyses.transient: `column` of the table, `label`, `frequency_Hz` and `root_growth_1_s` of
    /// the root, `amplitude_begin_m_s` and `amplitude_end_m_s` of the window, `growth_1_s` (null where the
    /// amplitude does not grow or decay exponentially), `residual`, `growth_uncertainty_1_s`.
    nlohmann::ordered_json json(double from, double to) const;

  private:
    const ModeProjection projection;
    const std::string folder;
    /// a line each `every` steps
    unsigned long every = 1, steps = 0;
    /// times [s]; amplitudes [m/s], line by line
    std::vector<double> times, values;
  };
} // namespace vibrocontact

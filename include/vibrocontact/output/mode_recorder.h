#pragma once

#include <vibrocontact/analyses/mode_projection.h>
#include <vibrocontact/output/recorder.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Growth of one motion from its amplitude over time, log a = log a_0 + growth t by least squares.
  struct AmplitudeGrowth
  {
    /// and how far off it may be, what leaves the line taken as a slow wave: residual over the rms of the times [1/s]
    double growth = 0, uncertainty = 0;
    /// rms of what log a is off the line [-]: 0.01 is one percent of the amplitude
    double residual = 0;
    unsigned int n_samples = 0;
    /// a line within a few percent that is longer than its waves, on eight samples or more
    bool is_exponential() const
    {
      return n_samples >= 8 && residual <= 0.05 && uncertainty <= 0.3 * std::abs(growth);
    }
  };

  /// Of the samples from one time to another [s].
  AmplitudeGrowth amplitude_growth(const std::vector<double> &times, const std::vector<double> &amplitudes,
                                   double from, double to);

  /// The amplitudes of the modes of the contact over time, mode_amplitudes.csv: 1,024 to 2,048 lines whatever
  /// the length of the run (when there are more, every second one goes and the interval doubles).
  class ModeRecorder : public Recorder
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

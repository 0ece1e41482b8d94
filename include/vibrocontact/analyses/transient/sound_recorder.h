#pragma once

#include <vibrocontact/analyses/transient/state_recorder.h>
#include <vibrocontact/marching/probes.h>
#include <vibrocontact/marching/sound_stream.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The velocity of every probe as sound while time runs: `<probe>_velocity.wav`.
  class SoundRecorder : public StateRecorder
  {
  public:
    /// @param step of the run [s] @param full_scale [m/s]
    SoundRecorder(const std::vector<Probe> &probes, const std::string &folder, double step,
                  double full_scale);
    void add(const DynamicState &state) override;
    void exchange(CheckpointFile &file) override;
    void finish(bool at_the_end) override;
    /// `sound` of each signal that is that of a probe. @param signals list of signals_json()
    void add_to(nlohmann::ordered_json &signals) const;

  private:
    const std::vector<Probe> &probes;
    const double full_scale;
    std::vector<SoundStream> streams;
    bool is_whole = false;
  };
} // namespace vibrocontact

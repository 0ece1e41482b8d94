#include <vibrocontact/analyses/transient/sound_recorder.h>

namespace vibrocontact
{
  namespace
  {
    std::string signal_of(const Probe &probe)
    {
      return probe.name + "_velocity";
    }
  } // namespace

  SoundRecorder::SoundRecorder(const std::vector<Probe> &probes, const std::string &folder, const double step,
                               const double full_scale)
      : probes(probes), full_scale(full_scale)
  {
    for (const Probe &probe : probes)
      streams.emplace_back(folder + "/" + signal_of(probe) + ".wav", 0., step, full_scale);
  }

  void SoundRecorder::add(const DynamicState &state)
  {
    for (std::size_t k = 0; k < probes.size(); ++k)
      streams[k].add(probes[k].velocity(state));
  }

  void SoundRecorder::exchange(CheckpointFile &file)
  {
    for (std::size_t k = 0; k < probes.size(); ++k)
      streams[k].exchange("sounds/" + probes[k].name, file);
  }

  void SoundRecorder::finish(const bool at_the_end)
  {
    is_whole = at_the_end;
    for (SoundStream &stream : streams)
      stream.finish(at_the_end);
  }

  void SoundRecorder::add_to(nlohmann::ordered_json &signals) const
  {
    for (nlohmann::ordered_json &signal : signals)
      for (std::size_t k = 0; k < probes.size(); ++k)
        if (signal["name"] == signal_of(probes[k]))
          signal["sound"] = {{"file", signal_of(probes[k]) + (is_whole ? ".wav" : ".wav.part")},
                             {"full_scale_m_s", full_scale},
                             {"largest_m_s", streams[k].largest()}};
  }
} // namespace vibrocontact

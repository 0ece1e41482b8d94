#include <vibrocontact/analyses/transient/signal_recorder.h>
#include <vibrocontact/base/hdf5_file.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    std::vector<std::string> columns(const std::vector<Probe> &probes)
    {
      std::vector<std::string> names = {"time_s"};
      for (const Probe &probe : probes)
        names.push_back(probe.name + "_velocity_m_s");
      return names;
    }
  } // namespace

  SignalRecorder::SignalRecorder(const std::vector<Probe> &probes, const std::string &folder)
      : probes(probes), rows(folder + "/signals", columns(probes)), row(1 + probes.size())
  {
  }

  void SignalRecorder::add(const DynamicState &state)
  {
    if (!probes.empty())
    {
      row[0] = state.time;
      for (unsigned int k = 0; k < probes.size(); ++k)
        row[1 + k] = probes[k].velocity(state);
      rows.add(row);
    }
    if (changed)
      return;
    change = state.time;
    const int n = std::count(state.contact.status.begin(), state.contact.status.end(), ContactStatus::stick);
    changed = n_stick >= 0 && n != n_stick;
    n_stick = n_stick < 0 ? n : n_stick;
  }

  void SignalRecorder::exchange(CheckpointFile &file)
  {
    rows.exchange("signals", file);
    file("signals/change", change);
    file("signals/changed", changed);
    file("signals/n_stick", n_stick);
  }

  void SignalRecorder::finish(const bool at_the_end)
  {
    if (!probes.empty())
      rows.finish(at_the_end);
  }

  std::vector<NamedSignal> recorded_signals(const std::vector<Probe> &probes, const std::string &folder)
  {
    std::vector<NamedSignal> signals;
    if (!probes.empty())
    {
      Hdf5Reader steps(folder + "/signals.h5");
      const std::vector<double> times = steps.numbers("time_s");
      for (const Probe &probe : probes)
      {
        const std::string name = probe.name + "_velocity";
        signals.push_back({name, "m/s", equally_spaced(times, steps.numbers(name + "_m_s")), true});
      }
    }
    Hdf5Reader lines(folder + "/histories.h5");
    std::vector<NamedSignal> forces;
    const std::vector<double> line_times = lines.numbers("time_s");
    for (const std::string name : {"normal_force", "tangential_force_x", "tangential_force_y"})
      forces.push_back({name, "N", equally_spaced(line_times, lines.numbers(name + "_N")), false});
    for (NamedSignal &force : by_strength(std::move(forces)))
      signals.push_back(std::move(force));
    return signals;
  }
} // namespace vibrocontact

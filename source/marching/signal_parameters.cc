#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/marching/signal_parameters.h>

#include <algorithm>
#include <iomanip>
#include <optional>
#include <regex>
#include <sstream>

namespace vibrocontact
{
  void SignalParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Probes", probes,
        "Motions that are recorded, separated by semicolons: NAME: BODY X Y Z along DIRECTION, the place in "
        "the contact frame (the nearest point of the surface is taken), the direction x, y, z or three "
        "numbers; or rim: every wheel's rim, axially and radially; empty: none. Units: m.",
        Anything());
    prm.add_parameter("Table", table, "Write the histories as histories.csv too. Units: none.", Bool());
    prm.add_parameter(
        "Patch interval", patch_interval,
        "Distance of the frames of the contact patch in fields/patch_<k>.vtu; 0: none. Units: s.",
        Double(0, 1e9));
    prm.add_parameter("Patch begin", patch_begin, "Time of the first frame of the patch. Units: s.",
                      Double(0, 1e9));
    windows.declare_parameters(prm, "when the number of sticking points first changes, or the end");
    prm.add_parameter("Mode amplitudes", n_modes,
                      "So many modes of the contact, linearised about the equilibrium that the run starts "
                      "from, are followed "
                      "by their amplitudes in mode_amplitudes.csv: those of the largest growth rates, and "
                      "the perturbed one; "
                      "0: none. Units: none.",
                      Integer(0, 1000));
    prm.add_parameter("Sound", sound, "Write the velocity of each probe as WAV file. Units: none.", Bool());
    prm.add_parameter(
        "Sound full scale", sound_full_scale,
        "Velocity that is 1.0 in the WAV files, which then grow while time runs; 0: they are written "
        "at the end, with the largest velocity at 0.9. Units: m/s.",
        Double(0, 1e6));
  }

  namespace
  {
    /// of a sound in single precision [m/s]
    constexpr double least_full_scale = 1e-20;
    /// of the contact patch; more are a mistake in a unit
    constexpr unsigned int most_frames = 5000;

    void check_frames(const SignalParameters &signals, const TransientParameters &transient)
    {
      std::ostringstream text;
      const double frames = 1 + std::floor((transient.end_time - signals.patch_begin) /
                                               std::max(transient.least_step(), signals.patch_interval) +
                                           1e-6);
      if (signals.patch_begin > transient.end_time)
        text << "Transient/Signals/Patch begin is " << signals.patch_begin << " s, but Transient/End time is "
             << transient.end_time << " s, so that there would be no frame: let it begin earlier.";
      else if (signals.patch_begin > 0 && signals.patch_interval == 0)
        text << "Transient/Signals/Patch begin is " << signals.patch_begin
             << " s, but there are no frames without a Patch interval: give it.";
      else if (signals.patch_interval > 0 && frames > most_frames)
        text << "Transient/Signals/Patch interval is " << signals.patch_interval << " s, which makes "
             << std::fixed << std::setprecision(0) << frames << " files of the contact patch, more than "
             << most_frames << ": make it longer or let Patch begin be later.";
      if (!text.str().empty())
        throw InputError(text.str());
    }
  } // namespace

  void SignalParameters::check(const std::vector<std::string> &bodies,
                               const TransientParameters &transient) const
  {
    check_frames(*this, transient);
    if (sound_full_scale > 0 && sound_full_scale < least_full_scale)
      throw InputError(
          "Transient/Signals/Sound full scale is below 1e-20 m/s, over which velocities are no numbers of "
          "a sound: make it larger.");
    if (streams_sound() && transient.adapts_steps())
      throw InputError(
          "Transient/Signals/Sound full scale lets sounds grow with the run, which needs steps of one "
          "length, but Transient/Error tolerance makes them differ: leave one of both out.");
    windows.check("Transient", transient.least_step(), transient.end_time);
    for (const ProbeRequest &probe : parse_probes(probes))
      if (!probe.name.empty() && std::find(bodies.begin(), bodies.end(), probe.body) == bodies.end())
        throw InputError("Transient/Signals/Probes: probe '" + probe.name + "' is on '" + probe.body +
                         "', whose motion away from its contact points is not known; " +
                         name_suggestion(probe.body, bodies));
  }

  std::vector<ProbeRequest> parse_probes(const std::string &text)
  {
    static const std::regex form(
        R"(\s*([A-Za-z]\w*)\s*:\s*([^\s:;]+)\s+(\S+)\s+(\S+)\s+(\S+)\s+along\s+(.*?)\s*)");
    const auto number = [](const std::string &word, const std::string &item)
    {
      const std::optional<double> value = finite_number(word);
      if (!value)
        throw InputError("Transient/Signals/Probes: '" + word + "' in '" + item +
                         "' is no number; write for instance head: rail 0.3 0 0 along z.");
      return *value;
    };
    std::vector<ProbeRequest> probes;
    std::istringstream items(text);
    for (std::string item; std::getline(items, item, ';');)
    {
      std::istringstream words(item);
      std::string word, next;
      words >> word;
      if (word.empty())
        continue;
      ProbeRequest probe;
      if (word == "rim" && !(words >> next))
      {
        probes.push_back(probe);
        continue;
      }
      std::smatch match;
      if (!std::regex_match(item, match, form))
        throw InputError(
            "Transient/Signals/Probes: '" + item +
            "' is no probe; write NAME: BODY X Y Z along DIRECTION, for instance head: rail 0.3 0 0 "
            "along z, or rim.");
      probe.name = match[1];
      probe.body = match[2];
      for (unsigned int d = 0; d < 3; ++d)
        probe.place[d] = number(match[3 + d], item);
      const std::string direction = match[6];
      if (const auto axis = std::string("xyz").find(direction); direction.size() == 1 && axis < 3)
        probe.direction[axis] = 1;
      else
      {
        std::istringstream parts(direction);
        std::vector<std::string> found;
        for (std::string part; parts >> part;)
          found.push_back(part);
        if (found.size() != 3)
          throw InputError("Transient/Signals/Probes: the direction of '" + item +
                           "' has to be x, y, z or three numbers.");
        for (unsigned int d = 0; d < 3; ++d)
          probe.direction[d] = number(found[d], item);
        if (!(probe.direction.norm() > 0))
          throw InputError("Transient/Signals/Probes: the direction of '" + item + "' is zero.");
        probe.direction /= probe.direction.norm();
      }
      for (const ProbeRequest &other : probes)
        if (other.name == probe.name)
          throw InputError("Transient/Signals/Probes: the name '" + probe.name +
                           "' is given twice; name each probe differently.");
      probes.push_back(probe);
    }
    return probes;
  }
} // namespace vibrocontact

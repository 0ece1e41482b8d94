#include <vibrocontact/analyses/transient/transient_output.h>
#include <vibrocontact/base/hdf5_file.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    std::vector<std::string> history_columns(const std::vector<Probe> &probes, const PlacedContacts &contacts)
    {
      std::vector<std::string> names = {
          "time_s",      "normal_force_N", "tangential_force_x_N", "tangential_force_y_N",
          "approach_m",  "smallest_gap_m", "contact_points",       "stick_points",
          "slip_points", "stored_energy_J"};
      for (const Probe &probe : probes)
      {
        names.push_back(probe.name + "_displacement_m");
        names.push_back(probe.name + "_velocity_m_s");
      }
      for (const PlacedContact &contact : contacts.all)
        for (const char *const column : {"normal_force_N", "tangential_force_x_N", "tangential_force_y_N"})
          if (!contact.name.empty())
            names.push_back(contact.name + "_" + column);
      return names;
    }
  } // namespace

  TransientHistory::TransientHistory(const ContactPair &pair, const PointLaws<NormalLaw> &law,
                                     const double interval, const std::vector<Probe> &probes,
                                     const std::string &folder)
      : pair(pair), law(law), interval(interval), probes(probes),
        rows(folder + "/histories", history_columns(probes, pair.interface.contacts))
  {
  }

  void TransientHistory::add(const DynamicState &state)
  {
    if (state.time < next * (1 - 1e-12))
      return;
    next += interval;
    const unsigned int n = pair.n_points();
    const PlacedContacts &contacts = pair.interface.contacts;
    const std::vector<std::array<double, 3>> forces = contacts.resultants(state.R);
    const std::array<double, 3> force = contacts.force_on(0, forces);
    const ContactSolution &contact = state.contact;
    const auto count = [&](const ContactStatus status)
    { return double(std::count(contact.status.begin(), contact.status.end(), status)); };
    const double stick = count(ContactStatus::stick), slip = count(ContactStatus::slip);
    const double gap =
        contact.y.size() == 0 ? 0 : *std::min_element(contact.y.begin(), contact.y.begin() + n);
    std::vector<double> line = {
        state.time, force[2],     force[0], force[1], contact.approach,
        gap,        stick + slip, stick,    slip,     stored_energy(pair, law, state)};
    for (const Probe &probe : probes)
    {
      line.push_back(probe.displacement(state));
      line.push_back(probe.velocity(state));
    }
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
      if (!contacts.all[k].name.empty())
        line.insert(line.end(), forces[k].begin(), forces[k].end());
    rows.add(line);
  }

  void TransientHistory::exchange(CheckpointFile &file)
  {
    file("histories/next", next);
    rows.exchange("histories", file);
  }

  void write_history_table(const std::vector<Probe> &probes, const PlacedContacts &contacts,
                           const std::string &folder)
  {
    write_rows_as_table(folder + "/histories", history_columns(probes, contacts), "",
                        {"Histories of a transient, a line per output instant",
                         "normal force > 0 compression; tangential forces act on body 1; probes: along their "
                         "direction, against the held boundary"},
                        folder + "/histories.csv");
  }

  nlohmann::ordered_json contact_states_json(const std::string &folder, const double begin)
  {
    Hdf5Reader file(folder + "/histories.h5");
    const std::vector<double> time = file.numbers("time_s"), touching = file.numbers("contact_points"),
                              sticking = file.numbers("stick_points");
    double n = 0, open = 0, stick = 0, most_touching = 0, most_sticking = 0;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (time[i] >= begin)
      {
        ++n;
        open += touching[i] == 0;
        stick += sticking[i] > 0;
        most_touching = std::max(most_touching, touching[i]);
        most_sticking = std::max(most_sticking, sticking[i]);
      }
    if (n == 0)
      return nlohmann::ordered_json::object();
    return {{"window_s", {begin, time.back()}},
            {"stick_part", stick / n},
            {"open_part", open / n},
            {"most_stick_points", most_sticking},
            {"most_contact_points", most_touching}};
  }

  nlohmann::ordered_json transient_json(const TransientResult &result, const DynamicState &last,
                                        const PlacedContacts &contacts)
  {
    const std::vector<std::array<double, 3>> forces = contacts.resultants(last.R);
    const std::array<double, 3> force = contacts.force_on(0, forces);
    const EnergyAccount &energy = result.energy;
    const double steps = std::max<double>(1, result.steps);
    nlohmann::ordered_json json = {{"steps", result.steps},
                                   {"time_s", result.time},
                                   {"seconds_per_step", result.seconds / steps},
                                   {"iterations_per_step", result.iterations / steps},
                                   {"factorisations_per_step", result.factorisations / steps},
                                   {"fallbacks", result.fallbacks},
                                   {"rejected_steps", result.rejected},
                                   {"steps_above_tolerance", result.above_tolerance},
                                   {"impulse_Ns", result.impulse},
                                   {"rms_normal_force_N", result.rms_force()},
                                   {"smallest_gap_m", result.smallest_gap},
                                   {"energy",
                                    {{"initial_J", energy.initial},
                                     {"input_J", energy.input()},
                                     {"stored_J", energy.stored},
                                     {"friction_J", energy.friction},
                                     {"damping_J", energy.damping},
                                     {"numerical_J", energy.numerical()},
                                     {"imbalance_J", energy.imbalance()},
                                     {"available_J", energy.available},
                                     {"numerical_modes_J", energy.numerical_modes},
                                     {"numerical_upwind_J", energy.numerical_upwind},
                                     {"numerical_rate_J", energy.numerical_rate},
                                     {"creepage_J", energy.creepage},
                                     {"transport_J", energy.transport},
                                     {"hub_J", energy.hub},
                                     {"loads_J", energy.loads}}},
                                   {"last",
                                    {{"normal_force_N", force[2]},
                                     {"tangential_force_N", {force[0], force[1]}},
                                     {"approach_m", last.contact.approach}}},
                                   {"histories", "histories.h5"}};
    if (!result.converged)
      json["ended_early"] = result.message;
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
    {
      if (contacts.all[k].name.empty())
        continue;
      const ForceSums &sums = result.contacts[k];
      json["contacts"][contacts.all[k].name] = {
          {"impulse_Ns", sums.impulse},
          {"rms_normal_force_N", result.time > 0 ? std::sqrt(sums.force_square / result.time) : 0.},
          {"smallest_gap_m", sums.smallest_gap},
          {"last", {{"normal_force_N", forces[k][0]}, {"tangential_force_N", {forces[k][1], forces[k][2]}}}}};
    }
    return json;
  }

  namespace
  {
    /// change over the last 20 periods above which a cycle is not called steady, and below which it is: a change of the
    /// first in 20 periods of 1 kHz is 60 % in a second, of the second 5 %
    constexpr double unsteady_drift = 1e-2, steady_drift = 1e-3;
    /// spread of the amplitudes from period to period above which it beats
    constexpr double beating_spread = 5e-2;
    /// above which it is said though the motion repeats itself
    constexpr double differing_spread = 1e-2;
    /// a force that varies less, over the rms normal force, is not said
    constexpr double least_swing = 1e-4;
    /// of the mean square, above which a line is not what the signal is
    constexpr double most_slow_part = 0.5;

    std::string cycle_text(const nlohmann::ordered_json &signal)
    {
      using namespace answer_parts;
      std::string level;
      if (is_given(signal, "level_dB"))
        level = text(", level %.1f dB (rms re %g m/s)", number(signal, "level_dB"),
                     number(signal, "level_reference_m_s"));
      const double slow = number(signal, "slow_part");
      if (slow > most_slow_part)
        return text("%s: %.4g %s (rms) are slower than two periods in the last part of the run (see "
                    "Transient/Signals/Spectrum duration)",
                    word(signal, "name").c_str(), number(signal, "rms") * std::sqrt(slow),
                    word(signal, "unit").c_str()) +
               level;
      const nlohmann::ordered_json &cycle = signal["cycle"];
      const double amplitude = number(cycle, "amplitude"), drift = number(cycle, "drift"),
                   spread = number(cycle, "spread");
      std::string line = text("%s: %.6g Hz, amplitude %.4g %s", word(signal, "name").c_str(),
                              number(cycle, "frequency_Hz"), amplitude, word(signal, "unit").c_str()) +
                         level;
      const double periods = number(cycle, "periods");
      const std::string change = text("%+.2g %% over the last %.0f periods", 100 * drift, periods);
      if (drift > 1 || drift < -0.5)
        line += text("; NOT steady: over the last %.0f periods the amplitude %s to %.2g times what it was",
                     periods, drift > 0 ? "grows" : "falls", 1 + drift);
      else if (std::abs(drift) > unsteady_drift)
        line += "; NOT steady: " + change;
      else if (spread > beating_spread)
        line += text("; not steady: it beats, amplitudes differ by %.2g %%", 100 * spread);
      else if (std::abs(drift) > steady_drift)
        line += "; still changes: " + change +
                text(", at this rate %+.2g %% a second",
                     100 * std::expm1(std::log1p(drift) / periods * number(cycle, "frequency_Hz")));
      else
        line += "; steady (" + change + ")" +
                (spread > differing_spread
                     ? text(", amplitudes of its periods differ by up to %.2g %%", 100 * spread)
                     : "");
      return line;
    }

    std::string text_without_cycle(const nlohmann::ordered_json &transient)
    {
      using namespace answer_parts;
      bool varies = false;
      for (const Json &signal : list(transient, "signals"))
        varies = varies || (signal.value("varies", false) && !signal.contains("cycle"));
      const Json last = transient.value("last", Json::object());
      std::string line =
          varies ? "no oscillation of several periods, four steps or more each, in the last part of the run"
                 : "nothing oscillates in the last part of the run";
      line += text("; at its end the normal force is %.6g N", number(last, "normal_force_N"));
      const Json tangential = last.value("tangential_force_N", Json::array());
      if (tangential.size() == 2 && number(transient, "friction") > 0)
        line += text(", the tangential force (%.6g, %.6g) N", tangential[0].get<double>(),
                     tangential[1].get<double>());
      return line;
    }
  } // namespace

  std::vector<std::string> transient_answer(const nlohmann::ordered_json &transient)
  {
    using namespace answer_parts;
    Lines lines;
    for (const Json &signal : list(transient, "signals"))
      if (signal.contains("cycle") && (lines.empty() || word(signal, "name") == "normal_force") &&
          (word(signal, "unit") != "N" ||
           number(signal["cycle"], "amplitude") > least_swing * number(transient, "rms_normal_force_N")))
        lines.push_back(cycle_text(signal));
    if (lines.empty())
      lines.push_back(text_without_cycle(transient));
    const Json contact = transient.value("contact_states", Json::object());
    if (is_given(contact, "stick_part"))
    {
      const double stick = number(contact, "stick_part"), open = number(contact, "open_part");
      std::string line = "in that time contact is ";
      line += open >= 1 ? "open" : open > 0 ? text("open for %.3g %%", 100 * open) : "never open";
      if (open < 1 && number(transient, "friction") > 0)
        line += stick > 0 ? text(", points stick for %.3g %% of it, up to %.0f of %.0f", 100 * stick,
                                 number(contact, "most_stick_points"), number(contact, "most_contact_points"))
                          : ", no point sticks";
      lines.push_back(line);
    }
    std::string impulse = text("normal impulse %.6g N s, rms normal force %.6g N",
                               number(transient, "impulse_Ns"), number(transient, "rms_normal_force_N"));
    impulse += is_given(transient, "estimated_error")
                   ? text("; estimated error of the steps %.2g and %.2g %%",
                          100 * number(transient, "estimated_error"),
                          100 * number(transient, "estimated_error_rms_force")) +
                         (number(transient, "friction") > 0
                              ? text(", of the rms tangential force %.2g %%",
                                     100 * number(transient, "estimated_error_rms_tangential_force"))
                              : "")
                   : "; error of the steps not estimated";
    lines.push_back(impulse);
    std::size_t n_modes = 0;
    for (const Json &mode : list(transient, "modes"))
      if (is_given(mode, "growth_1_s") && number(mode, "growth_1_s") > 0 && ++n_modes <= most_said)
        lines.push_back(text("%s: %.2f Hz grows by %.4g 1/s (stability: %.4g)", word(mode, "label").c_str(),
                             number(mode, "frequency_Hz"), number(mode, "growth_1_s"),
                             number(mode, "root_growth_1_s")));
    if (transient.contains("ended_early"))
      lines.push_back(text("ENDED EARLY, at %.6g s: ", number(transient, "time_s")) +
                      word(transient, "ended_early"));
    return lines;
  }
} // namespace vibrocontact

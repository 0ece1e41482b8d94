#include <vibrocontact/analyses/limit_cycle/branch_output.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_output.h>
#include <vibrocontact/marching/signal_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace vibrocontact
{
  using namespace nlohmann::literals;

  namespace
  {
    /// harmonics that are listed
    constexpr unsigned int most_harmonics = 40;

    /// Amplitudes of the harmonics 0, 1, ... of a periodic signal.
    std::vector<double> harmonics_of(const CycleSignal &signal)
    {
      const unsigned int n = signal.values.size();
      std::vector<double> values = signal.values;
      std::vector<std::complex<double>> lines(n / 2 + 1);
      const fftw_plan plan = fftw_plan_dft_r2c_1d(
          n, values.data(), reinterpret_cast<fftw_complex *>(lines.data()), FFTW_ESTIMATE);
      fftw_execute(plan);
      fftw_destroy_plan(plan);
      std::vector<double> amplitudes;
      for (unsigned int k = 0; k < lines.size(); ++k)
        amplitudes.push_back(std::abs(lines[k]) * (k == 0 || 2 * k == n ? 1. : 2.) / n);
      return amplitudes;
    }

    /// Those that tables have, in their order.
    std::vector<const CycleSignal *> signals_of(const CyclePeriod &period)
    {
      std::vector<const CycleSignal *> signals;
      for (const CycleSignal &force : period.forces)
        signals.push_back(&force);
      for (const CycleSignal &probe : period.probes)
        signals.push_back(&probe);
      return signals;
    }

    nlohmann::ordered_json signal_json(const CycleSignal &signal)
    {
      return {{"name", signal.name},
              {"mean", signal.mean()},
              {"amplitude", signal.amplitude()},
              {"rms", signal.rms()},
              {"first_harmonic", harmonics_of(signal).at(1)}};
    }
  } // namespace

  double CycleSignal::mean() const
  {
    double sum = 0;
    for (const double value : values)
      sum += value;
    return sum / values.size();
  }

  double CycleSignal::amplitude() const
  {
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    return (*largest - *least) / 2;
  }

  double CycleSignal::rms() const
  {
    const double about = mean();
    double sum = 0;
    for (const double value : values)
      sum += (value - about) * (value - about);
    return std::sqrt(sum / values.size());
  }

  CyclePeriod listen_to_cycle(CycleMap &map, const LimitCycle &cycle, const ContactPair &pair,
                              const ContactSections &sections, const std::vector<Probe> &probes)
  {
    CyclePeriod period;
    const PlacedContacts &contacts = pair.interface.contacts;
    for (const PlacedContact &one : contacts.all)
      for (const char *const name : {"normal_force_N", "tangential_force_x_N", "tangential_force_y_N"})
        period.forces.push_back({(one.name.empty() ? "" : one.name + "_") + name, {}});
    period.stick_points.name = "stick_points";
    period.contact_points.name = "contact_points";
    period.friction_power.name = "friction_power_W";
    period.creepage_power.name = "creepage_power_W";
    period.power_into_body_1.name = "power_into_body_1_W";
    for (const Probe &probe : probes)
      period.probes.push_back({probe.name + "_velocity_m_s", {}});
    const auto listen = [&](const DynamicState &state)
    {
      period.time.push_back((period.time.size() + 1) * cycle.period / cycle.n_steps);
      const unsigned int n = pair.n_points();
      check_contact_in_grid(contacts, sections, map.speed(), state.contact.status);
      unsigned int stick = 0, closed = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        closed += state.R[i] > 0;
        stick += state.R[i] > 0 && state.contact.status[i] == ContactStatus::stick;
      }
      const std::vector<std::array<double, 3>> sums = contacts.resultants(state.R);
      for (unsigned int k = 0; k < period.forces.size(); ++k)
        period.forces[k].values.push_back(sums[k / 3][k % 3]);
      period.stick_points.values.push_back(stick);
      period.contact_points.values.push_back(closed);
      period.friction_power.values.push_back(state.friction_power);
      period.creepage_power.values.push_back(state.creepage_power);
      double power = 0;
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        power += pair.body[k] == 1 ? state.modal_force[k] * state.v[k] : 0.;
      period.power_into_body_1.values.push_back(power);
      for (unsigned int p = 0; p < probes.size(); ++p)
        period.probes[p].values.push_back(probes[p].velocity(state));
    };
    map.march(cycle.state, cycle.period, false, listen);
    return period;
  }

  Table cycle_table(const CyclePeriod &period)
  {
    std::vector<const CycleSignal *> signals = signals_of(period);
    for (const CycleSignal *const one : {&period.stick_points, &period.contact_points, &period.friction_power,
                                         &period.creepage_power, &period.power_into_body_1})
      signals.push_back(one);
    std::vector<std::string> columns = {"time_s"};
    for (const CycleSignal *const signal : signals)
      columns.push_back(signal->name);
    Table table(columns, {"One period of a limit cycle, at the ends of its steps",
                          "forces on the first body of each contact, in its directions; powers: taken by "
                          "friction, brought by the creepage, into the "
                          "modes of body 1"});
    for (std::size_t j = 0; j < period.time.size(); ++j)
    {
      std::vector<Table::Cell> row = {period.time[j]};
      for (const CycleSignal *const signal : signals)
        row.emplace_back(signal->values[j]);
      table.add_row(row);
    }
    return table;
  }

  Table harmonics_table(const CyclePeriod &period, const double frequency)
  {
    std::vector<std::string> columns = {"harmonic", "frequency_Hz"};
    std::vector<std::vector<double>> amplitudes;
    for (const CycleSignal *const signal : signals_of(period))
    {
      columns.push_back(signal->name);
      amplitudes.push_back(harmonics_of(*signal));
    }
    Table table(columns,
                {"Amplitudes of the harmonics of a limit cycle; harmonic 0: the mean, without sign"});
    const std::size_t n = std::min<std::size_t>(most_harmonics + 1, amplitudes.front().size());
    for (std::size_t k = 0; k < n; ++k)
    {
      std::vector<Table::Cell> row = {double(k), k * frequency};
      for (const std::vector<double> &one : amplitudes)
        row.emplace_back(one[k]);
      table.add_row(row);
    }
    return table;
  }

  nlohmann::ordered_json cycle_json(const LimitCycle &cycle, const CyclePeriod *const period,
                                    const unsigned int n_multipliers)
  {
    nlohmann::ordered_json json;
    json["root"] = {{"frequency_Hz", cycle.root.frequency},
                    {"growth_1_s", cycle.root.growth},
                    {"label", cycle.root.label}};
    json["status"] = cycle.converged ? "converged" : "not converged";
    if (!cycle.message.empty())
      json["message"] = cycle.message;
    json["steps_per_period"] = cycle.n_steps;
    json["newton_iterations"] = cycle.newton_iterations;
    json["products"] = cycle.n_products;
    json["marched_steps"] = cycle.n_marched_steps;
    json["seconds"] = cycle.seconds;
    if (!cycle.converged)
      return json;
    json["frequency_Hz"] = 1 / cycle.period;
    json["period_s"] = cycle.period;
    json["time_step_s"] = cycle.period / cycle.n_steps;
    json["residual"] = cycle.residual;
    json["change_along_motion"] = cycle.change_along;
    if (cycle.stability)
    {
      const CycleStability &stability = *cycle.stability;
      nlohmann::ordered_json &own = json["stability"];
      own["verdict"] = stability.verdict();
      own["stable"] = stability.is_stable();
      own["trivial_multiplier_error"] = stability.trivial_error;
      own["growth_uncertainty_1_s"] = stability.uncertainty;
      own["seconds"] = cycle.stability_seconds;
      own["multipliers"] = nlohmann::ordered_json::array();
      for (std::size_t k = 0; k < std::min<std::size_t>(n_multipliers, stability.multipliers.size()); ++k)
      {
        const Multiplier &one = stability.multipliers[k];
        own["multipliers"].push_back({{"real", one.value.real()},
                                      {"imaginary", one.value.imag()},
                                      {"growth_1_s", one.growth},
                                      {"frequency_Hz", one.frequency}});
      }
    }
    if (!period)
      return json;
    double stick = 0, closed = 0;
    unsigned int with_stick = 0;
    for (std::size_t j = 0; j < period->time.size(); ++j)
    {
      stick += period->stick_points.values[j];
      closed += period->contact_points.values[j];
      with_stick += period->stick_points.values[j] > 0;
    }
    json["stick_share"] = closed > 0 ? stick / closed : 0.;
    json["time_with_stick_share"] = double(with_stick) / period->time.size();
    json["friction_power_W"] = period->friction_power.mean();
    json["creepage_power_W"] = period->creepage_power.mean();
    json["power_into_body_1_W"] = period->power_into_body_1.mean();
    json["signals"] = nlohmann::ordered_json::array();
    for (const CycleSignal *const signal : signals_of(*period))
    {
      nlohmann::ordered_json one = signal_json(*signal);
      const bool is_velocity = std::any_of(period->probes.begin(), period->probes.end(),
                                           [&](const CycleSignal &probe) { return &probe == signal; });
      if (is_velocity && signal->rms() > 0)
      {
        one["level_dB"] = 20 * std::log10(signal->rms() / velocity_reference);
        one["level_reference_m_s"] = velocity_reference;
      }
      json["signals"].push_back(one);
    }
    return json;
  }

  void add_sums(nlohmann::ordered_json &limit_cycle)
  {
    unsigned int n_found = 0;
    nlohmann::ordered_json loudest;
    for (const nlohmann::ordered_json &cycle : limit_cycle.at("cycles"))
    {
      n_found += cycle.contains("frequency_Hz");
      for (const nlohmann::ordered_json &signal : answer_parts::list(cycle, "signals"))
      {
        if (!signal.contains("level_dB") || (!loudest.is_null() && signal["level_dB"] <= loudest["level_dB"]))
          continue;
        loudest = {{"frequency_Hz", cycle["frequency_Hz"]},
                   {"signal", signal["name"]},
                   {"amplitude_m_s", signal["amplitude"]},
                   {"level_dB", signal["level_dB"]},
                   {"power_into_body_1_W", cycle["power_into_body_1_W"]}};
        if (cycle.contains("/stability/multipliers/0"_json_pointer))
          loudest["largest_growth_1_s"] = cycle["stability"]["multipliers"][0]["growth_1_s"];
      }
    }
    limit_cycle["roots"] = limit_cycle.at("cycles").size();
    limit_cycle["cycles_found"] = n_found;
    if (!loudest.is_null())
      limit_cycle["loudest"] = loudest;
  }

  Table cycles_table(const nlohmann::ordered_json &cycles)
  {
    Table table({"root_frequency_Hz", "root_growth_1_s", "root_label", "status", "stability", "frequency_Hz",
                 "steps_per_period", "normal_force_amplitude_N", "time_with_stick_share", "friction_power_W",
                 "power_into_body_1_W", "largest_growth_1_s", "residual", "newton_iterations", "seconds"},
                {"Limit cycles by the unstable roots they begin from; zeros in rows that did not converge",
                 "largest growth: of a small disturbance, by the Floquet multipliers; 0 where stability is "
                 "not judged"});
    for (const nlohmann::ordered_json &one : cycles)
    {
      const auto number = [&](const std::string &place)
      {
        const nlohmann::ordered_json::json_pointer pointer(place);
        return one.contains(pointer) ? one.at(pointer).get<double>() : 0.;
      };
      table.add_row(
          {number("/root/frequency_Hz"), number("/root/growth_1_s"),
           one.at("root").at("label").get<std::string>(), one.at("status").get<std::string>(),
           one.contains("stability") ? one["stability"]["verdict"].get<std::string>() : "not judged",
           number("/frequency_Hz"), number("/steps_per_period"), number("/signals/0/amplitude"),
           number("/time_with_stick_share"), number("/friction_power_W"), number("/power_into_body_1_W"),
           number("/stability/multipliers/0/growth_1_s"), number("/residual"), number("/newton_iterations"),
           number("/seconds")});
    }
    return table;
  }

  std::vector<std::string> limit_cycle_answer(const nlohmann::ordered_json &limit_cycle)
  {
    using namespace answer_parts;
    Lines lines;
    const Json &cycles = list(limit_cycle, "cycles");
    if (cycles.empty())
    {
      lines.push_back("no root of the equilibrium grows: no cycle begins there");
      return lines;
    }
    std::size_t n_found = 0, n_stable = 0;
    for (const Json &one : cycles)
    {
      n_found += is_given(one, "frequency_Hz");
      n_stable += one.contains("stability") && one["stability"]["stable"].get<bool>();
    }
    const bool judged =
        std::any_of(cycles.begin(), cycles.end(), [](const Json &one) { return one.contains("stability"); });
    lines.push_back(text("%zu of %zu unstable roots lead to a limit cycle", n_found, cycles.size()) +
                    (judged ? text(", %zu of them stable", n_stable) : ""));
    for (std::size_t k = 0; k < std::min(cycles.size(), most_said); ++k)
    {
      const Json &one = cycles[k];
      if (!is_given(one, "frequency_Hz"))
      {
        lines.push_back(text("root at %.2f Hz: ", number(one["root"], "frequency_Hz")) +
                        word(one, "message"));
        continue;
      }
      std::string line = text("%.3f Hz", number(one, "frequency_Hz"));
      for (const Json &signal : list(one, "signals"))
        if (is_given(signal, "level_dB"))
        {
          line += ", " + word(signal, "name") +
                  text(" amplitude %.3g (%.1f dB)", number(signal, "amplitude"), number(signal, "level_dB"));
          break;
        }
      line +=
          text(", normal force +-%.3g N, some points stick for %.0f %% of the time",
               number(list(one, "signals").at(0), "amplitude"), 100 * number(one, "time_with_stick_share"));
      if (one.contains("stability"))
        line += ", " + word(one["stability"], "verdict");
      lines.push_back(line);
      if (one.contains("branch"))
        lines.push_back("  " + branch_answer(one["branch"]));
    }
    say_more(cycles.size(), "in limit_cycles.csv", lines);
    return lines;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/limit_cycle_output.h>
#include <vibrocontact/marching/signal_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace nlohmann::literals;

  namespace
  {
    /// harmonics that are listed
    constexpr unsigned int most_harmonics = 40;
    /// a signal that changes by less than this share of its size does not change
    constexpr double rounding = 1e-9;

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
              {"first_harmonic", signal.harmonics().at(1)}};
    }

    std::string start_of(const LimitCycle &cycle)
    {
      return cycle.motion.empty() ? cycle.root.label : cycle.motion;
    }

    nlohmann::ordered_json root_json(const StabilityRoot &root)
    {
      return {{"frequency_Hz", root.frequency}, {"growth_1_s", root.growth}, {"label", root.label}};
    }

    /// Share of the points in contact that stick, in the mean of a period.
    double stick_share(const CyclePeriod &period)
    {
      const double closed = period.contact_points.mean();
      return closed > 0 ? period.stick_points.mean() / closed : 0.;
    }
  } // namespace

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
      amplitudes.push_back(signal->harmonics());
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

  nlohmann::ordered_json failed_json(const LimitCycle &cycle)
  {
    nlohmann::ordered_json json = {{"start", start_of(cycle)},
                                   {"root", root_json(cycle.root)},
                                   {"message", cycle.message},
                                   {"steps_per_period", cycle.n_steps},
                                   {"newton_iterations", cycle.newton_iterations},
                                   {"seconds", cycle.seconds}};
    if (!cycle.started_by.empty())
      json["started_by"] = cycle.started_by;
    return json;
  }

  nlohmann::ordered_json stable_json(const std::optional<bool> &is_stable)
  {
    return is_stable ? nlohmann::ordered_json(*is_stable) : nlohmann::ordered_json();
  }

  nlohmann::ordered_json cycle_json(const LimitCycle &cycle, const CyclePeriod &period,
                                    const unsigned int n_multipliers)
  {
    nlohmann::ordered_json json;
    json["start"] = start_of(cycle);
    json["frequency_Hz"] = 1 / cycle.period;
    if (const CycleSignal *const rim = period.main_velocity())
      json["amplitude_m_s"] = rim->amplitude();
    json["main_signal"] = period.main_signal().name;
    if (cycle.stability)
    {
      const CycleStability &stability = *cycle.stability;
      json["stable"] = stable_json(stability.decided());
      json["multipliers"] = nlohmann::ordered_json::array();
      for (std::size_t k = 0; k < std::min<std::size_t>(n_multipliers, stability.multipliers.size()); ++k)
      {
        const Multiplier &one = stability.multipliers[k];
        json["multipliers"].push_back({{"abs", std::abs(one.value)},
                                       {"argument_rad", std::arg(one.value)},
                                       {"growth_1_s", one.growth},
                                       {"frequency_Hz", one.frequency}});
      }
      json["stability"] = {{"verdict", stability.verdict()},
                           {"trivial_multiplier_error", stability.trivial_error},
                           {"growth_uncertainty_1_s", stability.uncertainty},
                           {"seconds", cycle.stability_seconds}};
    }
    if (!cycle.not_judged.empty())
      json["not_judged"] = cycle.not_judged;
    if (cycle.residual)
      json["residual"] = *cycle.residual;
    json["seconds"] = cycle.seconds;
    json["root"] = root_json(cycle.root);
    json["period_s"] = cycle.period;
    json["steps_per_period"] = cycle.n_steps;
    json["time_step_s"] = cycle.period / cycle.n_steps;
    if (!cycle.started_by.empty())
      json["started_by"] = cycle.started_by;
    json["newton_iterations"] = cycle.newton_iterations;
    if (cycle.n_marched_steps > 0) // not of points of a branch
    {
      json["products"] = cycle.n_products;
      json["marched_steps"] = cycle.n_marched_steps;
    }
    json["change_along_motion"] = cycle.change_along;
    const std::vector<double> &stick = period.stick_points.values;
    const auto with_stick = std::count_if(stick.begin(), stick.end(), [](const double n) { return n > 0; });
    json["stick_share"] = stick_share(period);
    json["time_with_stick_share"] = double(with_stick) / period.time.size();
    json["friction_power_W"] = period.friction_power.mean();
    json["creepage_power_W"] = period.creepage_power.mean();
    json["power_into_body_1_W"] = period.power_into_body_1.mean();
    json["signals"] = nlohmann::ordered_json::array();
    for (const CycleSignal *const signal : signals_of(period))
    {
      nlohmann::ordered_json one = signal_json(*signal);
      const bool is_velocity = std::any_of(period.probes.begin(), period.probes.end(),
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

  void add_errors_json(const CycleErrors &errors, nlohmann::ordered_json &cycle)
  {
    cycle["error_estimate"] = {{"signal", errors.signal}, {"seconds", errors.seconds}};
    if (!errors.failure.empty())
    {
      cycle["error_estimate"]["message"] = errors.failure;
      return;
    }
    cycle["error_estimate"]["steps_per_period"] = errors.n_steps;
    cycle["estimated_error_frequency"] = errors.frequency;
    cycle["estimated_error_amplitude"] = errors.amplitude;
    cycle["estimated_error_first_harmonic"] = errors.first_harmonic;
  }

  nlohmann::ordered_json balance_json(const std::vector<BalancedCycle> &balanced, const CyclePeriod &period,
                                      const double period_length)
  {
    const nlohmann::ordered_json by_steps = signal_json(period.main_signal());
    const double size = std::abs(by_steps["mean"].get<double>()) + by_steps["rms"].get<double>();
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const BalancedCycle &one : balanced)
    {
      nlohmann::ordered_json json = {{"harmonics", one.n_harmonics}, {"converged", one.converged}};
      if (one.converged)
      {
        const nlohmann::ordered_json signal = signal_json(one.motion->signal(by_steps["name"]));
        json["frequency_Hz"] = 1 / one.period;
        json["signal"] = signal["name"];
        json["amplitude"] = signal["amplitude"];
        json["rms"] = signal["rms"];
        json["first_harmonic"] = signal["first_harmonic"];
        json["frequency_difference"] = period_length / one.period - 1;
        for (const std::string name : {"amplitude", "first_harmonic"})
          if (by_steps[name].get<double>() > rounding * size)
            json[name + "_difference"] = signal[name].get<double>() / by_steps[name].get<double>() - 1;
        json["stick_share"] = stick_share(*one.motion);
        json["friction_power_W"] = one.motion->friction_power.mean();
        json["power_into_body_1_W"] = one.motion->power_into_body_1.mean();
      }
      else
        json["message"] = one.message;
      if (one.residual)
        json["residual"] = *one.residual;
      json["unknowns"] = one.n_unknowns;
      json["newton_iterations"] = one.newton_iterations;
      json["products"] = one.n_products;
      json["seconds"] = one.seconds;
      list.push_back(json);
    }
    return list;
  }

  Table balance_table(const nlohmann::ordered_json &cycles)
  {
    Table table({"cycle", "harmonics", "status", "message", "frequency_Hz", "signal", "amplitude",
                 "first_harmonic", "frequency_difference", "amplitude_difference",
                 "first_harmonic_difference", "residual", "unknowns", "newton_iterations", "products",
                 "seconds"},
                {"Limit cycles by harmonic balance; differences: from the same cycle by steps, over it",
                 "amplitude and first harmonic: of the signal, in the unit that its name ends with"});
    for (const nlohmann::ordered_json &cycle : cycles)
      for (const nlohmann::ordered_json &one : answer_parts::list(cycle, "harmonic_balance"))
      {
        const auto number = [&](const char *const name) -> Table::Cell
        {
          if (one.contains(name))
            return one.at(name).get<double>();
          return std::string();
        };
        const auto word = [&](const char *const name) { return one.value(name, std::string()); };
        table.add_row({cycle.at("number").get<double>(), number("harmonics"),
                       std::string(one.at("converged").get<bool>() ? "converged" : "not converged"),
                       word("message"), number("frequency_Hz"), word("signal"), number("amplitude"),
                       number("first_harmonic"), number("frequency_difference"),
                       number("amplitude_difference"), number("first_harmonic_difference"),
                       number("residual"), number("unknowns"), number("newton_iterations"),
                       number("products"), number("seconds")});
      }
    return table;
  }

  void add_sums(const nlohmann::ordered_json &cycles, nlohmann::ordered_json &search)
  {
    const auto is_heard = [](const nlohmann::ordered_json &signal) { return signal.contains("level_dB"); };
    std::vector<const nlohmann::ordered_json *> stand;
    unsigned int n_roots_with_cycle = 0;
    for (const nlohmann::ordered_json &cycle : cycles)
      if (cycle.at("converged").get<bool>())
      {
        ++n_roots_with_cycle;
        if (!cycle.contains("same_as"))
          stand.push_back(&cycle);
      }
    bool any_heard = false;
    for (const nlohmann::ordered_json *const cycle : stand)
      for (const nlohmann::ordered_json &signal : answer_parts::list(*cycle, "signals"))
        any_heard = any_heard || is_heard(signal);
    // without probes by the first normal force
    const char *const size = any_heard ? "amplitude_m_s" : "amplitude_N";
    nlohmann::ordered_json loudest;
    for (const nlohmann::ordered_json *const one : stand)
    {
      const nlohmann::ordered_json &cycle = *one;
      for (const nlohmann::ordered_json &signal : answer_parts::list(cycle, "signals"))
      {
        const bool counts = any_heard ? is_heard(signal) : &signal == &cycle["signals"].front();
        if (!counts || (!loudest.is_null() && signal["amplitude"] <= loudest[size]))
          continue;
        loudest = {{"frequency_Hz", cycle["frequency_Hz"]},
                   {"signal", signal["name"]},
                   {size, signal["amplitude"]},
                   {"power_into_body_1_W", cycle["power_into_body_1_W"]}};
        if (any_heard)
          loudest["level_dB"] = signal["level_dB"];
        if (cycle.contains("estimated_error_amplitude"))
          loudest["estimated_error_amplitude"] = cycle["estimated_error_amplitude"];
        if (!answer_parts::list(cycle, "multipliers").empty())
          loudest["largest_growth_1_s"] = cycle["multipliers"][0]["growth_1_s"];
      }
    }
    search["roots"] = cycles.size() + search.at("not_found").size();
    search["roots_with_cycle"] = n_roots_with_cycle;
    search["cycles_found"] = stand.size();
    if (!loudest.is_null())
      search["loudest"] = loudest;
  }

  Table cycles_table(const nlohmann::ordered_json &cycles, const nlohmann::ordered_json &not_found)
  {
    Table table({"root_frequency_Hz",
                 "root_growth_1_s",
                 "root_label",
                 "status",
                 "message",
                 "stability",
                 "frequency_Hz",
                 "amplitude_m_s",
                 "steps_per_period",
                 "normal_force_amplitude_N",
                 "time_with_stick_share",
                 "friction_power_W",
                 "power_into_body_1_W",
                 "largest_growth_1_s",
                 "residual",
                 "newton_iterations",
                 "seconds",
                 "main_signal",
                 "estimated_error_frequency",
                 "estimated_error_amplitude",
                 "estimated_error_first_harmonic",
                 "number",
                 "same_as"},
                {"Limit cycles by the unstable roots they begin from, or the nearest one to the transient "
                 "that they begin from, then roots from which none was found",
                 "amplitude: axial velocity of the wheel's rim or of the first probe; largest growth: of a "
                 "small disturbance, by the Floquet multipliers; estimated errors: of the steps, relative; "
                 "number: in the names of its files, which a cycle has not that is the same as another; "
                 "empty: not known"});
    for (const nlohmann::ordered_json *const list : {&cycles, &not_found})
      for (const nlohmann::ordered_json &one : *list)
      {
        const auto number = [&](const std::string &place) -> Table::Cell
        {
          const nlohmann::ordered_json::json_pointer pointer(place);
          if (one.contains(pointer))
            return one.at(pointer).get<double>();
          return std::string();
        };
        table.add_row({number("/root/frequency_Hz"),
                       number("/root/growth_1_s"),
                       one.at("root").at("label").get<std::string>(),
                       std::string(one.value("converged", false) ? "converged" : "not converged"),
                       one.value("message", std::string()),
                       one.contains("stability") ? one["stability"]["verdict"].get<std::string>()
                                                 : std::string("not judged"),
                       number("/frequency_Hz"),
                       number("/amplitude_m_s"),
                       number("/steps_per_period"),
                       number("/signals/0/amplitude"),
                       number("/time_with_stick_share"),
                       number("/friction_power_W"),
                       number("/power_into_body_1_W"),
                       number("/multipliers/0/growth_1_s"),
                       number("/residual"),
                       number("/newton_iterations"),
                       number("/seconds"),
                       one.value("main_signal", std::string()),
                       number("/estimated_error_frequency"),
                       number("/estimated_error_amplitude"),
                       number("/estimated_error_first_harmonic"),
                       number("/number"),
                       number("/same_as")});
      }
    return table;
  }
} // namespace vibrocontact

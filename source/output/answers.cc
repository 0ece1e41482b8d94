#include <vibrocontact/output/answers.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <tuple>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    using Json = nlohmann::ordered_json;
    using Lines = std::vector<std::string>;

    /// at most so many roots, fits, bodies are said one by one
    constexpr std::size_t most_said = 6;
    /// change over the last 20 periods below which a cycle is called steady
    constexpr double steady_drift = 1e-2;
    /// spread of the amplitudes from period to period above which it beats
    constexpr double beating_spread = 5e-2;
    /// a force that varies less, over the rms normal force, is not said
    constexpr double least_swing = 1e-4;

    __attribute__((format(printf, 1, 2))) std::string text(const char *const form, ...)
    {
      char line[400];
      va_list arguments;
      va_start(arguments, form);
      std::vsnprintf(line, sizeof line, form, arguments);
      va_end(arguments);
      return line;
    }

    double number(const Json &json, const std::string &name, const double otherwise = 0)
    {
      const auto found = json.find(name);
      return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
    }

    std::string word(const Json &json, const std::string &name)
    {
      const auto found = json.find(name);
      return found != json.end() && found->is_string() ? found->get<std::string>() : "";
    }

    const Json &list(const Json &json, const std::string &name)
    {
      static const Json none = Json::array();
      const auto found = json.find(name);
      return found != json.end() && found->is_array() ? *found : none;
    }

    bool is_given(const Json &json, const std::string &name)
    {
      return json.contains(name) && json[name].is_number();
    }

    void say_more(const std::size_t n, const std::string &what, Lines &lines)
    {
      if (n > most_said)
        lines.push_back(std::to_string(n - most_said) + " more " + what);
    }

    Lines modes_answer(const Json &bodies)
    {
      Lines lines;
      for (const auto &[name, body] : bodies.items())
      {
        const Json &frequencies = list(body, "frequencies_Hz"), &labels = list(body, "labels");
        const std::size_t rigid = number(body, "n_rigid_modes");
        std::string line = name + ": " + std::to_string(frequencies.size()) + " modes";
        if (rigid > 0)
          line += ", " + std::to_string(rigid) + " of them rigid";
        if (frequencies.size() > rigid)
          line += text(", elastic from %.6g to %.6g Hz; the lowest:", frequencies[rigid].get<double>(),
                       frequencies.back().get<double>());
        for (std::size_t k = rigid; k < std::min(frequencies.size(), rigid + 3); ++k)
          line += text("%s %.6g Hz %s", k == rigid ? "" : ",", frequencies[k].get<double>(),
                       k < labels.size() ? labels[k].get<std::string>().c_str() : "");
        lines.push_back(line);
      }
      return lines;
    }

    const Json *largest(const Json &entries, const std::string &name, const double sign)
    {
      const Json *best = nullptr;
      for (const Json &one : entries)
        if (!best || sign * number(one, name) > sign * number(*best, name))
          best = &one;
      return best;
    }

    Lines frequency_response_answer(const Json &response)
    {
      Lines lines;
      const bool mobility = word(response, "quantity") == "mobility";
      const std::string quantity = mobility ? "mobility" : "receptance", unit = mobility ? "m/(N s)" : "m/N";
      const Json bodies = response.value("bodies", Json::object());
      for (const auto &[name, body] : bodies.items())
      {
        const Json &maxima = list(body, "maxima"), &minima = list(body, "minima");
        Lines said;
        if (const Json *const peak = largest(maxima, "magnitude", 1))
          said.push_back(text("largest %s %.4g %s at %.6g Hz (%s)", quantity.c_str(),
                              number(*peak, "magnitude"), unit.c_str(), number(*peak, "frequency_Hz"),
                              word(*peak, "point").c_str()));
        if (const Json *const dip = largest(minima, "magnitude", -1))
          said.push_back(text("smallest minimum %.4g %s at %.6g Hz", number(*dip, "magnitude"), unit.c_str(),
                              number(*dip, "frequency_Hz")));
        if (maxima.size() + minima.size() > 2)
          said.push_back(text("%zu maxima and %zu minima in all", maxima.size(), minima.size()));
        std::string whole = name;
        for (const std::string &part : said)
          whole += (&part == &said.front() ? ": " : "; ") + part;
        if (!said.empty())
          lines.push_back(whole);
        if (is_given(body, "n_poles"))
          lines.push_back(text("%s: Green's functions of %.0f poles", name.c_str(), number(body, "n_poles")));
        double worst = 0;
        for (const Json &one : list(body, "checks"))
          worst = std::max(worst, number(one, "error"));
        if (!list(body, "checks").empty())
          lines.push_back(
              text("%s: modes are up to %.2g %% off the direct solutions, see checks in results.json",
                   name.c_str(), 100 * worst));
      }
      return lines;
    }

    Lines rolling_answer(const Json &rolling)
    {
      const Json &cases = list(rolling, "cases");
      Lines lines;
      if (cases.empty())
        return lines;
      const Json &last = cases.back(), &force = list(last, "tangential_force_N");
      if (cases.size() > 1)
      {
        std::size_t failed = 0;
        double least = 1e300, most = -1e300;
        for (const Json &one : cases)
        {
          failed += word(one, "status") != "converged";
          least = std::min(least, number(one, "utilisation"));
          most = std::max(most, number(one, "utilisation"));
        }
        lines.push_back(text("%zu cases, utilisation of friction %.3g to %.3g%s; the last one:", cases.size(),
                             least, most,
                             failed > 0 ? (", " + std::to_string(failed) + " NOT converged").c_str() : ""));
      }
      if (number(last, "contact_points") == 0)
      {
        lines.push_back("the bodies do not touch");
        return lines;
      }
      lines.push_back(
          text("normal force %.6g N, tangential force (%.6g, %.6g) N, utilisation %.4g of friction %g%s",
               number(last, "normal_force_N"), force.size() > 0 ? force[0].get<double>() : 0.,
               force.size() > 1 ? force[1].get<double>() : 0., number(last, "utilisation"),
               number(last, "friction"), word(last, "status") == "converged" ? "" : ", NOT converged"));
      lines.push_back(
          text("largest pressure %.4g MPa, approach %.4g mm; of %.0f points in contact %.0f stick",
               1e-6 * number(last, "max_pressure_Pa"), 1e3 * number(last, "approach_m"),
               number(last, "contact_points"), number(last, "stick_points")));
      return lines;
    }

    std::string root_text(const Json &root)
    {
      std::string line =
          number(root, "frequency_Hz") > 0
              ? text("%.2f Hz, growth %+.4g 1/s", number(root, "frequency_Hz"), number(root, "growth_1_s"))
              : text("without oscillation, growth %+.4g 1/s", number(root, "growth_1_s"));
      line += ", " + (root.contains("root") ? word(root, "root") : word(root, "label"));
      return line;
    }

    /// " at friction 0.3, lateral_creepage -0.01": the swept values of a case
    std::string case_text(const Json &one)
    {
      Json values = one.value("swept", Json::object());
      if (values.empty())
        for (const char *const name : {"friction", "longitudinal_creepage", "lateral_creepage", "spin_1_m"})
          values[name] = number(one, name);
      std::string line;
      for (const auto &[name, value] : values.items())
        line += (line.empty() ? " at " : ", ") + name + " " +
                (value.is_number() ? text("%g", value.get<double>()) : value.dump());
      return line;
    }

    Lines stability_answer(const Json &stability)
    {
      Lines lines;
      const Json &cases = list(stability, "cases");
      if (cases.empty())
        return lines;
      if (cases.size() > 1)
      {
        std::size_t n_unstable = 0;
        const Json *fastest = nullptr, *fastest_case = nullptr, *nearest = nullptr, *nearest_case = nullptr;
        for (const Json &one : cases)
        {
          const Json &roots = list(one, "unstable");
          n_unstable += !roots.empty();
          const Json *const here = largest(roots, "growth_1_s", 1);
          if (here && (!fastest || number(*here, "growth_1_s") > number(*fastest, "growth_1_s")))
            std::tie(fastest, fastest_case) = std::make_pair(here, &one);
          const auto near = one.find("nearest");
          if (near != one.end() &&
              (!nearest || number(*near, "divergence_rate") > number(*nearest, "divergence_rate")))
            std::tie(nearest, nearest_case) = std::make_pair(&*near, &one);
        }
        lines.push_back(text("%zu of %zu cases have roots that grow", n_unstable, cases.size()));
        if (fastest)
          lines.push_back("the fastest: " + root_text(*fastest) + case_text(*fastest_case));
        else if (nearest)
          lines.push_back("nearest to growing: " + root_text(*nearest) + case_text(*nearest_case));
        if (const std::size_t n = list(stability, "left_out").size(); n > 0)
          lines.push_back(std::to_string(n) + " cases are left out, see left_out in results.json");
        return lines;
      }
      std::vector<Json> roots = list(cases[0], "unstable").get<std::vector<Json>>();
      std::stable_sort(roots.begin(), roots.end(),
                       [](const Json &a, const Json &b)
                       { return number(a, "growth_1_s") > number(b, "growth_1_s"); });
      if (roots.empty())
      {
        lines.push_back("nothing grows");
        if (cases[0].contains("nearest"))
          lines.push_back("nearest to growing: " + root_text(cases[0]["nearest"]));
        return lines;
      }
      lines.push_back(text("%zu root%s, the fastest a thousandfold in %.3g s:", roots.size(),
                           roots.size() == 1 ? " grows" : "s grow",
                           std::log(1e3) / number(roots[0], "growth_1_s")));
      for (std::size_t k = 0; k < std::min(roots.size(), most_said); ++k)
        lines.push_back(root_text(roots[k]));
      say_more(roots.size(), "in stability.csv", lines);
      return lines;
    }

    std::string cycle_text(const Json &signal)
    {
      const Json &cycle = signal["cycle"];
      const double amplitude = number(cycle, "amplitude"), drift = number(cycle, "drift"),
                   spread = number(cycle, "spread");
      std::string line = text("%s: %.6g Hz, amplitude %.4g %s", word(signal, "name").c_str(),
                              number(cycle, "frequency_Hz"), amplitude, word(signal, "unit").c_str());
      if (is_given(signal, "level_dB"))
        line += text(", level %.1f dB (rms re %g m/s)", number(signal, "level_dB"),
                     number(signal, "level_reference_m_s"));
      if (std::abs(drift) > steady_drift)
        line +=
            text("; NOT steady: %+.2g %% over the last %.0f periods", 100 * drift, number(cycle, "periods"));
      else if (spread > beating_spread)
        line += text("; not steady: it beats, amplitudes differ by %.2g %%", 100 * spread);
      else
        line += text("; steady (%+.1g over the last %.0f periods)", drift, number(cycle, "periods"));
      return line;
    }

    Lines transient_answer(const Json &transient)
    {
      Lines lines;
      for (const Json &signal : list(transient, "signals"))
        if (signal.contains("cycle") && (lines.empty() || word(signal, "name") == "normal_force") &&
            (word(signal, "unit") != "N" ||
             number(signal["cycle"], "amplitude") > least_swing * number(transient, "rms_normal_force_N")))
          lines.push_back(cycle_text(signal));
      if (lines.empty())
        lines.push_back(text("nothing oscillates in the last part of the run; normal force at its end %.6g N",
                             number(transient.value("last", Json::object()), "normal_force_N")));
      const Json contact = transient.value("contact_states", Json::object());
      if (is_given(contact, "stick_part"))
      {
        const double stick = number(contact, "stick_part"), open = number(contact, "open_part");
        std::string line = "in that time contact is ";
        line += open >= 1 ? "open" : open > 0 ? text("open for %.3g %%", 100 * open) : "never open";
        if (open < 1 && number(transient, "friction") > 0)
          line += stick > 0
                      ? text(", points stick for %.3g %% of it, up to %.0f of %.0f", 100 * stick,
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
      return lines;
    }

    Lines periodic_answer(const Json &solutions)
    {
      Lines lines;
      std::size_t failed = 0;
      for (const Json &one : solutions)
        failed += !one.value("converged", false);
      for (const Json &one : solutions)
      {
        const std::string name = word(one, "basis") + ":" + word(one, "weighting") +
                                 text(", %.0f functions, ", number(one, "n_functions"));
        if (!one.value("converged", false))
          lines.push_back(name + "NO solution found");
        else
        {
          lines.push_back(name + text("%.6g Hz: displacement %.5g to %.5g m", number(one, "frequency_Hz"),
                                      number(one, "tip_min_m"), number(one, "tip_max_m")));
          if (const Json &impulse = list(one, "impulse_Ns"); !impulse.empty())
            lines.back() += text(", impulse of a period %.5g N s", impulse[0].get<double>());
          if (is_given(one, "error_to_reference"))
            lines.back() += text("; error %.2g against shooting", number(one, "error_to_reference"));
        }
        break;
      }
      if (solutions.size() > 1)
        lines.push_back(
            text("%zu further solutions%s", solutions.size() - 1,
                 failed > 0 ? (", " + std::to_string(failed) + " of all without result").c_str() : ""));
      return lines;
    }

    void say_numbers(const Json &curve, const std::string &name, Lines &lines)
    {
      for (const char *const unit : {"Hz", "N", "m"})
      {
        const Json &values = list(curve, name + "_" + unit);
        if (!curve.contains(name + "_" + unit))
          continue;
        std::string line =
            std::to_string(values.size()) + " " + (name == "folds" ? "folds" : "points of grazing");
        for (std::size_t k = 0; k < std::min(values.size(), most_said); ++k)
          line += text("%s%.8g", k == 0 ? ": " : ", ", values[k].get<double>());
        if (!values.empty())
          line += std::string(values.size() > most_said ? " ... " : " ") + unit;
        lines.push_back(line);
      }
    }

    Lines response_answer(const Json &curve)
    {
      Lines lines;
      if (is_given(curve, "largest_amplitude_m"))
        lines.push_back(text("largest amplitude %.5g m at %.8g Hz", number(curve, "largest_amplitude_m"),
                             number(curve, "largest_at_Hz")));
      say_numbers(curve, "folds", lines);
      say_numbers(curve, "grazing", lines);
      lines.push_back(text("%.0f points, %s: ", number(curve, "points"),
                           curve.value("complete", false) ? "complete" : "NOT complete") +
                      word(curve, "end"));
      return lines;
    }

    Lines identification_answer(const Json &fits)
    {
      Lines lines;
      const Json *best = largest(fits, "error_E", -1);
      if (!best)
        return lines;
      lines.push_back(text("%s with %.0f pole pairs fits best: E = %.3g (worst entry)%s",
                           word(*best, "method").c_str(), number(*best, "n_pole_pairs"),
                           number(*best, "error_E"),
                           fits.size() > 1 ? text(", of %zu fits", fits.size()).c_str() : ""));
      if (best->value("target_reached", true) == false)
        lines.push_back("distrust it: the target error is not reached");
      if (number(*best, "n_unstable") > 0)
        lines.push_back(text("distrust it: %.0f poles are unstable", number(*best, "n_unstable")));
      if (!best->value("converged", true))
        lines.push_back("distrust its last digits: the poles still moved after the last iteration");
      const Json contact = best->value("contact", Json::object());
      if (!contact.empty() && !contact.value("usable", true))
        lines.push_back("not for contact: " + word(contact, "reason"));
      else if (contact.value("repaired", false))
        lines.push_back(
            text("repaired for contact: E was %.3g before", number(contact, "error_E_before_repair")));
      return lines;
    }

    Lines modal_convolution_answer(const Json &run)
    {
      Lines lines;
      double impulse = 0;
      for (const Json &one : list(run, "impulse_Ns"))
        impulse += one.get<double>();
      const std::size_t n_points = list(run, "impulse_Ns").size();
      lines.push_back(text(
          "impulse %.6g N s%s in %.4g s, %.0f impacts, %.0f releases; %.3g points closed on average", impulse,
          n_points > 1 ? text(" of %zu points together", n_points).c_str() : "", number(run, "time_s"),
          number(run, "n_impacts"), number(run, "n_releases"), number(run, "closed_points_mean")));
      if (is_given(run, "estimated_error"))
        lines.push_back(
            text("estimated error of the steps: %.2g %% of the impulse",
                 100 * number(run, "estimated_error")) +
            (is_given(run, "estimated_error_rms_force")
                 ? text(", %.2g %% of the rms force", 100 * number(run, "estimated_error_rms_force"))
                 : ""));
      return lines;
    }

    struct Kind
    {
      const char *key, *analysis;
      Lines (*answer)(const Json &);
      /// where to look next
      std::vector<std::string> files;
    };

    const std::vector<Kind> kinds = {
        {"modes", "modes", modes_answer, {"modes_*.csv", "figures/mode_shapes_*.png"}},
        {"frequency_response",
         "frequency response",
         frequency_response_answer,
         {"frequency_response_*.csv", "figures/frequency_response*.png"}},
        {"quasi_static_rolling",
         "quasi-static rolling",
         rolling_answer,
         {"rolling.csv", "contact_patch_0.csv", "figures/contact_patch_0.png", "figures/creep_curves.png"}},
        {"identification",
         "identification",
         identification_answer,
         {"identification_poles_0.csv", "identification_fit_0.csv", "figures/identification.png"}},
        {"periodic",
         "periodic",
         periodic_answer,
         {"periodic_0.csv", "periodic_errors.csv", "figures/periodic_motion.png"}},
        {"response", "response curve", response_answer, {"response.csv", "figures/response.png"}},
        {"stability",
         "stability",
         stability_answer,
         {"stability.csv", "stability_map.csv", "stability_sweep.csv", "figures/divergence_rates.png",
          "figures/stability_map.png", "figures/unstable_shapes.png"}},
        {"transient",
         "transient",
         transient_answer,
         {"histories.h5", "mode_amplitudes.csv", "figures/transient_*.png", "figures/mode_growth.png",
          "figures/spectrum_*.png", "*.wav"}},
        {"modal_convolution",
         "modal convolution",
         modal_convolution_answer,
         {"histories.h5", "impacts.csv", "third_octaves.csv", "figures/modal_convolution*.png"}}};

    /// Those there of a name with at most one *.
    Lines matching(const std::string &folder, const std::string &name)
    {
      namespace fs = std::filesystem;
      const std::size_t star = name.find('*');
      if (star == std::string::npos)
        return fs::exists(fs::path(folder) / name) ? Lines{name} : Lines{};
      Lines found;
      const fs::path parent = fs::path(name).parent_path();
      const std::string head = name.substr(0, star), tail = name.substr(star + 1);
      std::error_code none;
      for (const auto &entry : fs::directory_iterator(folder / parent, none))
      {
        const std::string one = (parent / entry.path().filename()).string();
        if (one.size() >= head.size() + tail.size() && one.compare(0, head.size(), head) == 0 &&
            one.compare(one.size() - tail.size(), tail.size(), tail) == 0)
          found.push_back(one);
      }
      std::sort(found.begin(), found.end());
      return found;
    }

    std::string look_at(const std::string &folder, const std::vector<std::string> &files)
    {
      std::string line;
      std::size_t n = 0;
      for (const std::string &name : files)
        for (const std::string &file : matching(folder, name))
          if (++n <= most_said)
            line += (line.empty() ? "look at " : ", ") + file;
      return line;
    }
  } // namespace

  std::vector<Answer> answers(const nlohmann::ordered_json &analyses, const std::string &folder)
  {
    std::vector<Answer> result;
    for (const Kind &kind : kinds)
    {
      if (!analyses.contains(kind.key) || analyses[kind.key].empty())
        continue;
      Answer answer{kind.analysis, kind.answer(analyses[kind.key])};
      if (answer.lines.empty())
        continue;
      if (const std::string files = look_at(folder, kind.files); !files.empty())
        answer.lines.push_back(files);
      result.push_back(std::move(answer));
    }
    return result;
  }

  nlohmann::ordered_json answers_json(const std::vector<Answer> &answers)
  {
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    for (const Answer &one : answers)
      result[one.analysis] = one.lines;
    return result;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/limit_cycle_answer.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>

namespace vibrocontact
{
  using namespace answer_parts;

  namespace
  {
    /// The one by which a cycle is compared.
    const Json &main_signal(const Json &cycle)
    {
      const Json &signals = list(cycle, "signals");
      return *std::find_if(signals.begin(), signals.end(),
                           [&](const Json &signal) { return signal["name"] == cycle["main_signal"]; });
    }

    /// "over Contact/Friction coefficient from 0.1, where its amplitude vanishes, to 0.6: ..."
    std::string branch_answer(const Json &branch)
    {
      const Json &points = list(branch, "points");
      const auto said_of = [](const Json &point)
      {
        const Json &signal = main_signal(point);
        return text(" (%.2f Hz, ", number(point, "frequency_Hz")) + word(signal, "name") +
               text(" %.3g)", number(signal, "amplitude"));
      };
      const auto say_end = [&](const Json &end, const Json &point)
      {
        std::string said = text("%.6g", number(end, "value")), why = word(end, "kind");
        if (why == "vanishes" && is_given(end, "onset_of_root"))
          said = text("its onset at %.6g", number(end, "onset"));
        else if (why == "vanishes")
          said = text("%.6g, where its amplitude vanishes", number(end, "onset"));
        else if (why == "lost")
          said += ", where it was lost" + (end.contains("reason") ? " (" + word(end, "reason") + ")" : "");
        else if (why == "most points")
          said += ", where Limit cycle/Branch/Most points were found";
        if (is_given(end, "onset_of_root"))
          said += text(" (by its root %.6g)", number(end, "onset_of_root"));
        else if (is_given(end, "root_growth_1_s"))
          said += text(" (its root grows by %.3g 1/s there)", number(end, "root_growth_1_s"));
        return said + said_of(point);
      };
      std::string line = "over " + word(branch, "entry") + " from " +
                         say_end(branch.at("begin"), points.at(0)) + "; to " +
                         say_end(branch.at("end"), points.at(points.size() - 1));
      if (branch.contains("first_stick"))
      {
        const Json &stick = branch["first_stick"];
        line += text(stick["sticks_above"].get<bool>() ? "; sticks from %.6g on" : "; sticks up to %.6g",
                     number(stick, "value")) +
                said_of(points.at(stick["point"].get<std::size_t>()));
      }
      const Json &folds = list(branch, "folds");
      for (std::size_t k = 0; k < folds.size(); ++k)
        line += text(k == 0 ? "; turns round at %.6g" : ", %.6g", folds[k].get<double>());
      line += text("; %zu points", points.size());
      if (const double n_unstable = number(branch, "unstable_points"); n_unstable > 0)
        line += text(", %.0f of them unstable", n_unstable);
      return line;
    }

    /// "stable", or "neutral (growth -0.55 1/s, uncertain by 0.95 1/s)"
    std::string stability_answer(const Json &cycle)
    {
      const std::string verdict = word(cycle["stability"], "verdict");
      const Json &multipliers = list(cycle, "multipliers");
      if (verdict != "neutral" || multipliers.empty())
        return verdict;
      return text("neutral (growth %.2g 1/s, uncertain by %.2g 1/s)", number(multipliers[0], "growth_1_s"),
                  number(cycle["stability"], "growth_uncertainty_1_s"));
    }

    /// "harmonic balance with 20 harmonics: 917.221 Hz (+1.9e-05), ...": forces have corners, which harmonics overshoot
    std::string balance_answer(const Json &balanced)
    {
      std::string line = text("harmonic balance with %.0f harmonics: ", number(balanced, "harmonics"));
      if (!balanced["converged"].get<bool>())
        return line + "not found";
      const std::string signal = word(balanced, "signal");
      const bool by_peak = signal.size() > 4 && signal.compare(signal.size() - 4, 4, "_m_s") == 0;
      const std::string of = by_peak ? "amplitude" : "first_harmonic";
      return line +
             text("%.3f Hz (%+.1e), ", number(balanced, "frequency_Hz"),
                  number(balanced, "frequency_difference")) +
             word(balanced, "signal") + (by_peak ? " amplitude" : " first harmonic") +
             text(" %.3g", number(balanced, of)) +
             (is_given(balanced, of + "_difference") ? text(" (%+.1e)", number(balanced, of + "_difference"))
                                                     : "");
    }

    Lines from_transient_answer(const Json &search)
    {
      const Json &not_found = list(search, "not_found");
      const std::string motion =
          text("the motion of the transient at %.6g s leads to ", number(search["from_transient"], "end_s"));
      if (!not_found.empty())
        return {motion + "no limit cycle: " + word(not_found[0], "message")};
      return {motion + (number(search, "cycles_found") > 0 ? "a limit cycle" : "one that has not converged")};
    }
  } // namespace

  std::vector<std::string> limit_cycle_search_answer(const Json &search)
  {
    if (search.contains("from_transient"))
      return from_transient_answer(search);
    if (number(search, "roots") == 0)
      return {"no root of the equilibrium grows: no cycle begins there"};
    const double n_leading = number(search, "roots_with_cycle"), n_cycles = number(search, "cycles_found");
    Lines lines = {
        text("%.0f of %.0f unstable roots lead to a limit cycle", n_leading, number(search, "roots")) +
        (n_cycles < n_leading ? text(", of which %.0f differ", n_cycles) : "")};
    const Json &not_found = list(search, "not_found");
    for (std::size_t k = 0; k < std::min(not_found.size(), most_said); ++k)
      lines.push_back(text("root at %.2f Hz: ", number(not_found[k]["root"], "frequency_Hz")) +
                      word(not_found[k], "message"));
    say_more(not_found.size(), "in limit_cycles.csv", lines);
    return lines;
  }

  std::vector<std::string> limit_cycle_answer(const Json &cycles)
  {
    Lines lines;
    for (std::size_t k = 0; k < std::min(cycles.size(), most_said); ++k)
    {
      const Json &one = cycles[k];
      std::string line = text("%.3f Hz", number(one, "frequency_Hz"));
      const Json &signal = main_signal(one);
      line += ", " + word(signal, "name") + text(" amplitude %.3g", number(signal, "amplitude"));
      if (is_given(signal, "level_dB"))
        line += text(" (%.1f dB)", number(signal, "level_dB"));
      if (is_given(one, "estimated_error_amplitude"))
        line += ", errors of the steps " + percent_text(number(one, "estimated_error_frequency")) + " and " +
                percent_text(std::max(number(one, "estimated_error_amplitude"),
                                      number(one, "estimated_error_first_harmonic")));
      if (word(signal, "name") != word(list(one, "signals").at(0), "name"))
        line += text(", normal force +-%.3g N", number(list(one, "signals").at(0), "amplitude"));
      const double stick = number(one, "time_with_stick_share");
      line +=
          stick > 0 ? ", some points stick for " + percent_text(stick) + " of the time" : ", no point sticks";
      if (one.contains("stability"))
        line += ", " + stability_answer(one);
      if (one.contains("same_as"))
        line += text(", the same as cycle %.0f", number(one, "same_as"));
      if (one.contains("message"))
        line += ", NOT converged: " + word(one, "message");
      lines.push_back(line);
      if (const Json &balanced = list(one, "harmonic_balance"); !balanced.empty())
        lines.push_back("  " + balance_answer(*std::max_element(balanced.begin(), balanced.end(),
                                                                [](const Json &a, const Json &b) {
                                                                  return a["harmonics"] < b["harmonics"];
                                                                })));
      if (one.contains("branch"))
        lines.push_back("  " + branch_answer(one["branch"]));
    }
    say_more(cycles.size(), "in limit_cycles.csv", lines);
    return lines;
  }
} // namespace vibrocontact

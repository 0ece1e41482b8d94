#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/marching/judge_march.h>
#include <vibrocontact/output/verdict.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  bool say_errors(const MarchErrors &errors, const ErrorReport &report, nlohmann::ordered_json &json)
  {
    const auto unknown = [](const std::string &why)
    {
      run_log().value("estimated error of the steps", why);
      return false;
    };
    if (report.method.empty())
      return unknown("not asked for (" + report.section + "/Error estimate)");
    json["error_estimate"] = {{"method", report.method}, {"until_s", errors.time}};
    if (!errors.failure.empty())
      return unknown("unknown: " + report.method + " ended early: " + errors.failure);
    if (errors.time <= 0)
      return unknown("unknown: too few steps for " + report.method);
    for (const ErrorReport::Part &part : report.parts)
      if (!std::isfinite(part.error))
        return unknown("unknown: that of the " + part.of_what + " is not finite");
    for (const ErrorReport::Part &part : report.parts)
    {
      json[part.key] = part.error;
      if (part.error != 0 || part.size != 0)
        run_log().value("estimated error of the " + part.of_what,
                        percent_text(part.error) +
                            (part.size != 0 ? " of " + number_text(part.size) + " N" : ""));
    }
    return true;
  }

  void judge_errors(const MarchErrors &errors, const ErrorReport &report, const std::string &advice,
                    Results &results)
  {
    if (errors.time <= 0 || std::all_of(report.parts.begin(), report.parts.end(),
                                        [](const auto &part) { return part.error <= most_step_error; }))
      return;
    std::string text;
    for (const ErrorReport::Part &part : report.parts)
      text += (text.empty() ? "" : ", ") + percent_text(part.error) + " of the " + part.of_what;
    refuse("The " + report.analysis + "'s steps are too long for its result: the error is estimated at " +
               text + ", from " + report.method + "." + advice,
           results);
  }
} // namespace vibrocontact

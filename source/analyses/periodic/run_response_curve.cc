#include <vibrocontact/analyses/periodic/response_output.h>
#include <vibrocontact/analyses/periodic/run_response_curve.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/verdict.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    void reverse(ResponseCurve &curve)
    {
      std::reverse(curve.points.begin(), curve.points.end());
      std::reverse(curve.folds.begin(), curve.folds.end());
      std::reverse(curve.grazing.begin(), curve.grazing.end());
    }

    /// appends in the order of the branch
    void append(ResponseCurve &curve, const ResponseCurve &rest)
    {
      curve.points.insert(curve.points.end(), rest.points.begin(), rest.points.end());
      curve.folds.insert(curve.folds.end(), rest.folds.begin(), rest.folds.end());
      curve.grazing.insert(curve.grazing.end(), rest.grazing.begin(), rest.grazing.end());
      curve.n_spurious += rest.n_spurious;
      curve.seconds += rest.seconds;
      curve.stability_seconds += rest.stability_seconds;
    }

    /// A curve that is broken somewhere.
    ResponseCurve from_both_ends(ResponseCurve curve, ResponseCurve rest)
    {
      reverse(rest);
      curve.n_first = curve.points.size();
      append(curve, rest);
      curve.reason = "from the first value: " + curve.reason + "; from the last value: " + rest.reason;
      return curve;
    }

    /// Both ways from a start inside of the range become one curve; a closed one is whole after the first.
    ResponseCurve joined(ResponseCurve back, const ResponseCurve &forth)
    {
      reverse(back);
      if (!back.points.empty() && !forth.points.empty())
        back.points.pop_back();
      append(back, forth);
      back.reason += "; " + forth.reason;
      back.complete = back.complete && forth.complete;
      return back;
    }

    /// folds lie within millihertz of each other
    std::string precise(const double value, const std::string &unit)
    {
      std::ostringstream text;
      text << std::setprecision(10) << value << " " << unit;
      return text.str();
    }

    void tell(const ResponseCase &solved, const std::string &unit)
    {
      Log &log = run_log();
      log.value("basis", solved.settings.trial + ":" + solved.settings.weighting + ", " +
                             std::to_string(solved.settings.n_functions) + " functions");
      log.value("points", double(solved.curve.points.size()));
      for (const double value : solved.curve.folds)
        log.value("fold", precise(value, unit));
      for (const double value : solved.curve.grazing)
        log.value("grazing", precise(value, unit));
      if (solved.curve.n_spurious > 0)
        log.value("turns without amplitude or contact changing", solved.curve.n_spurious);
      log.value("end", solved.curve.reason);
      log.value("time", solved.curve.seconds, "s");
    }
  } // namespace

  void run_response_curve(const PeriodicParameters &periodic, const ForcedBody &body,
                          const PointLaws<NormalLaw> &law, const std::string &law_name,
                          const std::vector<double> &friction, const std::string &folder, Results &results)
  {
    const BranchParameters &response = periodic.continuation;
    const std::string unit = response.parameter == "frequency" ? "Hz"
                             : response.parameter == "force"   ? "N"
                                                               : "m";
    run_log().block("Response curve");
    const std::vector<BalanceSettings> asked = periodic.curves(friction);
    nlohmann::ordered_json main, variants = nlohmann::ordered_json::array();
    for (unsigned int k = 0; k < asked.size(); ++k)
    {
      ResponseCase solved{asked[k], law_name, {}};
      const auto follow = [&](const BranchSettings &settings)
      {
        PeriodicBalance balance(body, law, asked[k]);
        balance.set_force({periodic.force, periodic.frequency});
        return follow_response(balance, settings);
      };
      const std::vector<BranchSettings> ways = response.settings();
      solved.curve = follow(ways[0]);
      if (ways.size() > 1 && solved.curve.end != Curve::End::closed)
        solved.curve = joined(solved.curve, follow(ways[1]));
      else if (ways.size() == 1 && !solved.curve.is_whole())
      {
        // what lies behind a tongue of an undamped last function, or behind a kink that is not passed
        BranchSettings back = ways[0];
        back.start = response.last;
        back.direction = -back.direction;
        ResponseCurve rest = follow(back);
        if (rest.end == Curve::End::parameter_limit &&
            rest.points.back().value(rest.parameter) == response.first)
        {
          reverse(rest);
          rest.seconds += solved.curve.seconds;
          solved.curve = rest;
        }
        else
          solved.curve = from_both_ends(solved.curve, rest);
      }
      tell(solved, unit);
      if (!solved.curve.complete)
        refuse("The response curve is not complete after " + std::to_string(solved.curve.points.size()) +
                   " points: " + solved.curve.reason + ".",
               results);
      const std::string table = k == 0 ? "response.csv" : "response_" + std::to_string(k) + ".csv";
      on_first_rank([&] { write_response_table(solved, folder + "/" + table); });
      (k == 0 ? main : variants.emplace_back()) = response_json(solved, table);
    }
    if (!variants.empty())
      main["variants"] = variants;
    results.analyses["response"] = main;
  }
} // namespace vibrocontact

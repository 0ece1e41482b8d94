#include <vibrocontact/analyses/periodic/response_output.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    std::string kind_of(const BranchPoint &point)
    {
      switch (point.kind)
      {
      case CurvePoint::Kind::fold:
        return point.is_spurious ? "spurious fold" : "fold";
      case CurvePoint::Kind::event:
        return "grazing";
      case CurvePoint::Kind::branch_point:
        return "branch point";
      default:
        return "regular";
      }
    }
  } // namespace

  nlohmann::ordered_json response_json(const ResponseCase &solved, const std::string &table)
  {
    const ResponseCurve &curve = solved.curve;
    const std::string unit = curve.parameter == SceneParameter::frequency ? "_Hz"
                             : curve.parameter == SceneParameter::force   ? "_N"
                                                                          : "_m";
    nlohmann::ordered_json json = {{"name", solved.settings.trial + ":" + solved.settings.weighting + ", " +
                                                std::to_string(solved.settings.n_functions)},
                                   {"basis", solved.settings.trial},
                                   {"weighting", solved.settings.weighting},
                                   {"n_functions", solved.settings.n_functions},
                                   {"law", solved.law},
                                   {"table", table},
                                   {"points", curve.points.size()},
                                   {"points_before_break", curve.n_first},
                                   {"complete", curve.complete},
                                   {"end", curve.reason},
                                   {"folds" + unit, curve.folds},
                                   {"grazing" + unit, curve.grazing},
                                   {"spurious_folds", curve.n_spurious},
                                   {"seconds", curve.seconds},
                                   {"stability_seconds", curve.stability_seconds}};
    if (curve.has_stability)
    {
      nlohmann::ordered_json &at_folds = json["multiplier_at_folds"] = nlohmann::ordered_json::array();
      for (const BranchPoint &point : curve.points)
        if (point.kind == CurvePoint::Kind::fold && !point.is_spurious)
          at_folds.push_back(std::abs(point.multiplier));
    }
    const auto highest = std::max_element(curve.points.begin(), curve.points.end(),
                                          [](const BranchPoint &a, const BranchPoint &b)
                                          { return a.amplitude < b.amplitude; });
    if (highest != curve.points.end())
    {
      json["largest_amplitude_m"] = highest->amplitude;
      json["largest_at_Hz"] = highest->excitation.frequency;
    }
    return json;
  }

  void write_response_table(const ResponseCase &solved, const std::string &file_name)
  {
    const ResponseCurve &curve = solved.curve;
    Table table({"frequency_Hz", "amplitude_m", "stable", "multiplier_abs", "multiplier_real",
                 "multiplier_imag", "force_N", "gap_m", "contact_part", "kind"},
                {"Branch of periodic motions, " + solved.settings.trial + ":" + solved.settings.weighting +
                     ", " + std::to_string(solved.settings.n_functions) + " functions, in order along it",
                 "amplitude: largest |u| of the first contact point in the period; multiplier: the Floquet "
                 "multiplier "
                 "of the largest modulus, stable 1 if that is at most 1; both -1 if they were not asked for",
                 "contact_part: share of the period in contact"});
    for (const BranchPoint &point : curve.points)
    {
      const bool known = curve.has_stability;
      table.add_row({point.excitation.frequency, point.amplitude, known ? double(point.is_stable()) : -1.,
                     known ? std::abs(point.multiplier) : -1., point.multiplier.real(),
                     point.multiplier.imag(), point.excitation.amplitude, point.gap, point.active,
                     kind_of(point)});
    }
    table.write(file_name);
  }

  namespace
  {
    void say_numbers(const nlohmann::ordered_json &curve, const std::string &name,
                     std::vector<std::string> &lines)
    {
      using namespace answer_parts;
      for (const char *const unit : {"Hz", "N", "m"})
      {
        const nlohmann::ordered_json &values = list(curve, name + "_" + unit);
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
  } // namespace

  std::vector<std::string> response_answer(const nlohmann::ordered_json &curve)
  {
    using namespace answer_parts;
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
} // namespace vibrocontact

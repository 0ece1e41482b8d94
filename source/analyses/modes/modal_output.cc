#include <vibrocontact/analyses/modes/modal_output.h>
#include <vibrocontact/output/answer_parts.h>

#include <algorithm>

namespace vibrocontact
{
  nlohmann::ordered_json modal_json(const ModalResult &result)
  {
    nlohmann::ordered_json stages = nlohmann::ordered_json::object();
    for (const auto &[stage, seconds] : result.stages)
      stages[stage] = seconds;
    nlohmann::ordered_json json = {{"frequencies_Hz", result.frequencies_Hz},
                                   {"labels", result.labels},
                                   {"damping_ratio", result.damping_ratio},
                                   {"n_rigid_modes", result.n_rigid_modes},
                                   {"n_dofs", result.n_dofs},
                                   {"orthonormality_error", result.orthonormality_error},
                                   {"residual", result.residual},
                                   {"damping_coupling", result.damping_coupling},
                                   {"stages_s", stages},
                                   {"seconds", result.seconds}};
    if (result.speed != 0)
      json["rotation_rad_s"] = result.speed;
    if (!result.without_coriolis_Hz.empty())
      json["frequencies_without_coriolis_Hz"] = result.without_coriolis_Hz;
    return json;
  }

  Table modal_table(const ModalResult &result)
  {
    Table table({"frequency_Hz", "damping_ratio", "label"},
                {"Natural frequencies of " + result.body + "; rigid modes have frequency 0"});
    for (unsigned int k = 0; k < result.frequencies_Hz.size(); ++k)
      table.add_row({result.frequencies_Hz[k], result.damping_ratio[k], result.labels[k]});
    return table;
  }

  std::vector<std::string> modes_answer(const nlohmann::ordered_json &bodies)
  {
    using namespace answer_parts;
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
} // namespace vibrocontact

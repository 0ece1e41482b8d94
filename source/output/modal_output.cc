#include <vibrocontact/output/modal_output.h>

namespace vibrocontact
{
  nlohmann::ordered_json modal_json(const ModalResult &result)
  {
    nlohmann::ordered_json stages = nlohmann::ordered_json::object();
    for (const auto &[stage, seconds] : result.stages)
      stages[stage] = seconds;
    return {{"frequencies_Hz", result.frequencies_Hz},
            {"labels", result.labels},
            {"damping_ratio", result.damping_ratio},
            {"n_rigid_modes", result.n_rigid_modes},
            {"n_dofs", result.n_dofs},
            {"orthonormality_error", result.orthonormality_error},
            {"residual", result.residual},
            {"stages_s", stages},
            {"seconds", result.seconds}};
  }

  Table modal_table(const ModalResult &result)
  {
    Table table({"frequency_Hz", "damping_ratio", "label"},
                {"Natural frequencies of " + result.body + "; rigid modes have frequency 0"});
    for (unsigned int k = 0; k < result.frequencies_Hz.size(); ++k)
      table.add_row({result.frequencies_Hz[k], result.damping_ratio[k], result.labels[k]});
    return table;
  }
} // namespace vibrocontact

#include <vibrocontact/output/output_parameters.h>

#include <filesystem>

namespace vibrocontact
{
  void OutputParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Directory", directory,
        "Folder for the results; the option --output goes before it. Empty: results/<name of the "
        "parameter file>. Units: none.",
        Anything());
    prm.add_parameter(
        "Cache directory", cache_directory,
        "Folder for reductions of bodies, which later runs find again; several runs may share it. "
        "Units: none.",
        Anything());
    prm.add_parameter("Fields", fields,
                      "Write fields of the bodies and of the contact patch (VTU). Units: none.", Bool());
    prm.add_parameter(
        "Deformation", deformation,
        "Deformation and stress of meshed bodies under the last case's forces: only if this run has "
        "factorised them anyway, always (a run that found its reductions then factorises again), or never. "
        "Units: none.",
        Selection("when factorised|always|never"));
    prm.add_parameter("Contact patches", contact_patches,
                      "Table and field of the contact patch of quasi-static rolling: automatic (of every "
                      "case up to 20, of a "
                      "longer sweep of the first and the last), of every case always, or never. Units: none.",
                      Selection("automatic|always|never"));
    prm.add_parameter(
        "Contact problems", contact_problems,
        "Write the discrete contact problem and solution of every case to contact_problems/*.h5 (FCLIB). "
        "Units: none.",
        Bool());
    prm.add_parameter("Figures", figures,
                      "Draw figures at the end if Python's matplotlib is there. Units: none.", Bool());
  }

  bool OutputParameters::writes_patch(const unsigned int k, const unsigned int n_cases) const
  {
    constexpr unsigned int most_cases = 20;
    if (contact_patches == "automatic")
      return n_cases <= most_cases || k == 0 || k + 1 == n_cases;
    return contact_patches == "always";
  }

  std::string OutputParameters::folder(const std::string &option, const std::string &parameter_file) const
  {
    if (!option.empty())
      return option;
    if (!directory.empty())
      return directory;
    return "results/" + std::filesystem::path(parameter_file).stem().string();
  }
} // namespace vibrocontact

#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// `subsection Output`.
  struct OutputParameters
  {
    /// folder of the results; empty: results/<name of the parameter file>
    std::string directory;
    /// folder of the reductions that later runs find again; shared by all runs
    std::string cache_directory = "cache";
    /// fields of bodies and contact patch as VTU, figures by contrib/plot_results.py
    bool fields = true, figures = true;
    /// deformation of the bodies: "when factorised" (only if this run has factorised them anyway), "always",
    /// "never"
    std::string deformation = "when factorised";
    /// tables and fields of the contact patch: "automatic" (of every case up to 20, of a longer sweep the
    /// first and the last), "always", "never"
    std::string contact_patches = "automatic";
    /// the discrete contact problem of every case as FCLIB file
    bool contact_problems = false;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// Whether case k of n cases writes its contact patch.
    bool writes_patch(unsigned int k, unsigned int n_cases) const;
    /// Directory, the option --output, or the default for this parameter file.
    std::string folder(const std::string &option, const std::string &parameter_file) const;
  };
} // namespace vibrocontact

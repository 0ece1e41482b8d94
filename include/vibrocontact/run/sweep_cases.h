#pragma once

#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace vibrocontact
{
  /// One case of a sweep: the scene with the swept entries at their values.
  struct SweepCase
  {
    /// the swept values, numbers where they are
    std::vector<std::variant<double, std::string>> values;
    /// position in the first and in the second entry's values
    unsigned int first = 0, second = 0;
    /// Read and checked as a file is; cases of equal entries share them. Where the contact moves over a band of body 1
    /// (AnalysisType::sweeps_band), Contact/Lateral position stays at the value of the file, to which the band belongs.
    std::shared_ptr<const Parameters> read;
    const Parameters &parameters() const { return *read; }
    /// of the contact in this case [m]
    double lateral_position = 0;
    /// keys of the bodies' reductions, empty for bodies without mesh; cases of equal keys share one
    std::vector<std::string> keys;
    /// sum over all values but those of section Output: what the case computes follows from it
    unsigned long long mark = 0;
  };

  /// The sweep of an analysis: what is swept, as columns such as lateral_position_m, and its cases in order; no cases:
  /// nothing is swept.
  struct SweepCases
  {
    std::string analysis;
    /// "Stability/Sweep"
    std::string section;
    /// that lists what is swept
    std::string entry = "Entry";
    /// whether the analysis runs on the file's own case as well (run/varied_cases.h)
    bool beside_run = false;
    std::vector<std::string> entries, columns;
    std::vector<SweepCase> cases;
    /// lateral positions whose contact grid leaves the tread [m]
    std::vector<double> left_out;
  };

  /// Reads the file again for each case of the analyses' sweeps, with its values as options. One element per listed
  /// analysis that sweeps something.
  /// @param overrides options of the command line
  /// @throws InputError for a value that its entry does not take
  std::vector<SweepCases> sweep_cases(const Parameters &parameters, const ParameterFile &file,
                                      const std::vector<std::string> &overrides);

  /// Reads the file with options that set entries: parameters, keys and mark of a case. The first gives `sweep` its columns.
  /// @param text the values, for messages @throws InputError
  SweepCase read_case(SweepCases &sweep, const Parameters &parameters, const ParameterFile &file,
                      const std::vector<std::string> &options, const std::string &text);

  /// Name of an analysis or entry as a key of results.json or a column: quasi-static rolling -> quasi_static_rolling.
  std::string results_key(const std::string &name);

  /// "lateral_position_m -0.005, friction_coefficient 0.3"
  std::string case_text(const SweepCases &sweep, const SweepCase &one);

  /// The meshed bodies of each case; those whose reductions are equal are one, be it one of the file's.
  std::vector<MeshedBodies> bodies_of_cases(const SweepCases &sweep, const MeshedBodies &of_the_file);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <string>
#include <variant>
#include <vector>

namespace vibrocontact
{
  /// One case of a stability sweep: the scene with the swept entries at their values.
  struct StabilityCase
  {
    /// the swept values, numbers where they are
    std::vector<std::variant<double, std::string>> values;
    /// position in the first and in the second entry's values
    unsigned int first = 0, second = 0;
    /// Contact/Lateral position stays at the value of the file, to which the band of body 1 belongs
    Parameters parameters;
    /// of the contact in this case [m]
    double lateral_position = 0;
    /// keys of the bodies' reductions, empty for bodies without mesh; cases of equal keys share one
    std::vector<std::string> keys;
  };

  /// A stability sweep: what is swept, as columns such as lateral_position_m, and its cases in order.
  struct StabilityCases
  {
    std::vector<std::string> entries, columns;
    std::vector<StabilityCase> cases;
    /// lateral positions whose contact grid leaves the tread [m]
    std::vector<double> left_out;
  };

  /// Reads the file again for each case of section Stability/Sweep, with its values as options. Empty if
  /// nothing is swept.
  /// @param overrides options of the command line
  /// @throws InputError for a value that its entry does not take
  StabilityCases stability_cases(const Parameters &parameters, const ParameterFile &file,
                                 const std::vector<std::string> &overrides);

  /// "lateral_position_m -0.005, friction_coefficient 0.3"
  std::string case_text(const StabilityCases &sweep, const StabilityCase &one);
} // namespace vibrocontact

#pragma once

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A named face of a STEP file.
  struct StepName
  {
    std::string name;
    /// [m^2]
    double area;
    /// of area [m]
    dealii::Point<3> centre;
  };

  /// Names of the faces in a STEP file, by OpenCASCADE; gmsh's library does not hand them on. To be called in a process of its own,
  /// as the reader crashes on damaged files.
  std::vector<StepName> step_names(const std::string &file);
} // namespace vibrocontact

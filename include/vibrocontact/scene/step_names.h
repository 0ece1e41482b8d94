#pragma once

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A named face or solid of a STEP file.
  struct StepName
  {
    std::string name;
    bool is_solid;
    /// area of a face [m^2], volume of a solid [m^3]
    double size;
    /// of area or volume; of the solid that a face belongs to [m]
    dealii::Point<3> centre, centre_of_solid;
  };

  /// Names of the faces and solids in a STEP file, parts of an assembly where they are placed, by OpenCASCADE; gmsh's library does not hand them on. To be called in a process of its own,
  /// as the reader crashes on damaged files.
  std::vector<StepName> step_names(const std::string &file);
} // namespace vibrocontact

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// A vector field on the points of a surface: name with its unit, values x, y, z point after point.
  using SurfaceField = std::pair<std::string, std::vector<double>>;

  /// Writes a surface (points and quads as in SurfaceShapes) with vector fields as VTU; in ParaView "Warp By
  /// Vector" deforms it. By the calling rank. @throws OutputError
  void write_surface(const std::vector<double> &points, const std::vector<int> &quads,
                     const std::vector<SurfaceField> &fields, const std::string &file_name);

  /// The index of a set of fields for ParaView: (case number or time, file relative to the .pvd).
  void write_pvd(const std::vector<std::pair<double, std::string>> &files, const std::string &file_name);
} // namespace vibrocontact

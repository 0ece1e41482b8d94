#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// A vector field on the points of a surface: name with its unit, values x, y, z point after point.
  using SurfaceField = std::pair<std::string, std::vector<double>>;

  /// Writes a surface (points and quads as in SurfaceShapes) with vector fields as VTU; in ParaView "Warp By
  /// Vector" deforms it. By the calling rank.
  /// @param place added to every point, of a body in the scene (contact/body_places.h) [m] @throws OutputError
  void write_surface(const std::vector<double> &points, const std::vector<int> &quads,
                     const std::vector<SurfaceField> &fields, const std::string &file_name,
                     const std::array<double, 3> &place = {{0, 0, 0}});

  /// The index of a set of fields for ParaView: (case number or time, file relative to the .pvd).
  void write_pvd(const std::vector<std::pair<double, std::string>> &files, const std::string &file_name);
} // namespace vibrocontact

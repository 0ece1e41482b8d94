#pragma once

#include <vibrocontact/contact/placed_contacts.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/scene/body.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A body as it is drawn.
  struct DrawnBody
  {
    const BodyParameters *parameters;
    /// null unless it is solid
    const ElasticBody<3> *solid;
    /// points and quads (SurfaceShapes) of another body that has a surface
    std::vector<double> points = {};
    std::vector<int> quads = {};
    /// of the body in the scene (contact/body_places.h) [m]
    std::array<double, 3> place = {{0, 0, 0}};
  };

  /// Draws what --check has read: folder/scene.json (types and sizes of the bodies, the contacts and their grids), the surfaces of
  /// bodies that have one as folder/fields/scene_<body>_0000.vtu, and by contrib/plot_results.py folder/figures/scene.png.
  /// Collective. @param bodies above first; @param contacts null without one
  /// @throws OutputError
  void draw_scene(const std::vector<DrawnBody> &bodies, const PlacedContacts *contacts,
                  const std::string &folder);
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/run/check_contacts.h>
#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  void Parameters::find_flat_faces()
  {
    const bool shifted = lateral_sweep() != nullptr;
    if ((rolls_or_slides(scene) || scene.runs("quasi-static loading")) && !shifted)
      for (unsigned int k = 0; k < contacts.all.size(); ++k)
        find_flat_faces(k);
  }

  void Parameters::find_flat_faces(const unsigned int contact_number)
  {
    ContactParameters &contact = contacts.all[contact_number];
    // hats beside the edge of a face would reach beyond it
    if (contact.has_consistent_quadrature() || !contact.frame().has_usual_axes())
      return;
    const ContactGrid asked = contact_grid(contact_number);
    const auto [above, below] = bodies_of_contact(contact_number);
    const BodyParameters *const bodies[2] = {&scene.bodies[above], &scene.bodies[below]};
    const ContactFrame frames[2] = {contact.frame(), contact.frame_below()};
    std::optional<FlatFace> faces[2];
    for (unsigned int k = 0; k < 2; ++k)
    {
      faces[k] = bodies[k]->description->flat_face(
          bodies[k] == &scene.bodies[0] ? contacts.first().lateral_position : 0.);
      if (!faces[k])
        continue;
      const auto &origin = frames[k].origin;
      contact.flat_faces.push_back({faces[k]->x_low - origin[0], faces[k]->x_high - origin[0],
                                    faces[k]->y_low - origin[1], faces[k]->y_high - origin[1]});
    }
    const bool rolls = rolling.creepage.speed > 0 && rolls_or_slides(scene);
    contact.at_rest = !rolls;
    const auto is_flat = [&](const unsigned int k)
    {
      const BodyParameters &body = *bodies[k];
      return faces[k] || (!body.vibrates() && body.description->curvatures() == std::make_pair(0., 0.));
    };
    const ContactGrid grid = contact_grid(contact_number);
    const std::string of = contact.name.empty() ? "" : " of " + contact.name;
    if (grid.n_points() != asked.n_points() || grid.x_first != asked.x_first || grid.y_first != asked.y_first)
      run_log().line("The contact grid" + of + " ends with the flat face of a body: " +
                     std::to_string(grid.n_x) + " x " + std::to_string(grid.n_y) + " points, spacing " +
                     number_text(grid.spacing_x) + " m x " + number_text(grid.spacing_y) + " m.");
    if (contact.flat_faces.empty() || !is_flat(0) || !is_flat(1) || transient.roughness.any() ||
        contact.strip_length > 0)
      return;
    const std::string &name = bodies[faces[0] ? 0 : 1]->name;
    if (rolls)
      throw InputError(
          "Rolling/Speed is not 0, but the flat face of " + name +
          " touches a flat surface all over, so that no point of the contact grid stays open "
          "upstream: set it to 0 (at rest, or with a Sliding velocity) or give one body a radius.");
    const SurfaceEnds ends = contact.ends(grid);
    if (ends.all())
      return;
    const bool x = !ends.upstream || !ends.downstream;
    throw InputError(
        "The flat face of " + name + " touches a flat surface all over, but the contact grid ends " +
        "before the face does: enlarge " + contact.section + "/" + (x ? "Half length" : "Half width") +
        " to half the face's size or more; the grid then ends with the face.");
  }
} // namespace vibrocontact

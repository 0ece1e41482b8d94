#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/waveguide/rail_section.h>
#include <vibrocontact/waveguide/rail_track.h>
#include <vibrocontact/waveguide/track_loads.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// of a place, as a share of the size of the section
    constexpr double farthest_node = 0.1;

    /// The force of 1 N on the dof next to a place of the section.
    Vector<double> nearest_load(const SectionElements &elements, const Point<2> &place,
                                const unsigned int direction)
    {
      Vector<double> load(elements.n_dofs());
      unsigned int nearest = 0;
      double distance = 1e300, size = 0;
      for (unsigned int i = 0; i < elements.n_dofs(); ++i)
      {
        size = std::max(size, elements.dof_position[i].distance(elements.dof_position[0]));
        if (elements.dof_direction[i] == direction && elements.dof_position[i].distance(place) < distance)
        {
          nearest = i;
          distance = elements.dof_position[i].distance(place);
        }
      }
      if (distance > farthest_node * size)
        throw InputError("Frequency response/Points: a place is " + number_text(distance) +
                         " m away from the nearest node of the rail's section; give one on the rail.");
      load(nearest) = 1;
      return load;
    }

    /// Places far away cost a span each; the waves are gone by then.
    constexpr double farthest = 100;

    void check_places(const SectionElements &elements, const RailParameters &rail,
                      const std::vector<TrackPlace> &places, const double length, const double width,
                      const double height)
    {
      const PeriodicTrack track = supports_of_track(rail);
      check_patch(elements, rail.lateral_position, width);
      for (const TrackPlace &place : places)
      {
        if (!(std::abs(place.x) <= farthest))
        {
          std::ostringstream text;
          text << "Frequency response/Points: x = " << place.x
               << " m is far from the contact; give places within " << farthest << " m.";
          throw InputError(text.str());
        }
        const double reach = place.z ? 0 : length / 2;
        check_on_track(track, place.x - reach, place.x + reach);
        if (!place.z)
          check_patch(elements, rail.lateral_position + place.y, width);
        else
          nearest_load(elements, {rail.lateral_position + place.y, height + *place.z}, place.direction);
      }
    }
  } // namespace

  void check_track_places(const BodyParameters &body, const RailParameters &rail,
                          const std::vector<TrackPlace> &places, const double length, const double width)
  {
    const RailSection section(body, rail);
    check_places(section.elements, rail, places, length, width, section.crown_height);
  }

  RailTrack::RailTrack(const BodyParameters &body, const RailParameters &rail,
                       const std::vector<TrackPlace> &places, const double length, const double width,
                       const double up_to)
  {
    const RailSection section(body, rail);
    const SectionElements &elements = section.elements;
    check_places(elements, rail, places, length, width, section.crown_height);
    n_dofs = elements.n_dofs();

    track = supports_of_track(rail);

    const double middle = rail.lateral_position, height = section.crown_height;
    std::vector<Vector<double>> on_section;
    std::vector<double> patches = {middle};
    for (const TrackPlace &place : places)
      if (place.z)
        on_section.push_back(nearest_load(elements, {middle + place.y, height + *place.z}, place.direction));
      else
        patches.push_back(middle + place.y);
    SmoothShapesSettings settings;
    settings.up_to = std::max(settings.up_to, 1.2 * up_to);
    const SectionShapes shapes = track_shapes(elements, track.support, patches, width, on_section, settings);
    track.section = track_section(elements, shapes);
    keep_far_shapes(track, shapes);

    unsigned int n_on_section = 0;
    for (const TrackPlace &place : places)
      if (place.z)
      {
        AxialLoad load;
        load.centre = place.x;
        load.constant = shapes.reduced(on_section[n_on_section++]);
        load.linear.reinit(shapes.n());
        loads.push_back(load);
      }
      else
        loads.push_back(
            patch_motions(elements, shapes, place.x, middle + place.y, length, width)[place.direction]);
    for (const unsigned int d : {1, 2})
    {
      exciters[d - 1] = patch_motions(elements, shapes, 0, middle, length, width)[d];
      observers[d - 1] = exciters[d - 1].constant;
      observers[d - 1] *= length;
    }
  }
} // namespace vibrocontact

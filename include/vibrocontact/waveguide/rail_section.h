#pragma once

#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/waveguide/periodic_track.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// The section of a rail of type `rail` with its elements, lateral and height as in its outline.
  class RailSection
  {
  private:
    std::vector<SectionOutline::Row> crown;

  public:
    /// @throws InputError for a section without crown
    RailSection(const BodyParameters &body, const RailParameters &rail);

    /// Height of the crown over the underside [m].
    double height(double lateral) const;

    /// of the contact: lateral position, height of the crown there [m]
    const double lateral_position, crown_height;
    const std::unique_ptr<dealii::Triangulation<2>> mesh;
    const SectionElements elements;
  };

  /// Supports of a periodic rail, without its section.
  PeriodicTrack supports_of_track(const RailParameters &rail);
} // namespace vibrocontact

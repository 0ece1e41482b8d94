#pragma once

#include <vibrocontact/scene/section.h>

#include <deal.II/grid/tria.h>

#include <memory>

namespace vibrocontact
{
  /// Boundary ids of a section's plane mesh: the underside, on which pads act, the crown, all else.
  namespace section_boundary
  {
    constexpr dealii::types::boundary_id surface = 0, foot = 1, crown = 2;
  }

  /// A rail's section in the plane of its coordinates (a, b), with the arcs of its outline, mirrored about a = 0, and the
  /// boundary ids above; material ids are those of the mesh. The outline's part `crown` is the crown, b = 0 the foot.
  std::unique_ptr<dealii::Triangulation<2>> plane_section(const SectionMesh &mesh,
                                                          const SectionOutline &outline);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/fe/trace_row.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace vibrocontact
{
  /// The surface of a body by the vertices of its boundary faces, and how their displacements follow from the
  /// dofs (hanging and held nodes resolved): what pictures and probes see. Replicated on all ranks; the order
  /// of the points depends on their number.
  struct SurfaceTrace
  {
    /// contact frame [m]
    std::vector<dealii::Point<3>> points;
    /// four points of each face in turn around it; a line (axis of a bar or beam, plane body) is a quad
    /// a, b, b, a, a triangle a, b, c, c
    std::vector<std::array<int, 4>> quads;
    /// displacement d (0 x, 1 y, 2 z) of point i in rows[3 i + d]; empty: zero
    std::vector<TraceRow> rows;
  };
} // namespace vibrocontact

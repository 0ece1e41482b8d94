#pragma once

#include <vibrocontact/waveguide/periodic_track.h>
#include <vibrocontact/waveguide/section_basis.h>

#include <array>
#include <vector>

namespace vibrocontact
{
  /// @throws InputError if a patch from y - width / 2 to y + width / 2 leaves the crown
  void check_patch(const SectionElements &elements, double y, double width);

  /// @throws InputError if something from x = from to x = to lies beyond the ends of the rail
  void check_on_track(const PeriodicTrack &track, double from, double to);

  /// Spans of an irregular track that are far from loads move in the smooth shapes of greatest share alone.
  void keep_far_shapes(PeriodicTrack &track, const SectionShapes &shapes);

  /// The six motions of a patch of the crown, as loads: mean displacements along x, y, z [m], then rotations about x, y, z
  /// [rad] of the plane that fits the displacements of the patch best (least squares over its area dx dy),
  ///
  ///   t_x = int y u_z / int y^2,  t_y = -int x u_z / int x^2,  t_z = int (x u_y - y u_x) / int (x^2 + y^2),
  ///
  /// x and y from the patch's centre. A unit load is the force (moment) that is spread in the same way.
  /// @param x, y centre, y in the section's coordinates; length, width along x and y [m]
  /// @throws InputError if the patch leaves the crown
  std::array<AxialLoad, 6> patch_motions(const SectionElements &elements, const SectionShapes &shapes,
                                         double x, double y, double length, double width);

  /// Smooth shapes of a rail on its pads, under patches of the crown and other loads on the section.
  /// @param patches y of their centres [m]
  SectionShapes track_shapes(const SectionElements &elements, const TrackSupport &support,
                             const std::vector<double> &patches, double width,
                             const std::vector<dealii::Vector<double>> &others,
                             const SmoothShapesSettings &settings);
} // namespace vibrocontact

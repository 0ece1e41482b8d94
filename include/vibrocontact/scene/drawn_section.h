#pragma once

#include <vibrocontact/scene/gmsh_file.h>
#include <vibrocontact/scene/section.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Curves of an outline that close around one region, in order [m].
  struct OutlineLoop
  {
    std::string region;
    std::vector<SectionOutline::Row> rows;
  };

  /// The regions of an outline.
  /// @param mirrored the outline is one half, closed by the line a = 0 where it begins and ends there
  /// @param file for messages @throws InputError where it is not closed, crosses itself or another region, or reaches over
  /// the axle (b <= 0; mirrored: over the line a = 0)
  std::vector<OutlineLoop> closed_loops(const SectionOutline &outline, bool mirrored,
                                        const std::string &file);

  /// Quadrilaterals of a section that is given as an outline alone, by gmsh (frontal Delaunay, blossom
  /// full-quad recombination). Regions are physical groups; those with common edges have common nodes there. The same on every
  /// rank.
  /// @param size of the cells [m] @throws InputError see closed_loops(); and if gmsh fails
  GmshFile mesh_outline(const SectionOutline &outline, double size, bool mirrored, const std::string &file);
} // namespace vibrocontact

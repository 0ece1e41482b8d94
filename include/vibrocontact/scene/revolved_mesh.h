#pragma once

#include <vibrocontact/scene/contact_grid.h>
#include <vibrocontact/scene/section.h>

#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The section of a body of revolution, to be solved wave by wave around the axle (fe/revolved_section.h).
  struct RevolvedMesh
  {
    /// points (axial position, radius), boundary ids by part, material ids
    std::shared_ptr<const dealii::Triangulation<2>> triangulation;
    /// of the section's points from there, along the axle [m]; null: none
    std::function<dealii::Point<2>(const dealii::Point<2> &)> displacement;
    dealii::types::boundary_id held = dealii::numbers::invalid_boundary_id,
                               tread = dealii::numbers::invalid_boundary_id;
    /// of the tread at the contact; lateral position of the contact [m]
    double radius = 0, lateral_position = 0;
    /// mean height over each cell of the contact grid, relative to the contact point; none without a grid [m]
    std::vector<double> surface_height;
    /// material id of the cells at the contact
    dealii::types::material_id contact_material = 0;
    /// of the displacements; waves around the axle that the contact compliance is summed over
    unsigned int degree = 2, n_harmonics = 0;
  };

  /// Elements of a section, curved along its outline's arcs. Boundaries have the id of their part of the outline; 0: a part
  /// that has none.
  std::unique_ptr<dealii::Triangulation<2>>
  section_triangulation(const SectionMesh &section, const SectionOutline &outline,
                        const std::map<std::string, dealii::types::boundary_id> &parts);

  /// Halves the cells near a piece of a boundary until their edges are shorter than both the size and half of their distance.
  /// @param low, high first coordinates of the piece [m]
  void refine_section(dealii::Triangulation<2> &triangulation, dealii::types::boundary_id boundary,
                      double low, double high, double size);
} // namespace vibrocontact

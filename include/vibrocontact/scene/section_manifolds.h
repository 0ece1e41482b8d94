#pragma once

#include <vibrocontact/scene/section.h>

#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <memory>

namespace vibrocontact
{
  /// Body of revolution about the axis y through z = axis_height: x = b sin(phi), y = a - shift,
  /// z = axis_height - b cos(phi). New points are averages of (a, b, phi): straight in the section, round
  /// about the axis.
  class RevolvedManifold : public dealii::ChartManifold<3, 3, 3>
  {
  public:
    RevolvedManifold(const double axis_height, const double shift)
        : ChartManifold<3, 3, 3>(periodicity()), axis_height(axis_height), shift(shift)
    {
    }
    std::unique_ptr<dealii::Manifold<3, 3>> clone() const override
    {
      return std::make_unique<RevolvedManifold>(axis_height, shift);
    }
    /// (a, b, phi)
    dealii::Point<3> pull_back(const dealii::Point<3> &p) const override;
    dealii::Point<3> push_forward(const dealii::Point<3> &chart) const override;

  private:
    static dealii::Tensor<1, 3> periodicity();
    const double axis_height, shift;
  };

  /// A circular arc of the section revolved (part of a torus): chart (distance from the arc's centre, angle,
  /// phi).
  class RevolvedArcManifold : public dealii::ChartManifold<3, 3, 3>
  {
  public:
    RevolvedArcManifold(const double axis_height, const double shift, const dealii::Point<2> &centre);
    std::unique_ptr<dealii::Manifold<3, 3>> clone() const override
    {
      return std::make_unique<RevolvedArcManifold>(*this);
    }
    dealii::Point<3> pull_back(const dealii::Point<3> &p) const override;
    dealii::Point<3> push_forward(const dealii::Point<3> &chart) const override;
    RevolvedArcManifold(const RevolvedArcManifold &other);

  private:
    const double axis_height, shift;
    const RevolvedManifold revolved;
    const dealii::Point<2> centre;
  };

  /// A circular arc of the section (y, z) extruded along x: chart (x, distance from the centre, angle).
  class ExtrudedArcManifold : public dealii::ChartManifold<3, 3, 3>
  {
  public:
    /// @param centre (y, z) of the arc's centre in body coordinates
    ExtrudedArcManifold(const dealii::Point<2> &centre);
    std::unique_ptr<dealii::Manifold<3, 3>> clone() const override
    {
      return std::make_unique<ExtrudedArcManifold>(centre);
    }
    dealii::Point<3> pull_back(const dealii::Point<3> &p) const override;
    dealii::Point<3> push_forward(const dealii::Point<3> &chart) const override;

  private:
    const dealii::Point<2> centre;
  };

  /// The crown of a rail as a graph z = f(y) over its several arcs: chart (x, y, z - f(y)). New nodes are
  /// equally spaced in y, so that they fall on the lines of the contact grid, and an edge may span two arcs.
  class CrownManifold : public dealii::ChartManifold<3, 3, 3>
  {
  public:
    /// @param rows upper arcs of the right half, centre below, by section coordinates; y = a - shift_y, z = b
    /// - shift_z
    CrownManifold(const std::vector<SectionOutline::Row> &rows, const double shift_y, const double shift_z)
        : rows(rows), shift_y(shift_y), shift_z(shift_z)
    {
    }
    std::unique_ptr<dealii::Manifold<3, 3>> clone() const override
    {
      return std::make_unique<CrownManifold>(rows, shift_y, shift_z);
    }
    dealii::Point<3> pull_back(const dealii::Point<3> &p) const override;
    dealii::Point<3> push_forward(const dealii::Point<3> &chart) const override;
    /// height b of the crown at lateral position a of the section [m]
    static double height(const std::vector<SectionOutline::Row> &rows, const double a);

  private:
    const std::vector<SectionOutline::Row> rows;
    const double shift_y, shift_z;
  };

  /// The cells of a section in the plane of its coordinates, material ids set; manifolds and boundary ids are not.
  std::unique_ptr<dealii::Triangulation<2>> plane_cells(const SectionMesh &section);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/fe/beam_energy.h>
#include <vibrocontact/scene/beam_rail.h>

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <map>
#include <vector>

namespace vibrocontact
{
  /// Fields of a rail as a beam (beam_elements.h): displacements of the section (V, W of the shear centre),
  /// rotations about x, y, z, and warping.
  namespace beam_field
  {
    enum Name : unsigned int
    {
      U,
      V,
      W,
      tx,
      ty,
      tz,
      p,
      n_fields
    };
  } // namespace beam_field

  /// Mesh and elements of a beam. They are small and stand on every rank; nodes at the contact, at edges (or
  /// points) of pads and at the ends of anechoic pieces.
  struct BeamSpace
  {
    explicit BeamSpace(const BeamRailParameters &rail);

    dealii::Triangulation<1> mesh;
    dealii::FESystem<1> element;
    dealii::DoFHandler<1> dof_handler;
  };

  /// What a motion at a place of a cell is in terms of dofs.
  class BeamPlace
  {
  public:
    /// @param x along the rail, on the cell [m]
    BeamPlace(const BeamSpace &space, const dealii::DoFHandler<1>::active_cell_iterator &cell, double x);

    /// row += weight * motion
    void add(std::map<dealii::types::global_dof_index, double> &row, const BeamMotion &motion,
             double weight) const;

  private:
    const BeamSpace &space;
    const double place;
    std::vector<dealii::types::global_dof_index> dofs;
  };

  /// Motion of a point of the crown at arm x from its section and y from the contact point: u_z, u_x, u_y.
  std::array<BeamMotion, 3> crown_motion(const BeamRailParameters &rail, double arm_x, double y);
} // namespace vibrocontact

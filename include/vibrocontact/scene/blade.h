#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/body_mesh.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// A cantilever blade of rectangular section, twisted linearly about its axis z.
  ///
  ///        z ^      tip (z = length), section turned by the tip angle
  ///          |      boundaries: root, tip, leading, trailing (ends of the chord), pressure, suction (its sides)
  ///          |
  ///          +--> x root (z = 0), held; chord along x and thickness along y before the turn
  ///
  /// A point (x, y, z) of the straight blade lies at the radius and height it had, turned by root angle + (tip angle -
  /// root angle) z / length about z, from x towards y. All cells follow that map (mapping of the elements' degree, at least
  /// 2).
  struct BladeParameters : SolidBody
  {
    /// [m]
    double length = 0.2, chord = 0.08, thickness = 0.006;
    /// of the section about z [deg]
    double root_angle = 0, tip_angle = 40;
    /// cells along length, chord, thickness
    unsigned int length_divisions = 20, chord_divisions = 8, thickness_divisions = 1;
    unsigned int element_degree = 2;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    BodyMesh<3> make_mesh(const MeshRequest &request) const override;
    void hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const override;
    unsigned int mesh_degree() const override { return element_degree; }
    bool may_turn() const override { return true; }
    std::string example_of_points() const override { return "corner: 0.04, 0.003, 0.2"; }
  };

  /// Without refinement: a blade is touched at points of its tip, not on a contact grid.
  BodyMesh<3> make_blade(const BladeParameters &parameters, const std::string &name, MPI_Comm communicator);
} // namespace vibrocontact

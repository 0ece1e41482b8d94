#pragma once

#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/body_mesh.h>
#include <vibrocontact/scene/flat_face.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A box: the simplest meshed body, for tests, patch tests and foreign pairings.
  ///
  ///        z ^        boundaries: left, right (x), front, back (y), bottom, top (z); 2d: without front, back
  ///          |        the origin is the centre of the contact face (top or bottom), plus the offset
  ///          +--> x
  struct BlockParameters : SolidBody
  {
    /// sizes along x, y, z [m] and numbers of cells
    double length = 0.1, width = 0.1, height = 0.05;
    unsigned int divisions_x = 5, divisions_y = 5, divisions_z = 3;
    /// face in the plane z = 0 that can come into contact: top or bottom
    std::string contact_face = "top";
    /// names of the boundaries that are held; empty: a free body
    std::vector<std::string> held = {"bottom"};
    /// shift of the box along x and y against the contact frame [m]
    double offset_x = 0, offset_y = 0;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    std::pair<std::string, std::string> missing_support(const std::string &name) const override;
    BodyMesh<3> make_mesh(const MeshRequest &request) const override;
    void hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const override;
    std::optional<FlatFace> flat_face(double lateral_position) const override
    {
      return contact_rectangle(lateral_position);
    }
    bool follows_lateral_position() const override { return true; }
    bool may_turn() const override { return true; }
    std::string contact_surface(const std::string &name) const override
    {
      return name + "/Block/Contact face";
    }
    std::string way_to_turn(const std::string &name, bool above) const override;
    /// the contact face, where the contact of body 1 is @p lateral_position from the box's origin along y [m]
    FlatFace contact_rectangle(double lateral_position) const;
  };

  template <int dim>
  BodyMesh<dim> make_block(const BlockParameters &parameters, const std::string &name,
                           const MPI_Comm communicator);
} // namespace vibrocontact

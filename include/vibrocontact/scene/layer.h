#pragma once

#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/body_description.h>
#include <vibrocontact/scene/contact_grid.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// An elastic layer held on top that is dragged over a rigid plane: the smallest scene that squeals.
  ///
  ///       //////////////////  top, held; pressed down by Rolling/Hub displacement or Normal force
  ///     z ^                |
  ///       |     layer      |  plane strain (per metre of width) or a box
  ///       +--o--o--o--o--o-+  contact points: the nodes of the bottom
  ///          -> Rolling/Sliding velocity of the layer against the plane
  ///
  /// Every node of the bottom is a contact point of its own (gap and slip of the node, not the mean over a
  /// cell), so that the laws hold on the whole bottom. The material does not flow through the frame: the
  /// rolling speed is 0.
  struct LayerParameters : ElementBody
  {
    /// sizes along x, z and y [m]; width 0: plane strain
    double length = 0.1, height = 0.05, width = 0;
    /// elements along x, z and y (not in plane strain)
    unsigned int divisions_x = 16, divisions_z = 8, divisions_y = 4;
    /// polynomial degree of the elements, 1 or 2: their nodes are equally spaced
    unsigned int degree = 1;

    bool plane_strain() const { return width == 0; }
    /// the nodes of the bottom; a strip of 1 m along y in plane strain
    ContactGrid grid() const;
    /// the mesh as a box
    BlockParameters block() const;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void print(Log &log) const override;
    nlohmann::ordered_json sizes() const override;
    std::optional<ContactGrid> contact_points(double cell) const override;
    std::unique_ptr<SecondOrderSystem> assemble(const BodyParameters &body, bool above,
                                                const ContactGrid *grid,
                                                MPI_Comm communicator) const override;
    bool may_stand_for_half_space() const override { return false; }
    bool is_plane() const override { return plane_strain(); }
    bool stays_in_place() const override { return true; }
  };
} // namespace vibrocontact

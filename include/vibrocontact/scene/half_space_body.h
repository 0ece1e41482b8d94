#pragma once

#include <vibrocontact/scene/body_description.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// An elastic half-space: no mesh, its compliance is Boussinesq's and Cerruti's (half_space.h); what
  /// CONTACT models. Its undeformed surface near the nominal contact point is the paraboloid of Hertz's
  /// theory,
  ///
  ///   depth behind the tangent plane = x^2 / (2 Rx) + y^2 / (2 Ry),
  ///
  /// a convex body having positive radii; a radius of 0 stands for a flat surface in that direction.
  struct HalfSpaceParameters : BodyDescription
  {
    /// radii of curvature in the planes of x (rolling line) and y (lateral) [m]
    double radius_x = 0, radius_y = 0;

    /// Curvatures 1/R, 0 for a flat surface [1/m].
    double curvature_x() const { return radius_x == 0 ? 0 : 1 / radius_x; }
    double curvature_y() const { return radius_y == 0 ? 0 : 1 / radius_y; }

    /// Entries of `subsection Half-space` of a body.
    void declare_parameters(dealii::ParameterHandler &prm) override;
    /// @throws InputError naming @p section
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void print(Log &log) const override;
    nlohmann::ordered_json sizes() const override;
    std::pair<double, double> curvatures() const override { return {curvature_x(), curvature_y()}; }
    ContactPlaces contact_places() const override { return ContactPlaces::any_origin; }
    bool lies_on_half_space() const override { return true; }
  };

  /// The same surface of a body that does not give way: stop, road.
  struct RigidParameters : HalfSpaceParameters
  {
    bool is_rigid() const override { return true; }
    bool has_material() const override { return false; }
    nlohmann::ordered_json sizes() const override { return BodyDescription::sizes(); }
    ContactPlaces contact_places() const override { return ContactPlaces::anywhere; }
    bool lies_on_half_space() const override { return false; }
  };
} // namespace vibrocontact

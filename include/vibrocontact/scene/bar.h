#pragma once

#include <vibrocontact/scene/body_description.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// A straight bar along z that only stretches: E S u'' = rho S u_tt, its contact end in the plane z = 0.
  ///
  ///     z ^   | far end          body 1 stands above the plane, body 2 below it
  ///       |   |
  ///       +   o contact end
  struct BarParameters : ElementBody
  {
    /// [m], [m^2]
    double length = 1, section = 1e-4;
    /// elements along the bar and their polynomial degree
    unsigned int divisions = 20, degree = 3;
    /// "free" or "held"
    std::string far_end = "held";
    bool far_end_is_held() const { return far_end == "held"; }
    /// M = s M_consistent + (1 - s) M_lumped (row sums). Two-node elements of length h carry waves of wave number k at the
    /// frequency c k (1 + (2 s - 1) (k h)^2 / 24), which the theta method with steps dt lowers by (c k dt)^2 / 12: both
    /// cancel for s = 1/2 + (c dt / h)^2, at c dt = h to all orders (one-point integration of the mass)
    double consistent_mass = 1;
    /// the mass of the contact element goes to its inner node, so that the contact end has none: forces of rigid contact
    /// then converge (doc/theory.md, "Periodic motion")
    bool massless_contact_node = false;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    void check(const std::string &section) const override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void print(Log &log) const override;
    nlohmann::ordered_json sizes() const override;
    std::optional<ContactGrid> contact_points(double cell) const override;
    std::unique_ptr<SecondOrderSystem> assemble(const BodyParameters &body, bool above,
                                                const ContactGrid *grid,
                                                MPI_Comm communicator) const override;
    void move_contact(const SecondOrderSystem &system, ContactTrace &trace, double z) const override;
    bool takes_gravity() const override { return true; }
    bool has_massless_points() const override { return massless_contact_node; }
    bool moves_along_z_only() const override { return true; }
    ContactPlaces contact_places() const override { return ContactPlaces::along_axis; }
    bool may_stand_for_half_space() const override { return false; }
  };
} // namespace vibrocontact

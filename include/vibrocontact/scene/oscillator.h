#pragma once

#include <vibrocontact/scene/body_description.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// A mass on a spring and a damper above the road, pulled down by its weight (Meftah & Duhamel 2011, Eq. 51):
  ///
  ///   M u'' + C u' + K u = -M g + F_c,      C = 2 xi sqrt(K M),     u up, F_c >= 0 from the road
  ///
  /// Without contact it rests at u = -M g / K. One contact point. With friction its contact point also moves along
  /// the road, as a second oscillator: M_t v'' + C_t v' + K_t v = T, v and T forward.
  struct OscillatorParameters : BodyDescription, PointBody
  {
    /// M [kg], K [N/m], xi [-], g [m/s^2]
    double mass = 1, stiffness = 4e5, damping_ratio = 0.02, gravity = 9.81;
    /// the same along the road; with friction only
    double tangential_mass = 1, tangential_stiffness = 4e5, tangential_damping_ratio = 0.02;

    void declare_parameters(dealii::ParameterHandler &prm) override;
    bool add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const override;
    void print(Log &log) const override;
    std::optional<ContactGrid> contact_points(double cell) const override;
    const PointBody *at_points() const override { return this; }
    BodyInContact between_points(bool with_friction, double speed,
                                 const std::vector<double> &upstream = {}) const override;
    std::vector<std::string> row_names(bool with_friction) const override;
    bool has_material() const override { return false; }
    bool has_rigid_points() const override { return true; }
    bool may_yield() const override { return false; }
    bool is_driven_along_stop() const override { return false; }
    bool has_weight() const override { return gravity != 0; }
    bool takes_cell() const override { return true; }
    std::vector<double> places() const override { return {0.}; }
    std::vector<double> heights() const override { return {0.}; }
  };
} // namespace vibrocontact

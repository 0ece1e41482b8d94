#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/coupled_bodies/creepage_limits.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>

#include <functional>
#include <utility>

namespace vibrocontact
{
  void RollingParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const auto list = [](const double low, const double high = Double::max_double_value)
    { return List(Double(low, high), 0, 10000); };
    const List positive_or_empty(Double(1e-30, 1e15), 0, 1);
    prm.add_parameter(
        "Normal force", normal_force,
        "Resultant normal force, or empty if the hub displacement is given. In a modal convolution "
        "that with which a flat road presses at rest, in place of Road/Indentation. Units: N.",
        positive_or_empty);
    prm.add_parameter("Hub displacement", hub_displacement,
                      "Downward displacement of the hub of body 1 (approach of half-spaces) from the "
                      "position in which the bodies touch "
                      "at the nominal contact point, or empty "
                      "if the normal force is given. Units: m.",
                      positive_or_empty);
    prm.add_parameter("Speed", creepage.speed,
                      "Rolling speed; 0 in a transient or with a Sliding velocity. Units: m/s.",
                      Double(0, 1000));
    prm.add_parameter("Longitudinal creepage", creepage.longitudinal,
                      "Velocity of body 1 minus body 2 along x over the speed. Units: none.",
                      Double(-most_creepage, most_creepage));
    prm.add_parameter("Lateral creepage", creepage.lateral,
                      "Velocity of body 1 minus body 2 along y over the speed. Units: none.",
                      Double(-most_creepage, most_creepage));
    prm.add_parameter("Spin", creepage.spin,
                      "Rotation of body 1 against body 2 about +z over the speed. Units: 1/m.",
                      Double(-most_spin, most_spin));
    prm.add_parameter("Sliding velocity x", creepage.sliding_x,
                      "Velocity of body 1 minus body 2 along x beside the creepage. Units: m/s.",
                      Double(-1000, 1000));
    prm.add_parameter("Sliding velocity y", creepage.sliding_y,
                      "Velocity of body 1 minus body 2 along y beside the creepage. Units: m/s.",
                      Double(-1000, 1000));
    prm.add_parameter(
        "Sliding rotation", creepage.sliding_rotation,
        "Rotation of body 1 against body 2 about +z beside the spin: a pad on a disc that turns "
        "by omega about the same axis has -omega. Units: rad/s.",
        Double(-1e4, 1e4));
    prm.add_parameter(
        "Hub", hub,
        "The hub of body 1 in stability and transient, after the load has found its place: held "
        "there; massless: it follows under the constant normal force; suspended: section "
        "Suspension; axle: sections Axle and Suspension. Half-spaces have none. Units: none.",
        Selection(selection(names_of(hub_kinds()))));
    prm.enter_subsection("Suspension");
    suspension.declare_parameters(prm);
    prm.leave_subsection();
    prm.enter_subsection("Axle");
    axle.declare_parameters(prm);
    prm.leave_subsection();
    prm.add_parameter("Grids", grids,
                      "Quasi-static rolling of two half-spaces: one grid of Contact/Grid spacing, or two, "
                      "the other of half of it, and "
                      "forces extrapolated to a vanishing spacing, for which the slip is corrected at the "
                      "leading edge; automatic: "
                      "two where two half-spaces roll. Units: none.",
                      Selection("automatic|one|two"));
    prm.enter_subsection("Sweep");
    prm.add_parameter("Longitudinal creepage", sweep.longitudinal,
                      "Values of one curve, all other entries at their single values. Units: none.",
                      list(-most_creepage, most_creepage));
    prm.add_parameter("Lateral creepage", sweep.lateral,
                      "Values of one curve, all other entries at their single values. Units: none.",
                      list(-most_creepage, most_creepage));
    prm.add_parameter("Spin", sweep.spin,
                      "Values of one curve, all other entries at their single values. Units: 1/m.",
                      list(-most_spin, most_spin));
    prm.add_parameter("Normal force", sweep.normal_force,
                      "Values of one curve, all other entries at their single values. Units: N.", list(0));
    prm.add_parameter("Hub displacement", sweep.hub_displacement,
                      "Values of one curve, all other entries at their single values. Units: m.", list(-1));
    prm.add_parameter("Friction coefficient", sweep.friction,
                      "Every curve is repeated for these, which take the place of Contact/Friction "
                      "coefficient. Units: none.",
                      list(0, 10));
    prm.leave_subsection();
  }

  std::vector<std::string> RollingParameters::Sweep::given() const
  {
    std::vector<std::string> names;
    for (const auto &[name, values] :
         {std::make_pair("Longitudinal creepage", &longitudinal),
          std::make_pair("Lateral creepage", &lateral), std::make_pair("Spin", &spin),
          std::make_pair("Normal force", &normal_force),
          std::make_pair("Hub displacement", &hub_displacement),
          std::make_pair("Friction coefficient", &friction)})
      if (!values->empty())
        names.push_back(std::string("Rolling/Sweep/") + name);
    return names;
  }

  bool RollingParameters::two_grids() const
  {
    return grids == "two" || (grids == "automatic" && creepage.speed > 0);
  }

  void RollingParameters::check(const bool frictionless) const
  {
    if (!frictionless && !(creepage.speed > 0) && !creepage.slides())
      throw InputError(
          "Entry Rolling/Speed is 0 and there is no Sliding velocity: nothing moves; steady rolling "
          "needs one of them (pressing alone needs a friction coefficient of 0).");
    const auto name = [](const std::vector<double> &single, const std::string &entry)
    { return (single.empty() ? "Rolling/Sweep/" : "Rolling/") + entry; };
    const bool force = !normal_force.empty() || !sweep.normal_force.empty();
    const bool displacement = !hub_displacement.empty() || !sweep.hub_displacement.empty();
    if (force && displacement)
      throw InputError(name(normal_force, "Normal force") + " and " +
                       name(hub_displacement, "Hub displacement") +
                       " are both given, but one follows from the other: empty one of them.");
    if (!force && !displacement)
      throw InputError("Rolling/Normal force and Rolling/Hub displacement are neither of them given: set one "
                       "of them.");
    if (normal_force.empty() && hub_displacement.empty() &&
        !(sweep.longitudinal.empty() && sweep.lateral.empty() && sweep.spin.empty()))
      throw InputError("Rolling/Sweep lists a creepage, but there is no load for these curves: set "
                       "Rolling/Normal force or Rolling/Hub displacement beside the sweep.");
    for (const double value : sweep.normal_force)
      if (!(value > 0))
        throw InputError("Rolling/Sweep/Normal force lists a force that is not positive: take it out.");
  }

  std::vector<RollingCase> rolling_cases(const RollingParameters &rolling, const ContactSections &sections)
  {
    const ContactParameters &contact = sections.first();
    RollingCase base;
    base.curve = "single";
    base.creepage = rolling.creepage;
    base.friction = contact.friction;
    base.normal_force = rolling.normal_force.empty() ? 0. : rolling.normal_force.front();
    base.hub_displacement = rolling.hub_displacement.empty() ? 0. : rolling.hub_displacement.front();

    const std::vector<double> frictions =
        rolling.sweep.friction.empty() ? std::vector<double>{contact.friction} : rolling.sweep.friction;
    std::vector<RollingCase> cases;
    const auto add_curve = [&](const std::string &name, const std::vector<double> &values,
                               const std::function<void(RollingCase &, double)> &set)
    {
      for (const double friction : values.empty() ? std::vector<double>() : frictions)
        for (const double value : values)
        {
          RollingCase one = base;
          one.curve = name;
          one.friction = friction;
          set(one, value);
          cases.push_back(one);
        }
    };
    const RollingParameters::Sweep &sweep = rolling.sweep;
    add_curve("Longitudinal creepage", sweep.longitudinal,
              [](RollingCase &c, const double value) { c.creepage.longitudinal = value; });
    add_curve("Lateral creepage", sweep.lateral,
              [](RollingCase &c, const double value) { c.creepage.lateral = value; });
    add_curve("Spin", sweep.spin, [](RollingCase &c, const double value) { c.creepage.spin = value; });
    add_curve("Normal force", sweep.normal_force,
              [](RollingCase &c, const double value) { c.normal_force = value; });
    add_curve("Hub displacement", sweep.hub_displacement,
              [](RollingCase &c, const double value) { c.hub_displacement = value; });
    if (cases.empty())
      add_curve(rolling.sweep.friction.empty() ? "single" : "Friction coefficient", {0.},
                [](RollingCase &, double) {});
    return cases;
  }
} // namespace vibrocontact

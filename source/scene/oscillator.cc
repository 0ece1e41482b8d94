#include <vibrocontact/base/log.h>
#include <vibrocontact/scene/oscillator.h>

#include <cmath>

namespace vibrocontact
{
  void OscillatorParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Mass", mass, "Mass. Units: kg.", Double(1e-12, 1e12));
    prm.add_parameter("Stiffness", stiffness, "Stiffness of the spring. Units: N/m.", Double(1e-12, 1e15));
    prm.add_parameter("Damping ratio", damping_ratio, "Damping relative to the critical one. Units: none.",
                      Double(0, 100));
    prm.add_parameter("Gravity", gravity, "Acceleration that pulls it down. Units: m/s^2.",
                      Double(-1e6, 1e6));
    prm.add_parameter("Tangential mass", tangential_mass,
                      "Mass that moves along the road, with friction only. Units: kg.", Double(1e-12, 1e12));
    prm.add_parameter("Tangential stiffness", tangential_stiffness,
                      "Stiffness of its spring along the road. Units: N/m.", Double(1e-12, 1e15));
    prm.add_parameter("Tangential damping ratio", tangential_damping_ratio,
                      "Damping of that motion relative to the critical one. Units: none.", Double(0, 100));
  }

  bool OscillatorParameters::add_entries(EntriesRead &entries, const std::string &section,
                                         const BodyUse &use) const
  {
    entries.add(section, "Stiffness");
    entries.add_if(use.motion || (use.loads && gravity != 0), "it moves or has a Gravity", section, "Mass");
    entries.add_if(use.loss, "it moves", section, "Damping ratio");
    entries.add_if(use.loads, "it stands under its weight", section, "Gravity");
    const std::string along = "it moves along the road";
    entries.add_if(use.tangential, along, section, "Tangential stiffness");
    entries.add_if(use.tangential && use.motion, along, section, "Tangential mass, Tangential damping ratio");
    return true;
  }

  void OscillatorParameters::print(Log &log) const
  {
    log.value("mass", mass, "kg");
    log.value("frequency", std::sqrt(stiffness / mass) / (2 * dealii::numbers::PI), "Hz");
  }

  std::optional<ContactGrid> OscillatorParameters::contact_points(const double cell) const
  {
    return single_point(cell);
  }

  std::vector<std::string> OscillatorParameters::row_names(const bool with_friction) const
  {
    return with_friction ? std::vector<std::string>{"A_z", "A_x"} : std::vector<std::string>{"A_z"};
  }
} // namespace vibrocontact

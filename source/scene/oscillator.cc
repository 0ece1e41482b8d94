#include <vibrocontact/scene/oscillator.h>

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
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/wheel_damper.h>

namespace vibrocontact
{
  void WheelDamper::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Kind", kind,
                      "absorber: masses on springs, evenly around the axle; ring: a mass on a spring spread "
                      "evenly around it; layer: loss of all elements between two radii. Units: none.",
                      Selection("absorber|ring|layer"));
    prm.add_parameter("Mass", mass, "Of each absorber, or of the whole ring. Units: kg.", Double(0, 1e4));
    prm.add_parameter("Frequency", frequency,
                      "Of the mass on its spring while the wheel is held there; 0: the mass is fixed to the "
                      "wheel. Units: Hz.",
                      Double(0, 1e6));
    prm.add_parameter("Loss factor", loss_factor,
                      "Of the spring, k (1 + j eta), or added to that of the layer's material. Units: none.",
                      Double(0, 10));
    prm.add_parameter("Axial position", axial,
                      "Where the absorber or ring sits on the wheel's section, as in its outline. Units: m.",
                      Double(-10, 10));
    prm.add_parameter("Radius", radius, "Where the absorber or ring sits on the wheel's section. Units: m.",
                      Double(0, 100));
    prm.add_parameter(
        "Direction", direction,
        "Along which the mass moves on its spring; along the other two it rides with the wheel. "
        "Units: none.",
        Selection("axial|radial|circumferential"));
    prm.add_parameter("Number", number, "Of absorbers, evenly around the axle. Units: none.",
                      Integer(1, 200));
    prm.add_parameter("First angle", first_angle,
                      "Of the first absorber from the contact point around the axle, towards +x. "
                      "Units: degrees.",
                      Double(-360, 360));
    prm.add_parameter("Inner radius", inner_radius,
                      "The layer is all elements whose centre lies outside of it. Units: m.", Double(0));
    prm.add_parameter("Outer radius", outer_radius,
                      "The layer is all elements whose centre lies within it. Units: m.", Double(0));
  }

  void WheelDamper::check(const std::string &section) const
  {
    if (is_layer() && !(inner_radius < outer_radius))
      throw InputError(section + "/Inner radius is " + number_text(inner_radius) +
                       " m, not below Outer radius, " + number_text(outer_radius) +
                       " m: give the radii between which the layer lies.");
    if (!is_layer() && !(mass > 0))
      throw InputError(section + "/Mass is 0: give the mass of " +
                       (is_ring() ? "the whole ring" : "each absorber") + ", or leave " + name +
                       " out of Dampers.");
    if (!is_layer() && !(radius > 0))
      throw InputError(section + "/Radius is 0: give the place of the " + kind +
                       " on the wheel's section, its Axial position and Radius.");
  }

  std::string WheelDamper::entries() const
  {
    const std::string sprung = frequency > 0 ? ", Loss factor, Direction" : "";
    return is_layer()  ? "Kind, Loss factor, Inner radius, Outer radius"
           : is_ring() ? "Kind, Mass, Frequency, Axial position, Radius" + sprung
                       : "Kind, Mass, Frequency, Axial position, Radius, Number, First angle" + sprung;
  }
} // namespace vibrocontact

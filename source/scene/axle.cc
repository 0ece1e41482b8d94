#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/axle.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace vibrocontact
{
  void AxleParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Length", length,
                      "Between the centres of the two wheels' hubs; the second wheel is body 1 turned round. "
                      "Units: m.",
                      Double(0, 100));
    prm.add_parameter("Radius", radius, "Of the axle's section. Units: m.", Double(0, 100));
    prm.add_parameter("Inner radius", inner_radius, "Of a hollow axle, 0: solid. Units: m.", Double(0, 100));
    prm.add_parameter("Box distance", box_distance,
                      "How far beyond each hub the axle boxes lie, at which springs and dampers of "
                      "Rolling/Suspension carry the axle; the axle is rigid there. Units: m.",
                      Double(0, 100));
    prm.add_parameter("Box mass", box_mass, "Of each axle box. Units: kg.", Double(0, 1e15));
    prm.add_parameter("Upper frequency", upper_frequency,
                      "Modes of the axle between held hubs are kept up to this. Units: Hz.", Double(1, 1e6));
    prm.enter_subsection("Material");
    material.declare_parameters(prm);
    prm.leave_subsection();
  }

  void AxleParameters::check() const
  {
    const std::string section = "Rolling/Axle/";
    if (!(length > 0))
      throw InputError("Rolling/Hub is axle, but " + section +
                       "Length is 0: give the distance between the centres of the two wheels' hubs.");
    if (!(radius > 0))
      throw InputError("Rolling/Hub is axle, but " + section +
                       "Radius is 0: give that of the axle's section.");
    if (!(inner_radius < radius))
      throw InputError(section + "Inner radius is " + number_text(inner_radius) +
                       " m, but the axle's Radius is only " + number_text(radius) + " m: make it smaller.");
    material.check(section + "Material");
  }

  double AxleParameters::area() const
  {
    return dealii::numbers::PI * (radius * radius - inner_radius * inner_radius);
  }

  double AxleParameters::moment() const
  {
    return dealii::numbers::PI / 4 * (std::pow(radius, 4) - std::pow(inner_radius, 4));
  }

  double AxleParameters::shear_coefficient() const
  {
    const double nu = material.poisson_ratio, m = std::pow(inner_radius / radius, 2), s = (1 + m) * (1 + m);
    return 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m);
  }
} // namespace vibrocontact

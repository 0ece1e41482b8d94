#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/material.h>

#include <cmath>
#include <sstream>

namespace vibrocontact
{
  void ElasticMaterial::declare_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Young modulus", young_modulus, "Young's modulus. Units: Pa.", Double(0));
    prm.add_parameter("Poisson ratio", poisson_ratio, "Poisson's ratio, below one half. Units: none.",
                      Double(-1, 0.5));
    prm.add_parameter("Density", density, "Mass per volume. Units: kg/m^3.", Double(0));
    prm.add_parameter(
        "Loss factor", loss_factor,
        "Hysteretic loss factor: imaginary part of the stiffness over its real part. Units: none.",
        Double(0, 10));
  }

  dealii::SymmetricTensor<4, 3> ElasticMaterial::stiffness() const
  {
    using namespace dealii;
    if (is_orthotropic())
      return orthotropic.stiffness();
    return lambda() * outer_product(unit_symmetric_tensor<3>(), unit_symmetric_tensor<3>()) +
           2 * mu() * identity_tensor<3>();
  }

  void ElasticMaterial::check(const std::string &section) const
  {
    const auto refuse = [&](const std::string &entry, const double value, const std::string &advice)
    {
      std::ostringstream text;
      text << section << "/" << entry << " is " << value << ": " << advice << ".";
      throw InputError(text.str());
    };
    if (!(density > 0))
      refuse("Density", density, "it must be positive, in kg/m^3 (steel: 7800)");
    if (density < 0.5 || density > 1e5)
      refuse("Density", density, "no solid has it; give it in kg/m^3 (steel: 7800)");
    if (!(loss_factor >= 0))
      refuse("Loss factor", loss_factor, "it must not be negative");
    if (is_orthotropic())
    {
      orthotropic.check(section + "/Orthotropic", density);
      return;
    }
    if (!(young_modulus > 0))
      refuse("Young modulus", young_modulus, "it must be positive and given in Pa (steel: 2.1e11)");
    if (young_modulus > 1e13)
      refuse("Young modulus", young_modulus, "no material is that stiff; give it in Pa (steel: 2.1e11)");
    if (!(poisson_ratio > -1 && poisson_ratio <= 0.4999))
      refuse("Poisson ratio", poisson_ratio, "it must lie above -1 and not above 0.4999");
    // Sound travels at 10 m/s in the softest rubber and at 18 km/s in diamond.
    const double sound_speed = std::sqrt(young_modulus / density);
    if (sound_speed < 10 || sound_speed > 2e4)
    {
      std::ostringstream text;
      text << section << "/Young modulus is " << young_modulus << " Pa and Density " << density
           << " kg/m^3: no solid has both; give Young modulus in Pa (steel: 2.1e11) and Density in kg/m^3 "
              "(steel: 7800)";
      throw InputError(text.str());
    }
  }
} // namespace vibrocontact

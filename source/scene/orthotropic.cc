#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/orthotropic.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>
#include <utility>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    Tensor<1, 3> as_vector(const std::vector<double> &values)
    {
      return Tensor<1, 3>({values.at(0), values.at(1), values.at(2)});
    }

    /// Unit vectors along the axes 1, 2, 3.
    std::array<Tensor<1, 3>, 3> axes_of(const OrthotropicElasticity &material)
    {
      std::array<Tensor<1, 3>, 3> axes;
      axes[0] = as_vector(material.axis_1);
      axes[0] /= axes[0].norm();
      axes[2] = cross_product_3d(axes[0], as_vector(material.axis_2));
      axes[2] /= axes[2].norm();
      axes[1] = cross_product_3d(axes[2], axes[0]);
      return axes;
    }
  } // namespace

  bool OrthotropicElasticity::is_given() const
  {
    for (const double value : {E1, E2, E3, G12, G13, G23, nu12, nu13, nu23})
      if (value != 0)
        return true;
    return false;
  }

  void OrthotropicElasticity::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    for (const auto &[entry, value] : {std::make_pair("E1", &E1), {"E2", &E2}, {"E3", &E3}})
      prm.add_parameter(entry, *value,
                        "Young's modulus along an axis of an orthotropic material, which takes the place of "
                        "Young modulus and Poisson ratio; 0 for all: isotropic. Units: Pa.",
                        Double(0));
    for (const auto &[entry, value] : {std::make_pair("nu12", &nu12), {"nu13", &nu13}, {"nu23", &nu23}})
      prm.add_parameter(entry, *value,
                        "Contraction along the second axis over the extension along the first, of a pull "
                        "along the first: nu12 / E1 = nu21 / E2. Units: none.",
                        Double(-10, 10));
    for (const auto &[entry, value] : {std::make_pair("G12", &G12), {"G13", &G13}, {"G23", &G23}})
      prm.add_parameter(entry, *value, "Shear modulus between two axes. Units: Pa.", Double(0));
    prm.add_parameter(
        "Axis 1", axis_1,
        "Direction of axis 1 along x, y, z of the mesh; its length does not matter. Units: none.",
        Patterns::List(Double(), 3, 3, ","));
    prm.add_parameter("Axis 2", axis_2,
                      "A direction in the plane of the axes 1 and 2: its part along axis 1 is taken off, "
                      "axis 3 is across both. Units: none.",
                      Patterns::List(Double(), 3, 3, ","));
  }

  void OrthotropicElasticity::check(const std::string &section, const double density) const
  {
    const auto refuse = [&](const std::string &entry, const std::string &what)
    { throw InputError(section + "/" + entry + what); };
    for (const auto &[entry, value] :
         {std::make_pair("E1", E1), {"E2", E2}, {"E3", E3}, {"G12", G12}, {"G13", G13}, {"G23", G23}})
    {
      if (!(value > 0))
        refuse(entry,
               " is 0: an orthotropic material needs E1, E2, E3, G12, G13 and G23; give all of them in "
               "Pa, or none for an isotropic one.");
      // as of isotropic materials, from the softest rubber to diamond; shear may be much softer
      const double sound_speed = std::sqrt(value / density);
      if (value > 1e13 || sound_speed > 2e4 || (entry[0] == 'E' && sound_speed < 10))
        refuse(entry, " is " + number_text(value) + " Pa and Density " + number_text(density) +
                          " kg/m^3: no solid has both; give moduli in Pa and Density in kg/m^3.");
    }
    for (const auto &[entry, nu, first, second] :
         {std::make_tuple("nu12", nu12, E1, E2), {"nu13", nu13, E1, E3}, {"nu23", nu23, E2, E3}})
    {
      const double limit = std::sqrt(first / second);
      if (!(std::abs(nu) < limit))
        refuse(entry, std::string(" is ") + number_text(nu) + ", but its square has to be below E" +
                          entry[2] + " / E" + entry[3] + ", here " + number_text(limit * limit) +
                          ", or a pull would set energy free: lower it (it may be nu" + entry[3] + entry[2] +
                          ").");
    }
    const double nu21 = nu12 * E2 / E1, nu31 = nu13 * E3 / E1, nu32 = nu23 * E3 / E2,
                 rest = 1 - nu12 * nu21 - nu13 * nu31 - nu23 * nu32 - 2 * nu21 * nu32 * nu13;
    if (!(rest > 1e-6))
      throw InputError(section +
                       ": the stiffness of nu12, nu13 and nu23 with E1, E2 and E3 is not positive "
                       "definite: 1 - nu12 nu21 - nu13 nu31 - nu23 nu32 - 2 nu21 nu32 nu13 is " +
                       number_text(rest) + " and has to be positive; lower the Poisson ratios.");
    const Tensor<1, 3> one = as_vector(axis_1), two = as_vector(axis_2);
    for (const auto &[entry, axis] : {std::make_pair("Axis 1", one), {"Axis 2", two}})
      if (!(axis.norm() > 0))
        refuse(entry, " is 0, 0, 0, which has no direction: give one, for instance 0, 1, 0.");
    if (!(cross_product_3d(one, two).norm() > 1e-3 * one.norm() * two.norm()))
      refuse("Axis 2", " is along Axis 1: give any other direction in the plane of the axes 1 and 2.");
  }

  SymmetricTensor<4, 3> OrthotropicElasticity::stiffness() const
  {
    Tensor<2, 3> compliance;
    const double E[] = {E1, E2, E3}, nu[] = {nu12, nu13, nu23}, G[] = {G12, G13, G23};
    for (unsigned int a = 0; a < 3; ++a)
      compliance[a][a] = 1 / E[a];
    const std::pair<unsigned int, unsigned int> pairs[] = {{0, 1}, {0, 2}, {1, 2}};
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto [a, b] = pairs[k];
      compliance[a][b] = compliance[b][a] = -nu[k] / E[a];
    }
    const Tensor<2, 3> normal = invert(compliance);
    const std::array<Tensor<1, 3>, 3> axes = axes_of(*this);
    const auto both = [&](const unsigned int a, const unsigned int b)
    { return symmetrize(outer_product(axes[a], axes[b])); };
    SymmetricTensor<4, 3> result;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        result += normal[a][b] * outer_product(both(a, a), both(b, b));
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto [a, b] = pairs[k];
      result += 4 * G[k] * outer_product(both(a, b), both(a, b));
    }
    return result;
  }
} // namespace vibrocontact

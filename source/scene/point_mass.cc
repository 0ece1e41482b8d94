#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/point_mass.h>

#include <algorithm>

namespace vibrocontact
{
  using namespace dealii;

  void PointMassParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.add_parameter("Groups", groups,
                      "Physical names of the boundaries that the mass is coupled to, all of them together. "
                      "Units: none.",
                      Patterns::List(Patterns::Anything(), 0, 100, ","));
    prm.add_parameter("Rigid", rigid,
                      "true: the groups are rigid with the mass; false: they stay as soft as they are, the "
                      "mass follows the mean of their motion, translation and rotation by least squares over "
                      "their area. Units: none.");
    prm.add_parameter("Mass", mass, "Of the whole. Units: kg.", Double(0, 1e9));
    prm.add_parameter("Place", place,
                      "x, y, z of its centre of mass in the file's coordinates; empty: the centroid of the "
                      "groups. Units: unit of the file.",
                      Patterns::List(Double(), 0, 3, ","));
    prm.add_parameter(
        "Inertia", inertia,
        "Moments of inertia about the centre of mass, Ixx, Iyy, Izz along the axes of the file. "
        "Units: kg m^2.",
        Patterns::List(Double(0), 3, 3, ","));
    prm.add_parameter(
        "Products of inertia", products,
        "Ixy, Ixz, Iyz off the diagonal of the tensor, which are minus the integrals of x y, x z "
        "and y z over the mass. Units: kg m^2.",
        Patterns::List(Double(), 3, 3, ","));
  }

  SymmetricTensor<2, 3> PointMassParameters::inertia_tensor() const
  {
    SymmetricTensor<2, 3> result;
    for (unsigned int d = 0; d < 3; ++d)
      result[d][d] = inertia.at(d);
    result[0][1] = products.at(0);
    result[0][2] = products.at(1);
    result[1][2] = products.at(2);
    return result;
  }

  void PointMassParameters::check(const std::string &section) const
  {
    if (groups.empty())
      throw InputError(section + "/Groups is empty: name the boundaries that the mass is coupled to.");
    for (const std::string &group : groups)
      if (std::count(groups.begin(), groups.end(), group) > 1)
        throw InputError(section + "/Groups names " + group + " twice: give it once.");
    if (!(mass > 0))
      throw InputError(section + "/Mass is 0: give the mass of " + name + " in kg, or leave " + name +
                       " out of Masses.");
    if (!place.empty() && place.size() != 3)
      throw InputError(section + "/Place has " + std::to_string(place.size()) +
                       " numbers: give x, y and z, or nothing for the centroid of the groups.");
    // of masses everywhere: their second moments, tr(I) / 2 - I, are not negative
    const SymmetricTensor<2, 3> I = inertia_tensor();
    const auto principal = eigenvalues(I);
    if (principal[0] > (principal[1] + principal[2]) * (1 + 1e-9) || principal[2] < -1e-9 * principal[0])
      throw InputError(section + "/Inertia belongs to no body: its principal moments are " +
                       number_text(principal[2]) + ", " + number_text(principal[1]) + " and " +
                       number_text(principal[0]) +
                       " kg m^2, none of which may be negative or above the sum of the others; give moments "
                       "about the centre of mass.");
  }
} // namespace vibrocontact

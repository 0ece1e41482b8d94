#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/loads.h>

#include <cmath>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  using namespace dealii;

  void LoadParameters::declare_gravity(ParameterHandler &prm)
  {
    prm.add_parameter("Gravity", gravity, "Acceleration of gravity along -z; 9.81 on earth. Units: m/s^2.",
                      Patterns::Double(-1e4, 1e4));
  }

  void LoadParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    declare_gravity(prm);
    prm.add_parameter("Traction boundary", traction_boundary,
                      "Boundary under a uniform traction; empty: none. Units: none.", Patterns::Anything());
    prm.add_parameter("Traction", traction, "Traction on that boundary along x, y, z. Units: Pa.",
                      Patterns::List(Double(), 3, 3, ","));
    prm.add_parameter("Pressure boundary", pressure_boundary,
                      "Boundary under a uniform pressure; empty: none. Units: none.", Patterns::Anything());
    prm.add_parameter("Pressure", pressure,
                      "Pressure on that boundary, against its outward normal. Units: Pa.", Double());
    prm.add_parameter("Prestress", prestress,
                      "Whether the stress of these loads stiffens the body in modes and everything after "
                      "(geometric stiffness, to first order); that of a Rotation always does. Units: none.");
  }

  void LoadParameters::check(const std::string &section) const
  {
    const bool is_zero = traction[0] == 0 && traction[1] == 0 && traction[2] == 0;
    if (!is_zero && traction_boundary.empty())
      throw InputError(section +
                       "/Traction is given without Traction boundary: name the boundary it acts on.");
    if (pressure != 0 && pressure_boundary.empty())
      throw InputError(section +
                       "/Pressure is given without Pressure boundary: name the boundary it acts on.");
    for (const auto &[entry, value] : {std::make_pair("Traction", traction[0]),
                                       {"Traction", traction[1]},
                                       {"Traction", traction[2]},
                                       {"Pressure", pressure}})
      if (std::abs(value) > 1e12)
      {
        std::ostringstream text;
        text << section << "/" << entry << " of " << value << " Pa is beyond any material; give it in Pa.";
        throw InputError(text.str());
      }
  }

  void add_loads(ElasticModel<3> &model, const LoadParameters &parameters, const BodyMesh<3> &mesh)
  {
    model.gravity[2] = -parameters.gravity;
    model.prestressed = parameters.prestress;
    if (!parameters.traction_boundary.empty())
    {
      SurfaceTraction<3> load;
      load.boundary = mesh.boundary_id(parameters.traction_boundary);
      for (unsigned int d = 0; d < 3; ++d)
        load.traction[d] = parameters.traction.at(d);
      if (load.traction.norm() > 0)
        model.tractions.push_back(load);
    }
    if (!parameters.pressure_boundary.empty())
    {
      const dealii::types::boundary_id boundary = mesh.boundary_id(parameters.pressure_boundary);
      if (parameters.pressure != 0)
        model.pressures.push_back({boundary, parameters.pressure});
    }
  }
} // namespace vibrocontact

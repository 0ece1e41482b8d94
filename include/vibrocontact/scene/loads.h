#pragma once

#include <vibrocontact/scene/body_mesh.h>
#include <vibrocontact/scene/elastic_model.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Loads` of a meshed body: F of Eq. 6.
  struct LoadParameters
  {
    /// acceleration of gravity along -z [m/s^2]
    double gravity = 0;
    /// boundary under a uniform traction, empty: none; traction in x, y, z [Pa]
    std::string traction_boundary;
    std::vector<double> traction = {0, 0, 0};
    /// boundary under a uniform pressure, empty: none; against its outward normal [Pa]
    std::string pressure_boundary;
    double pressure = 0;
    /// the stress of the loads stiffens the body (fe/prestress.h)
    bool prestress = false;

    bool any() const { return gravity != 0 || !traction_boundary.empty() || !pressure_boundary.empty(); }

    /// Of bodies that know no other load.
    void declare_gravity(dealii::ParameterHandler &prm);
    void declare_parameters(dealii::ParameterHandler &prm);
    void check(const std::string &section) const;
  };

  /// Put the loads on a body. @throws InputError listing the boundaries if the named one is missing.
  void add_loads(ElasticModel<3> &model, const LoadParameters &parameters, const BodyMesh<3> &mesh);
} // namespace vibrocontact

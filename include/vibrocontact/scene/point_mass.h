#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/types.h>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A rigid mass that is coupled to parts of the boundary of a solid (fe/attached_points.h).
  struct PointMass
  {
    std::string name;
    std::vector<dealii::types::boundary_id> boundaries;
    /// they are rigid with it; false: it follows their mean motion
    bool rigid = false;
    /// [kg]
    double mass = 0;
    /// of its centre of mass; nothing: the centroid of the boundaries [m]
    std::optional<dealii::Point<3>> place;
    /// about its centre of mass [kg m^2]
    dealii::SymmetricTensor<2, 3> inertia;
  };

  /// `subsection Mass` of a mesh, a subsection of each name in its entry Masses: a motor, a sensor, a weight that is not meshed.
  struct PointMassParameters
  {
    std::string name;
    std::vector<std::string> groups;
    bool rigid = false;
    /// [kg]
    double mass = 0;
    /// in the file's coordinates; empty: the centroid of the groups [unit of the file]
    std::vector<double> place;
    /// Ixx, Iyy, Izz and the products -int rho x y dV, -int rho x z dV, -int rho y z dV about the place [kg m^2]
    std::vector<double> inertia = {0, 0, 0}, products = {0, 0, 0};

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError; `section` is named in it
    void check(const std::string &section) const;
    dealii::SymmetricTensor<2, 3> inertia_tensor() const;
  };
} // namespace vibrocontact

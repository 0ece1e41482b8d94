#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/symmetric_tensor.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Elasticity with three orthogonal planes of symmetry (Jones, Mechanics of Composite Materials, 2.3), in its own axes
  ///
  ///   eps_ii = sigma_ii / E_i - sum_{j != i} nu_ji sigma_jj / E_j,   2 eps_ij = sigma_ij / G_ij,
  ///
  /// with nu_ij / E_i = nu_ji / E_j: nu_ij is the contraction along j over the extension along i of a pull along i.
  struct OrthotropicElasticity
  {
    /// [Pa]; all zero: the material is isotropic
    double E1 = 0, E2 = 0, E3 = 0, G12 = 0, G13 = 0, G23 = 0;
    /// [-]
    double nu12 = 0, nu13 = 0, nu23 = 0;
    /// directions of axis 1 and, in the plane of the axes 1 and 2, of another line; of any length
    std::vector<double> axis_1 = {1, 0, 0}, axis_2 = {0, 1, 0};

    /// Whether any constant is given.
    bool is_given() const;
    /// Entries of `subsection Orthotropic` of a material.
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @param density of the material, for the speed of sound [kg/m^3]
    /// @throws InputError naming @p section if the constants are no material
    void check(const std::string &section, double density) const;
    /// C of sigma = C : eps, in the axes of the body [Pa]
    dealii::SymmetricTensor<4, 3> stiffness() const;
  };
} // namespace vibrocontact

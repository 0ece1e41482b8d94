#pragma once

#include <vibrocontact/scene/orthotropic.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// Linear elastic material with hysteretic loss: sigma = (1 + i eta) (lambda tr(eps) I + 2 mu eps), or with the
  /// constants of an orthotropic one, of solids alone.
  struct ElasticMaterial
  {
    double young_modulus = 206.9e9; ///< [Pa]
    double poisson_ratio = 0.288;   ///< [-]
    double density = 7800;          ///< [kg/m^3]
    double loss_factor = 0;         ///< eta [-]

    /// in place of Young's modulus and Poisson's ratio, if it is given
    OrthotropicElasticity orthotropic;

    bool is_orthotropic() const { return orthotropic.is_given(); }
    /// C of sigma = C : eps [Pa]
    dealii::SymmetricTensor<4, 3> stiffness() const;

    /// Lame coefficients of an isotropic one [Pa]
    double lambda() const
    {
      return young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
    }
    double mu() const { return young_modulus / (2 * (1 + poisson_ratio)); }

    /// Entries of `subsection Material` of a body.
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError naming @p section if the numbers are no material or look like another unit.
    void check(const std::string &section) const;
  };
} // namespace vibrocontact

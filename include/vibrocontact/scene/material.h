#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// Isotropic linear elastic material with hysteretic loss, sigma = (1 + i eta) (lambda tr(eps) I + 2 mu
  /// eps).
  struct ElasticMaterial
  {
    double young_modulus = 206.9e9; ///< [Pa]
    double poisson_ratio = 0.288;   ///< [-]
    double density = 7800;          ///< [kg/m^3]
    double loss_factor = 0;         ///< eta [-]

    /// Lame coefficients [Pa]
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

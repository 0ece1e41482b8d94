#pragma once

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <map>
#include <vector>

namespace vibrocontact
{
  /// A motion as a sum of fields, by their numbers.
  using BeamMotion = std::map<unsigned int, double>;

  /// factor * (sum of value[f] field_f + slope[f] field_f')^2: an energy per length of a beam, or of a spring on it.
  struct BeamEnergy
  {
    double factor;
    BeamMotion value, slope;
  };

  /// matrix += weight * sum of energies, at a quadrature point
  void add_energies(dealii::FullMatrix<double> &matrix, const std::vector<BeamEnergy> &energies,
                    const dealii::FEValues<1> &values, unsigned int q, double weight);
} // namespace vibrocontact

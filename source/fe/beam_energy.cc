#include <vibrocontact/fe/beam_energy.h>

namespace vibrocontact
{
  void add_energies(dealii::FullMatrix<double> &matrix, const std::vector<BeamEnergy> &energies,
                    const dealii::FEValues<1> &values, const unsigned int q, const double weight)
  {
    const dealii::FiniteElement<1> &element = values.get_fe();
    const auto coefficient = [](const BeamMotion &of, const unsigned int field)
    {
      const auto found = of.find(field);
      return found == of.end() ? 0. : found->second;
    };
    dealii::Vector<double> row(element.n_dofs_per_cell());
    for (const BeamEnergy &energy : energies)
    {
      for (unsigned int k = 0; k < row.size(); ++k)
      {
        const unsigned int field = element.system_to_component_index(k).first;
        row(k) = coefficient(energy.value, field) * values.shape_value(k, q) +
                 coefficient(energy.slope, field) * values.shape_grad(k, q)[0];
      }
      for (unsigned int a = 0; a < row.size(); ++a)
        if (row(a) != 0)
          for (unsigned int b = 0; b < row.size(); ++b)
            matrix(a, b) += weight * energy.factor * row(a) * row(b);
    }
  }
} // namespace vibrocontact

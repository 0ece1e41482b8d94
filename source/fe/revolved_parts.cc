#include <vibrocontact/fe/revolved_section.h>

namespace vibrocontact
{
  using namespace dealii;

  std::vector<RevolvedSection::Part> RevolvedSection::parts() const
  {
    std::vector<Part> result;
    for (const auto &cell : dof_handler.active_cell_iterators())
      result.push_back({cell->center(), cell->material_id()});
    return result;
  }

  std::vector<std::vector<double>>
  RevolvedSection::energies_of_parts(const unsigned int n,
                                     const std::vector<PETScWrappers::MPI::Vector> &shapes) const
  {
    const AffineConstraints<double> constraints = this->constraints(n);
    const unsigned int n_shapes = shapes.size(), n_local = element.n_dofs_per_cell();
    const double all_around = n == 0 ? 2 * numbers::PI : numbers::PI;
    std::vector<Vector<double>> whole(n_shapes, Vector<double>(n_dofs()));
    for (unsigned int k = 0; k < n_shapes; ++k)
    {
      for (unsigned int dof = 0; dof < n_dofs(); ++dof)
        whole[k](dof) = shapes[k](dof);
      constraints.distribute(whole[k]);
    }
    std::vector<std::vector<double>> result(cells.size(), std::vector<double>(n_shapes * n_shapes));
    FullMatrix<double> K;
    std::vector<Vector<double>> local(n_shapes, Vector<double>(n_local));
    Vector<double> force(n_local);
    for (unsigned int c = 0; c < cells.size(); ++c)
    {
      const Cell &cell = cells[c];
      K = cell.K_0;
      K.add(double(n), cell.K_1, double(n) * n, cell.K_2);
      K *= all_around;
      for (unsigned int k = 0; k < n_shapes; ++k)
        for (unsigned int i = 0; i < n_local; ++i)
          local[k](i) = whole[k](cell.dofs[i]);
      for (unsigned int k = 0; k < n_shapes; ++k)
      {
        K.vmult(force, local[k]);
        for (unsigned int l = 0; l < n_shapes; ++l)
          result[c][k * n_shapes + l] = local[l] * force;
      }
    }
    return result;
  }
} // namespace vibrocontact

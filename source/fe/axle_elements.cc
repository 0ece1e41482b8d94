#include <vibrocontact/fe/axle_elements.h>
#include <vibrocontact/fe/beam_energy.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

namespace vibrocontact
{
  using namespace dealii;

  AxleMatrices axle_matrices(const AxleParameters &axle, const unsigned int n_elements,
                             const unsigned int degree)
  {
    // translations along x, y, z, rotations about them
    enum : unsigned int
    {
      ux,
      uy,
      uz,
      wx,
      wy,
      wz,
      n_fields
    };
    const double E = axle.material.young_modulus, G = axle.material.mu(), rho = axle.material.density,
                 A = axle.area(), I = axle.moment(), shear = axle.shear_coefficient() * G * A;
    const std::vector<BeamEnergy> elastic = {
        {E * A, {}, {{uy, 1.}}}, {2 * G * I, {}, {{wy, 1.}}},      {E * I, {}, {{wx, 1.}}},
        {E * I, {}, {{wz, 1.}}}, {shear, {{wz, -1.}}, {{ux, 1.}}}, {shear, {{wx, 1.}}, {{uz, 1.}}}};
    const std::vector<BeamEnergy> inert = {{rho * A, {{ux, 1.}}, {}}, {rho * A, {{uy, 1.}}, {}},
                                           {rho * A, {{uz, 1.}}, {}}, {2 * rho * I, {{wy, 1.}}, {}},
                                           {rho * I, {{wx, 1.}}, {}}, {rho * I, {{wz, 1.}}, {}}};
    Triangulation<1> mesh;
    GridGenerator::subdivided_hyper_cube(mesh, n_elements, 0., axle.length);
    const FESystem<1> element(FE_Q<1>(degree), n_fields);
    DoFHandler<1> dof_handler(mesh);
    dof_handler.distribute_dofs(element);

    // ends first
    constexpr unsigned int none = -1;
    std::vector<unsigned int> place(dof_handler.n_dofs(), none);
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (unsigned int v = 0; v < 2; ++v)
        if (cell->face(v)->at_boundary())
          for (unsigned int field = 0; field < n_fields; ++field)
            place[cell->vertex_dof_index(v, field)] = v * n_fields + field;
    unsigned int next = 2 * n_fields;
    for (unsigned int &one : place)
      if (one == none)
        one = next++;

    AxleMatrices result;
    result.mass.reinit(next, next);
    result.stiffness.reinit(next, next);
    const QGauss<1> gauss(degree + 1);
    FEValues<1> values(element, gauss, update_values | update_gradients | update_JxW_values);
    const unsigned int n = element.n_dofs_per_cell();
    FullMatrix<double> mass(n), stiffness(n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      mass = stiffness = 0;
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        add_energies(stiffness, elastic, values, q, values.JxW(q));
        add_energies(mass, inert, values, q, values.JxW(q));
      }
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
        {
          result.mass(place[dofs[a]], place[dofs[b]]) += mass(a, b);
          result.stiffness(place[dofs[a]], place[dofs[b]]) += stiffness(a, b);
        }
    }
    return result;
  }
} // namespace vibrocontact

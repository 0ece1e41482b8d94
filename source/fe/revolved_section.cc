#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/revolved_section.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// nodes nearer to it lie on the axle [m]
    constexpr double axle_radius = 1e-9;

    /// integral of cos^2 or sin^2 around the axle
    double around(const unsigned int n)
    {
      return n == 0 ? 2 * numbers::PI : numbers::PI;
    }

    /// strains of a shape N of one component, constant and linear in n: aa, rr, tt, ar, rt, at
    using Strain = std::array<double, 6>;
    void strains(const unsigned int component, const double N, const Tensor<1, 2> &gradient, const double r,
                 Strain &constant, Strain &linear)
    {
      const double N_a = gradient[0], N_r = gradient[1];
      switch (component)
      {
      case RevolvedSection::axial:
        constant = {{N_a, 0, 0, N_r, 0, 0}};
        linear = {{0, 0, 0, 0, 0, -N / r}};
        break;
      case RevolvedSection::radial:
        constant = {{0, N_r, N / r, N_a, 0, 0}};
        linear = {{0, 0, 0, 0, -N / r, 0}};
        break;
      default:
        constant = {{0, 0, 0, 0, N_r - N / r, N_a}};
        linear = {{0, 0, N / r, 0, 0, 0}};
      }
    }

    /// a^T D b of an isotropic material
    double energy(const ElasticMaterial &material, const Strain &a, const Strain &b)
    {
      const double lambda = material.lambda(), mu = material.mu();
      return lambda * (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2]) +
             2 * mu * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) +
             mu * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
    }
  } // namespace

  RevolvedSection::RevolvedSection(const std::string &name,
                                   std::shared_ptr<const Triangulation<2>> triangulation_,
                                   const ElasticModel<3> &model, const unsigned int degree,
                                   const std::function<Point<2>(const Point<2> &)> &displacement)
      : name(name), triangulation(std::move(triangulation_)), model(model), element(FE_Q<2>(degree), 3),
        mapping(degree), dof_handler(*triangulation)
  {
    // of no higher order than the displacements: straight motions of the body are among them
    mapping.initialize(
        MappingQ<2>(degree), *triangulation,
        [&](const typename Triangulation<2>::cell_iterator &, const Point<2> &p)
        { return displacement ? displacement(p) : Point<2>(); },
        true);
    dof_handler.distribute_dofs(element);
    compute_cells();
  }

  /// Hanging nodes, held boundaries and, on the axle, what makes a motion smooth there: n = 0 is axial alone, n = 1 across,
  /// U = -V, more waves do not move it.
  AffineConstraints<double> RevolvedSection::constraints(const unsigned int n) const
  {
    AffineConstraints<double> result;
    DoFTools::make_hanging_node_constraints(dof_handler, result);
    for (const HeldBoundary<3> &part : model.held)
      DoFTools::make_zero_boundary_constraints(dof_handler, part.boundary, result);
    std::map<double, types::global_dof_index> on_axle;
    for (unsigned int dof = 0; dof < n_dofs(); ++dof)
      if (places[dof][1] < axle_radius && directions[dof] == radial)
        on_axle[places[dof][0]] = dof;
    for (unsigned int dof = 0; dof < n_dofs(); ++dof)
      if (places[dof][1] < axle_radius && !result.is_constrained(dof))
      {
        const unsigned char c = directions[dof];
        if (n == 1 && c == circumferential)
        {
          result.add_line(dof);
          result.add_entry(dof, on_axle.at(places[dof][0]), -1.);
        }
        else if (n > 1 || (n == 1 && c == axial) || (n == 0 && c != axial))
          result.add_line(dof);
      }
    result.close();
    return result;
  }

  void RevolvedSection::compute_cells()
  {
    const FiniteElement<2> &scalar = element.base_element(0);
    const unsigned int n = element.n_dofs_per_cell();
    FEValues<2> values(mapping, scalar, QGauss<2>(scalar.degree + 2),
                       update_values | update_gradients | update_JxW_values | update_quadrature_points);
    FEValues<2> nodes(mapping, element, Quadrature<2>(element.get_unit_support_points()),
                      update_quadrature_points);
    places.resize(dof_handler.n_dofs());
    directions.resize(dof_handler.n_dofs());
    std::vector<Strain> constant(n), linear(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(typename Triangulation<2>::active_cell_iterator(cell));
      nodes.reinit(cell);
      const ElasticMaterial &material = model.material_of(cell->material_id());
      Cell here;
      here.dofs.resize(n);
      cell->get_dof_indices(here.dofs);
      here.loss_factor = material.loss_factor;
      for (auto *const matrix : {&here.K_0, &here.K_1, &here.K_2, &here.M})
        matrix->reinit(n, n);
      here.weight.reinit(n);
      here.centrifugal.reinit(n);
      for (unsigned int k = 0; k < n; ++k)
      {
        places[here.dofs[k]] = nodes.quadrature_point(k);
        directions[here.dofs[k]] = element.system_to_component_index(k).first;
      }
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
      {
        const double r = values.quadrature_point(q)[1], dA = values.JxW(q) * r;
        if (!(r > 0))
          throw InputError("The section of body " + name + " crosses its axle: it reaches a radius of " +
                           number_text(r) + " m; give one half of the section, all radii above 0.");
        if (!(dA > 0))
          throw InputError("The section of body " + name + " has a cell that is inverted at (" +
                           number_text(values.quadrature_point(q)[0]) + ", " + number_text(r) +
                           ") m: change the thickness of its web by less, or give it smaller cells.");
        total_mass += 2 * numbers::PI * material.density * dA;
        for (unsigned int k = 0; k < n; ++k)
        {
          const auto [component, node] = element.system_to_component_index(k);
          strains(component, values.shape_value(node, q), values.shape_grad(node, q), r, constant[k],
                  linear[k]);
          here.weight(k) += material.density * values.shape_value(node, q) * dA;
          if (component == radial)
            here.centrifugal(k) += material.density * r * values.shape_value(node, q) * dA;
        }
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int l = 0; l <= k; ++l)
          {
            here.K_0(k, l) += energy(material, constant[k], constant[l]) * dA;
            here.K_1(k, l) +=
                (energy(material, constant[k], linear[l]) + energy(material, linear[k], constant[l])) * dA;
            here.K_2(k, l) += energy(material, linear[k], linear[l]) * dA;
            const auto [c, a] = element.system_to_component_index(k);
            const auto [d, b] = element.system_to_component_index(l);
            if (c == d)
              here.M(k, l) += material.density * values.shape_value(a, q) * values.shape_value(b, q) * dA;
          }
      }
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < k; ++l)
          for (auto *const matrix : {&here.K_0, &here.K_1, &here.K_2, &here.M})
            (*matrix)(l, k) = (*matrix)(k, l);
      cells.push_back(std::move(here));
    }
  }

  std::unique_ptr<SecondOrderSystem> RevolvedSection::system(const unsigned int n,
                                                             const std::vector<double> &added_loss) const
  {
    std::vector<double> loss_factor = added_loss;
    loss_factor.resize(cells.size(), 0.);
    for (unsigned int c = 0; c < cells.size(); ++c)
      loss_factor[c] += cells[c].loss_factor;
    auto result = std::make_unique<SecondOrderSystem>();
    SecondOrderSystem &system = *result;
    system.body = name;
    system.communicator = MPI_COMM_SELF;
    system.locally_owned = complete_index_set(n_dofs());
    system.total_mass = total_mass;
    system.has_loss =
        std::any_of(loss_factor.begin(), loss_factor.end(), [](const double loss) { return loss > 0; });
    const AffineConstraints<double> constraints = this->constraints(n);
    DynamicSparsityPattern pattern(n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
    const IndexSet &owned = system.locally_owned;
    system.stiffness.reinit(owned, owned, pattern, MPI_COMM_SELF);
    system.mass.reinit(system.stiffness);
    if (system.has_loss)
      system.loss_stiffness.reinit(system.stiffness);
    FullMatrix<double> K, M;
    for (unsigned int c = 0; c < cells.size(); ++c)
    {
      const Cell &cell = cells[c];
      K = cell.K_0;
      K.add(double(n), cell.K_1, double(n) * n, cell.K_2);
      K *= around(n);
      M = cell.M;
      M *= around(n);
      constraints.distribute_local_to_global(K, cell.dofs, system.stiffness);
      constraints.distribute_local_to_global(M, cell.dofs, system.mass);
      if (system.has_loss)
      {
        K *= loss_factor[c];
        constraints.distribute_local_to_global(K, cell.dofs, system.loss_stiffness);
      }
    }
    for (auto *const matrix : {&system.stiffness, &system.mass, &system.loss_stiffness})
      if (matrix != &system.loss_stiffness || system.has_loss)
        matrix->compress(VectorOperation::add);
    for (unsigned int dof = 0; dof < n_dofs(); ++dof)
    {
      if (constraints.is_constrained(dof))
      {
        system.mass.set(dof, dof, 0.);
        if (system.has_loss)
          system.loss_stiffness.set(dof, dof, 0.);
      }
      // along x, y, z of the contact frame at theta = 0
      system.dof_position.emplace_back(0., places[dof][0], -places[dof][1]);
      system.dof_direction.push_back(directions[dof] == axial ? 1 : directions[dof] == radial ? 2 : 0);
    }
    system.mass.compress(VectorOperation::insert);
    if (system.has_loss)
      system.loss_stiffness.compress(VectorOperation::insert);
    if (!model.is_supported())
      add_rigid_motions(n, constraints, system);
    system.follows_hub = !model.held.empty();
    return result;
  }

  /// n = 0: along the axle and about it; n = 1: across it and tilt about the place a = 0.
  void RevolvedSection::add_rigid_motions(const unsigned int n, const AffineConstraints<double> &constraints,
                                          SecondOrderSystem &system) const
  {
    if (n > 1)
      return;
    for (unsigned int motion = 0; motion < 2; ++motion)
    {
      PETScWrappers::MPI::Vector v(system.locally_owned, MPI_COMM_SELF);
      for (unsigned int dof = 0; dof < n_dofs(); ++dof)
      {
        if (constraints.is_constrained(dof))
          continue;
        const double a = places[dof][0], r = places[dof][1];
        const unsigned char c = directions[dof];
        const double across = c == radial ? 1. : c == circumferential ? -1. : 0.;
        v(dof) = n == 0 ? (motion == 0            ? double(c == axial)
                           : c == circumferential ? r
                                                  : 0.)
                        : (motion == 0  ? across
                           : c == axial ? -r
                                        : a * across);
      }
      v.compress(VectorOperation::insert);
      for (const auto &other : system.rigid_motions)
        v.add(-(v * other), other);
      v /= v.l2_norm();
      system.rigid_motions.push_back(v);
    }
    system.n_rigid_modes = 2;
  }

  std::unique_ptr<PETScWrappers::MPI::Vector> RevolvedSection::weight(const unsigned int n,
                                                                      const bool odd) const
  {
    // e_z = -e_r cos(theta) + e_t sin(theta), e_x = e_r sin(theta) + e_t cos(theta)
    const double across = odd ? model.gravity[0] : -model.gravity[2];
    const std::array<double, 3> along = n == 0   ? std::array<double, 3>{{model.gravity[1], 0., 0.}}
                                        : n == 1 ? std::array<double, 3>{{0., across, -across}}
                                                 : std::array<double, 3>{};
    const bool pulls = std::any_of(along.begin(), along.end(), [](const double g) { return g != 0; });
    if (!pulls || (n == 0 && odd))
      return nullptr;
    const AffineConstraints<double> constraints = this->constraints(n);
    auto result = std::make_unique<PETScWrappers::MPI::Vector>(complete_index_set(n_dofs()), MPI_COMM_SELF);
    for (const Cell &cell : cells)
    {
      Vector<double> load = cell.weight;
      for (unsigned int k = 0; k < load.size(); ++k)
        load(k) *= around(n) * along[directions[cell.dofs[k]]];
      constraints.distribute_local_to_global(load, cell.dofs, *result);
    }
    result->compress(VectorOperation::add);
    return result;
  }

  PETScWrappers::MPI::Vector RevolvedSection::centrifugal_load() const
  {
    const AffineConstraints<double> constraints = this->constraints(0);
    PETScWrappers::MPI::Vector result(complete_index_set(n_dofs()), MPI_COMM_SELF);
    for (const Cell &cell : cells)
    {
      Vector<double> load = cell.centrifugal;
      load *= around(0);
      constraints.distribute_local_to_global(load, cell.dofs, result);
    }
    result.compress(VectorOperation::add);
    return result;
  }

  FullMatrix<double> RevolvedSection::geometric_stiffness(const DoFHandler<2>::active_cell_iterator &cell,
                                                          const unsigned int n,
                                                          const Vector<double> &stretched) const
  {
    const FiniteElement<2> &scalar = element.base_element(0);
    const unsigned int n_dofs = element.n_dofs_per_cell();
    FEValues<2> values(mapping, scalar, QGauss<2>(scalar.degree + 2),
                       update_values | update_gradients | update_JxW_values | update_quadrature_points);
    values.reinit(typename Triangulation<2>::active_cell_iterator(cell));
    const ElasticMaterial &material = model.material_of(cell->material_id());
    FullMatrix<double> result(n_dofs, n_dofs);
    for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    {
      const double r = values.quadrature_point(q)[1], dA = values.JxW(q) * r;
      Strain strain{}, constant, linear;
      for (unsigned int k = 0; k < n_dofs; ++k)
      {
        const auto [component, node] = element.system_to_component_index(k);
        strains(component, values.shape_value(node, q), values.shape_grad(node, q), r, constant, linear);
        for (unsigned int i = 0; i < strain.size(); ++i)
          strain[i] += stretched(k) * constant[i];
      }
      const double mean = material.lambda() * (strain[0] + strain[1] + strain[2]), mu = material.mu();
      const double aa = mean + 2 * mu * strain[0], rr = mean + 2 * mu * strain[1],
                   tt = mean + 2 * mu * strain[2], ar = mu * strain[3];
      for (unsigned int k = 0; k < n_dofs; ++k)
        for (unsigned int l = 0; l < n_dofs; ++l)
        {
          const auto [c, a] = element.system_to_component_index(k);
          const auto [d, b] = element.system_to_component_index(l);
          const Tensor<1, 2> &u = values.shape_grad(a, q), &v = values.shape_grad(b, q);
          const double N = values.shape_value(a, q) * values.shape_value(b, q) / (r * r);
          // d/dtheta of a vector: n U + V, n V + U, n W
          if (c == d)
            result(k, l) += dA * (aa * u[0] * v[0] + rr * u[1] * v[1] + ar * (u[0] * v[1] + u[1] * v[0]) +
                                  tt * N * (double(n) * n + (c == axial ? 0. : 1.)));
          else if (c != axial && d != axial)
            result(k, l) += dA * tt * N * 2 * n;
        }
    }
    return result;
  }

  std::unique_ptr<RevolvedRotation>
  RevolvedSection::rotation(const unsigned int n, const PETScWrappers::MPI::Vector &stretched) const
  {
    const AffineConstraints<double> constraints = this->constraints(n), at_rest = this->constraints(0);
    auto result = std::make_unique<RevolvedRotation>();
    DynamicSparsityPattern pattern(n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
    const IndexSet owned = complete_index_set(n_dofs());
    const auto all = {&result->coriolis, &result->centripetal, &result->geometric};
    for (auto *const matrix : all)
      matrix->reinit(owned, owned, pattern, MPI_COMM_SELF);
    Vector<double> whole(n_dofs());
    for (unsigned int dof = 0; dof < n_dofs(); ++dof)
      whole(dof) = stretched(dof);
    at_rest.distribute(whole);

    const unsigned int n_local = element.n_dofs_per_cell();
    FullMatrix<double> S(n_local, n_local), G, C;
    Vector<double> local(n_local);
    auto here = cells.begin();
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      S = 0;
      C = 0;
      C.reinit(n_local, n_local);
      for (unsigned int k = 0; k < n_local; ++k)
        for (unsigned int l = 0; l < n_local; ++l)
        {
          const auto [c, a] = element.system_to_component_index(k);
          const auto [d, b] = element.system_to_component_index(l);
          if (c == axial || d == axial)
            continue;
          // the mass between the same components of both nodes
          const double m = here->M(element.component_to_system_index(radial, a),
                                   element.component_to_system_index(radial, b));
          (c == d ? C : S)(k, l) = m;
        }
      G = S;
      G.add(n, here->M);
      C.add(2. * n, S, double(n) * n, here->M);
      for (unsigned int k = 0; k < n_local; ++k)
        local(k) = whole(here->dofs[k]);
      FullMatrix<double> K = geometric_stiffness(cell, n, local);
      for (auto *const matrix : {&G, &C, &K})
        *matrix *= around(n);
      constraints.distribute_local_to_global(G, here->dofs, result->coriolis);
      constraints.distribute_local_to_global(C, here->dofs, result->centripetal);
      constraints.distribute_local_to_global(K, here->dofs, result->geometric);
      ++here;
    }
    for (auto *const matrix : all)
    {
      matrix->compress(VectorOperation::add);
      for (unsigned int dof = 0; dof < n_dofs(); ++dof)
        if (constraints.is_constrained(dof))
          matrix->set(dof, dof, 0.);
      matrix->compress(VectorOperation::insert);
    }
    return result;
  }
} // namespace vibrocontact

#include <vibrocontact/fe/attached_points.h>
#include <vibrocontact/fe/elasticity.h>
#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Stiffness and mass of one cell; the dofs of a node are found through the primitive element's indices.
    template <int dim>
    class CellMatrices
    {
    public:
      explicit CellMatrices(const FESystem<dim> &element)
          : element(element), n_nodes(element.base_element(0).n_dofs_per_cell()), dof_of(n_nodes * dim),
            products(n_nodes * dim, n_nodes * dim), scalar_mass(n_nodes, n_nodes),
            stiffness(n_nodes * dim, n_nodes * dim), mass(n_nodes * dim, n_nodes * dim)
      {
        for (unsigned int k = 0; k < element.n_dofs_per_cell(); ++k)
        {
          const auto [component, node] = element.system_to_component_index(k);
          dof_of[node * dim + component] = k;
        }
      }

      /// @p values are those of the scalar element.
      void compute(const FEValues<dim> &values, const ElasticMaterial &material)
      {
        const unsigned int n = n_nodes, nd = n * dim, n_q = values.n_quadrature_points;
        gradients.resize(n_q * nd);
        shapes.resize(n_q * n);
        volume = 0;
        for (unsigned int q = 0; q < n_q; ++q)
        {
          const double root = std::sqrt(values.JxW(q));
          volume += values.JxW(q);
          for (unsigned int a = 0; a < n; ++a)
          {
            const Tensor<1, dim> gradient = values.shape_grad(a, q);
            for (unsigned int i = 0; i < dim; ++i)
              gradients[q * nd + i * n + a] = root * gradient[i];
            shapes[q * n + a] = root * values.shape_value(a, q);
          }
        }
        rank_update(gradients, n_q, nd, products);
        rank_update(shapes, n_q, n, scalar_mass);

        const double rho = material.density;
        if (material.is_orthotropic())
          add_orthotropic(material.stiffness());
        else
          add_isotropic(material.lambda(), material.mu());
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int i = 0; i < dim; ++i)
              mass(dof_of[a * dim + i], dof_of[b * dim + i]) = rho * scalar_mass(a, b);
      }

    private:
      void add_isotropic(const double lambda, const double mu)
      {
        const unsigned int n = n_nodes;
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
          {
            double trace = 0;
            for (unsigned int i = 0; i < dim; ++i)
              trace += products(i * n + a, i * n + b);
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                stiffness(dof_of[a * dim + i], dof_of[b * dim + j]) =
                    lambda * products(i * n + a, j * n + b) + mu * products(j * n + a, i * n + b) +
                    (i == j ? mu * trace : 0.);
          }
      }

      /// K_{(a,i)(b,j)} = C_ikjl int N_a,k N_b,l dV
      void add_orthotropic(const SymmetricTensor<4, 3> &C)
      {
        const unsigned int n = n_nodes;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
          {
            double here[dim][dim];
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = 0; l < dim; ++l)
                here[k][l] = C[i][k][j][l];
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int b = 0; b < n; ++b)
              {
                double sum = 0;
                for (unsigned int k = 0; k < dim; ++k)
                  for (unsigned int l = 0; l < dim; ++l)
                    sum += here[k][l] * products(k * n + a, l * n + b);
                stiffness(dof_of[a * dim + i], dof_of[b * dim + j]) = sum;
              }
          }
      }

      /// C = B^T B with B of size rows x columns, row by row.
      static void rank_update(const std::vector<double> &B, const unsigned int rows,
                              const unsigned int columns, FullMatrix<double> &C)
      {
        C = 0;
        for (unsigned int q = 0; q < rows; ++q)
        {
          const double *row = B.data() + q * columns;
          for (unsigned int a = 0; a < columns; ++a)
          {
            const double factor = row[a];
            double *out = &C(a, 0);
            for (unsigned int b = a; b < columns; ++b)
              out[b] += factor * row[b];
          }
        }
        for (unsigned int a = 0; a < columns; ++a)
          for (unsigned int b = 0; b < a; ++b)
            C(a, b) = C(b, a);
      }

      const FESystem<dim> &element;
      const unsigned int n_nodes;
      std::vector<unsigned int> dof_of;
      std::vector<double> gradients, shapes;
      FullMatrix<double> products, scalar_mass;

    public:
      FullMatrix<double> stiffness, mass;
      double volume = 0;
    };

    /// Of hexahedra: reference interval of a face's first or second direction that lies in a segment of x; the direction is
    /// the one along which x varies most.
    template <int dim>
    std::vector<Quadrature<dim - 1>> bed_quadratures(const typename DoFHandler<dim>::face_iterator &face,
                                                     const SpringBed<dim> &bed, const unsigned int n_points)
    {
      unsigned int direction = 0;
      double span = 0;
      for (unsigned int d = 0; d < dim - 1; ++d)
      {
        const double dx = face->vertex(1u << d)[0] - face->vertex(0)[0];
        if (std::abs(dx) > std::abs(span))
        {
          span = dx;
          direction = d;
        }
      }
      std::vector<Quadrature<dim - 1>> result;
      if (std::abs(span) < 1e-9 * face->diameter())
      {
        // a face across x lies in a segment as a whole or not at all
        const double x = face->center()[0];
        for (const auto &[from, to] : bed.segments)
          if (x >= std::min(from, to) && x < std::max(from, to))
            result.emplace_back(QGauss<dim - 1>(n_points));
        return result;
      }
      for (const auto &[from, to] : bed.segments)
      {
        double s0 = (from - face->vertex(0)[0]) / span, s1 = (to - face->vertex(0)[0]) / span;
        if (s0 > s1)
          std::swap(s0, s1);
        s0 = std::max(s0, 0.);
        s1 = std::min(s1, 1.);
        if (s1 - s0 < 1e-9)
          continue;
        QGauss<dim - 1> full(n_points);
        std::vector<Point<dim - 1>> points = full.get_points();
        std::vector<double> weights = full.get_weights();
        for (unsigned int q = 0; q < points.size(); ++q)
        {
          points[q][direction] = s0 + (s1 - s0) * points[q][direction];
          weights[q] *= s1 - s0;
        }
        result.emplace_back(points, weights);
      }
      return result;
    }
  } // namespace

  template <int dim>
  std::unique_ptr<SecondOrderSystem> assemble_elasticity(const ElasticBody<dim> &body)
  {
    const MPI_Comm communicator = body.communicator();
    const auto &model = body.model;
    const auto &element = body.element;
    const unsigned int n_dofs_per_cell = element.n_dofs_per_cell();

    auto result = std::make_unique<SecondOrderSystem>();
    SecondOrderSystem &system = *result;
    system.body = body.mesh.name;
    system.communicator = communicator;
    system.locally_owned = body.locally_owned;
    system.has_loss = model.has_loss();
    system.has_damping = model.has_damping();
    system.has_load = model.has_load();
    std::vector<AttachedPoint> attached;
    if constexpr (dim == 3)
      attached = attached_points(body);

    {
      DynamicSparsityPattern pattern(body.locally_relevant);
      DoFTools::make_sparsity_pattern(body.dof_handler, pattern, body.constraints, false);
      add_places(attached, body.locally_owned, pattern);
      SparsityTools::distribute_sparsity_pattern(pattern, body.locally_owned, communicator,
                                                 body.locally_relevant);
      system.stiffness.reinit(body.locally_owned, body.locally_owned, pattern, communicator);
      if (system.has_loss)
        system.loss_stiffness.reinit(system.stiffness);
      if (system.has_damping)
        system.damping.reinit(system.stiffness);
    }
    {
      // the mass couples no two directions: a third of the entries
      Table<2, DoFTools::Coupling> couplings(dim, dim);
      couplings.fill(DoFTools::none);
      for (unsigned int d = 0; d < dim; ++d)
        couplings(d, d) = DoFTools::always;
      DynamicSparsityPattern pattern(body.locally_relevant);
      DoFTools::make_sparsity_pattern(body.dof_handler, couplings, pattern, body.constraints, false);
      add_places(attached, body.locally_owned, pattern);
      SparsityTools::distribute_sparsity_pattern(pattern, body.locally_owned, communicator,
                                                 body.locally_relevant);
      system.mass.reinit(body.locally_owned, body.locally_owned, pattern, communicator);
    }
    if (system.has_load)
      system.load.reinit(body.locally_owned, communicator);

    const FiniteElement<dim> &scalar = element.base_element(0);
    const unsigned int n_gauss = n_gauss_points(body.mesh, scalar);
    FEValues<dim> values(body.mapping, scalar, cell_quadrature<dim>(scalar.reference_cell(), n_gauss),
                         update_values | update_gradients | update_JxW_values | update_quadrature_points);
    FaceValues<dim> face_values(body.mapping, scalar, n_gauss);
    CellMatrices<dim> cell_matrices(element);
    FullMatrix<double> spring(n_dofs_per_cell, n_dofs_per_cell), loss(n_dofs_per_cell, n_dofs_per_cell),
        dashpots(n_dofs_per_cell, n_dofs_per_cell);
    Vector<double> cell_load(n_dofs_per_cell);
    std::vector<types::global_dof_index> dofs(n_dofs_per_cell);
    double total_mass = 0;

    for (const auto &cell : body.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      values.reinit(typename Triangulation<dim>::active_cell_iterator(cell));
      const ElasticMaterial &material = model.material_of(cell->material_id());
      cell_matrices.compute(values, material);
      total_mass += material.density * cell_matrices.volume;
      cell->get_dof_indices(dofs);

      if (system.has_loss)
      {
        loss = cell_matrices.stiffness;
        loss *= material.loss_factor;
      }
      dashpots = 0;
      bool on_dashpots = false;
      cell_load = 0;
      if (model.has_body_force())
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          const Tensor<1, dim> acceleration =
              model.gravity + model.rotation.centrifugal(values.quadrature_point(q));
          for (unsigned int k = 0; k < n_dofs_per_cell; ++k)
          {
            const auto [component, node] = element.system_to_component_index(k);
            cell_load(k) +=
                material.density * acceleration[component] * values.shape_value(node, q) * values.JxW(q);
          }
        }

      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary())
          continue;
        const types::boundary_id id = cell->face(f)->boundary_id();
        for (const auto &load : model.tractions)
          if (load.boundary == id)
          {
            face_values.reinit(cell, f);
            for (unsigned int k = 0; k < n_dofs_per_cell; ++k)
            {
              const auto [component, node] = element.system_to_component_index(k);
              for (unsigned int q = 0; q < face_values.n_points(); ++q)
                cell_load(k) +=
                    load.traction[component] * face_values.shape_value(node, q) * face_values.JxW(q);
            }
          }
        for (const SurfacePressure &load : model.pressures)
          if (load.boundary == id)
          {
            face_values.reinit(cell, f);
            for (unsigned int k = 0; k < n_dofs_per_cell; ++k)
            {
              const auto [component, node] = element.system_to_component_index(k);
              for (unsigned int q = 0; q < face_values.n_points(); ++q)
                cell_load(k) -= load.pressure * face_values.normal_vector(q)[component] *
                                face_values.shape_value(node, q) * face_values.JxW(q);
            }
          }
        for (const auto &bed : model.springs)
          if (bed.boundary == id)
          {
            spring = 0;
            const bool is_damped = bed.damping_per_area.norm() > 0;
            on_dashpots = on_dashpots || is_damped;
            // shape functions of the scalar element and area element in each point of the face
            const auto add_bed = [&](const auto &bed_values, const unsigned int n_points,
                                     const Tensor<1, dim> &per_area, FullMatrix<double> &matrix)
            {
              for (unsigned int q = 0; q < n_points; ++q)
                for (unsigned int k = 0; k < n_dofs_per_cell; ++k)
                {
                  const auto [c, node] = element.system_to_component_index(k);
                  const double factor = per_area[c] * bed_values.shape_value(node, q) * bed_values.JxW(q);
                  if (factor != 0)
                    for (unsigned int l = 0; l < n_dofs_per_cell; ++l)
                      if (element.system_to_component_index(l).first == c)
                        matrix(k, l) +=
                            factor * bed_values.shape_value(element.system_to_component_index(l).second, q);
                }
            };
            const auto add_springs = [&](const auto &bed_values, const unsigned int n_points)
            {
              add_bed(bed_values, n_points, bed.stiffness_per_area, spring);
              if (is_damped)
                add_bed(bed_values, n_points, bed.damping_per_area, dashpots);
            };
            if (bed.segments.empty())
            {
              face_values.reinit(cell, f);
              add_springs(face_values, face_values.n_points());
            }
            else
              for (const auto &quadrature : bed_quadratures<dim>(cell->face(f), bed, n_gauss))
              {
                FEFaceValues<dim> bed_values(body.mapping, scalar, quadrature,
                                             update_values | update_JxW_values);
                bed_values.reinit(typename Triangulation<dim>::active_cell_iterator(cell), f);
                add_springs(bed_values, quadrature.size());
              }
            cell_matrices.stiffness.add(1., spring);
            if (system.has_loss)
              loss.add(bed.loss_factor, spring);
          }
      }

      body.constraints.distribute_local_to_global(cell_matrices.stiffness, dofs, system.stiffness);
      body.constraints.distribute_local_to_global(cell_matrices.mass, dofs, system.mass);
      if (system.has_loss)
        body.constraints.distribute_local_to_global(loss, dofs, system.loss_stiffness);
      if (on_dashpots)
        body.constraints.distribute_local_to_global(dashpots, dofs, system.damping);
      if (system.has_load)
        body.constraints.distribute_local_to_global(cell_load, dofs, system.load);
    }

    add_masses(attached, &AttachedPoint::mass, system.mass);
    if (system.has_load)
      add_loads(attached, system.load);
    system.stiffness.compress(VectorOperation::add);
    system.mass.compress(VectorOperation::add);
    if (system.has_damping)
      system.damping.compress(VectorOperation::add);
    if (system.has_loss)
      system.loss_stiffness.compress(VectorOperation::add);
    if (system.has_load)
      system.load.compress(VectorOperation::add);

    for (const types::global_dof_index dof : body.locally_owned)
      if (body.constraints.is_constrained(dof))
      {
        system.mass.set(dof, dof, 0.);
        if (system.has_loss)
          system.loss_stiffness.set(dof, dof, 0.);
        if (system.has_damping)
          system.damping.set(dof, dof, 0.);
      }
    system.mass.compress(VectorOperation::insert);
    if (system.has_loss)
      system.loss_stiffness.compress(VectorOperation::insert);
    if (system.has_damping)
      system.damping.compress(VectorOperation::insert);

    system.total_mass = Utilities::MPI::sum(total_mass, communicator);
    for (const PointMass &mass : model.masses)
      system.total_mass += mass.mass;
    return result;
  }

  template std::unique_ptr<SecondOrderSystem> assemble_elasticity(const ElasticBody<2> &);
  template std::unique_ptr<SecondOrderSystem> assemble_elasticity(const ElasticBody<3> &);
} // namespace vibrocontact

#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/material_flow.h>
#include <vibrocontact/fe/ring_elements.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    BodyMesh<2> annulus(const RingParameters &ring, const std::string &name, const MPI_Comm communicator)
    {
      BodyMesh<2> mesh;
      mesh.name = name;
      mesh.triangulation = std::make_unique<parallel::distributed::Triangulation<2>>(
          communicator, Triangulation<2>::limit_level_difference_at_vertices);
      mesh.geometry_degree = std::max(ring.degree, 2u);
      GridGenerator::hyper_shell(*mesh.triangulation, Point<2>(0, ring.radius),
                                 ring.radius - ring.thickness / 2, ring.radius + ring.thickness / 2,
                                 ring.divisions);
      return mesh;
    }

    class SolidRing
    {
    public:
      using Cell = DoFHandler<2>::active_cell_iterator;

      SolidRing(const RingParameters &ring, const ElasticBody<2> &body)
          : ring(ring), body(body), centre(0, ring.radius), gauss(ring.degree + 1)
      {
      }

      /// Hoop stress; springs and pressure on the mean circle.
      void add_inflation_and_springs(PETScWrappers::MPI::SparseMatrix &stiffness) const
      {
        const unsigned int n = body.element.n_dofs_per_cell();
        FullMatrix<double> matrix(n, n);
        std::vector<types::global_dof_index> dofs(n);
        const QGauss<2> volume(ring.degree + 1);
        for (const Cell &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
          {
            matrix = 0;
            const double hoop = ring.pressure * ring.radius / ring.thickness * ring.width;
            integrate(cell, volume, matrix,
                      [&](const FEValues<2> &values, const unsigned int q) {
                        return Terms{hoop * values.JxW(q), 0, 0, 0};
                      });
            const unsigned int along = direction(cell);
            std::vector<Point<2>> line;
            for (const Point<1> &p : gauss.get_points())
              line.push_back(along == 0 ? Point<2>(p[0], 0.5) : Point<2>(0.5, p[0]));
            const double pressure = ring.pressure_follows() ? ring.pressure * ring.width : 0;
            integrate(cell, Quadrature<2>(line, gauss.get_weights()), matrix,
                      [&](const FEValues<2> &values, const unsigned int q)
                      {
                        Tensor<1, 2> tangent;
                        for (unsigned int d = 0; d < 2; ++d)
                          tangent[d] = values.jacobian(q)[d][along];
                        const double length = gauss.weight(q) * tangent.norm();
                        return Terms{0, length * ring.radial_stiffness,
                                     length * ring.circumferential_stiffness, length * pressure};
                      });
            cell->get_dof_indices(dofs);
            body.constraints.distribute_local_to_global(matrix, dofs, stiffness);
          }
        stiffness.compress(VectorOperation::add);
      }

      ContactTrace trace(const ContactGrid &grid) const
      {
        ContactTrace result;
        result.grid = grid;
        result.faces_up = false;
        result.rows.resize(3 * ring.n_points);
        const std::vector<double> angles = ring.angles();
        const Sections sections = sections_at(angles);
        for (unsigned int i = 0; i < angles.size(); ++i)
        {
          result.rows[contact_row(ring.n_points, 0, i)] = sections.inward[i];
          result.rows[contact_row(ring.n_points, 1, i)] = sections.along[i];
          result.surface_height.push_back(ring.radius * (1 - std::cos(angles[i])));
        }
        return result;
      }

      /// @param pattern of the stiffness @param with_contact whether there are points
      std::shared_ptr<const MaterialFlow> flow(const PETScWrappers::MPI::SparseMatrix &pattern,
                                               const bool with_contact) const
      {
        auto result = std::make_shared<MaterialFlow>();
        result->fixed.reinit(pattern);
        result->turning.reinit(pattern);
        const unsigned int n = body.element.n_dofs_per_cell();
        FullMatrix<double> fixed(n, n), turning(n, n);
        std::vector<types::global_dof_index> dofs(n);
        FEValues<2> values(body.mapping, body.element, QGauss<2>(ring.degree + 1),
                           update_values | update_gradients | update_JxW_values | update_quadrature_points);
        for (const Cell &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
          {
            values.reinit(cell);
            fixed = 0;
            turning = 0;
            add_flow(values, fixed, turning);
            cell->get_dof_indices(dofs);
            body.constraints.distribute_local_to_global(fixed, dofs, result->fixed);
            body.constraints.distribute_local_to_global(turning, dofs, result->turning);
          }
        result->fixed.compress(VectorOperation::add);
        result->turning.compress(VectorOperation::add);
        if (with_contact)
        {
          result->stretch = sections_at(ring.angles()).stretch;
          result->beyond = sections_at(ring.angles_beyond()).along;
        }
        return result;
      }

    private:
      const RingParameters &ring;
      const ElasticBody<2> &body;
      const Point<2> centre;
      const QGauss<1> gauss;

      /// Factors of |du/ds|^2, u_n^2, u_t^2 and -(u_x du_z/ds - u_z du_x/ds), s along the circle through a place,
      /// in twice an energy.
      struct Terms
      {
        double stretch, radial, forward, area;
      };

      template <typename TermsAt>
      void integrate(const Cell &cell, const Quadrature<2> &quadrature, FullMatrix<double> &matrix,
                     const TermsAt &terms_at) const
      {
        FEValues<2> values(body.mapping, body.element, quadrature,
                           update_values | update_gradients | update_jacobians | update_JxW_values |
                               update_quadrature_points);
        values.reinit(cell);
        const unsigned int n = matrix.m();
        std::vector<double> slope(n);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const Terms terms = terms_at(values, q);
          const Tensor<1, 2> radial = outward(values.quadrature_point(q)), forward({-radial[1], radial[0]});
          for (unsigned int k = 0; k < n; ++k)
            slope[k] = values.shape_grad(k, q) * forward;
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
            {
              const unsigned int i = body.element.system_to_component_index(a).first,
                                 l = body.element.system_to_component_index(b).first;
              const double Na = values.shape_value(a, q), Nb = values.shape_value(b, q);
              matrix(a, b) +=
                  Na * Nb * (terms.radial * radial[i] * radial[l] + terms.forward * forward[i] * forward[l]) +
                  (i == l ? terms.stretch * slope[a] * slope[b]
                          : terms.area / 2 * (i == 0 ? -1 : 1) * (Na * slope[b] - slope[a] * Nb));
            }
        }
      }

      /// d/dtheta along x and z; theta turns from e_z's opposite, at the bottom, to e_x. What e_theta and e_r turn by is a
      /// quarter of a turn of the whole vector: e_theta' = -e_r, e_r' = e_theta.
      void add_flow(const FEValues<2> &values, FullMatrix<double> &fixed, FullMatrix<double> &turning) const
      {
        const unsigned int n = fixed.m();
        std::vector<double> slope(n);
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          const Point<2> &at = values.quadrature_point(q);
          const Tensor<1, 2> radial = outward(at), forward({-radial[1], radial[0]});
          const double mass = ring.density * ring.width * values.JxW(q), r = (at - centre).norm();
          for (unsigned int k = 0; k < n; ++k)
            slope[k] = r * (values.shape_grad(k, q) * forward);
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
            {
              const unsigned int i = body.element.system_to_component_index(a).first,
                                 l = body.element.system_to_component_index(b).first;
              const double Na = values.shape_value(a, q), Nb = values.shape_value(b, q),
                           moved = i == l ? (Na * slope[b] - slope[a] * Nb) / 2 : 0.,
                           turned = i == l ? 0. : (i == 0 ? -1 : 1) * Na * Nb;
              fixed(a, b) += mass * moved;
              turning(a, b) += mass * (moved - turned);
            }
        }
      }

      Tensor<1, 2> outward(const Point<2> &p) const { return (p - centre) / (p - centre).norm(); }

      /// The unit direction of a cell that goes around the ring.
      unsigned int direction(const Cell &cell) const
      {
        const double inner = cell->vertex(0).distance(centre), next = cell->vertex(1).distance(centre);
        return std::abs(inner - next) < ring.thickness / 2 ? 0 : 1;
      }

      /// Unit coordinate around the ring of an angle in a cell, if it lies in it.
      std::optional<double> place(const Cell &cell, const double theta) const
      {
        const Point<2> at = centre + ring.radius * Tensor<1, 2>({std::sin(theta), -std::cos(theta)});
        if (cell->center().distance(at) > 4 * numbers::PI * ring.radius / ring.divisions)
          return {};
        const double xi = body.mapping.transform_real_to_unit_cell(cell, at)[direction(cell)];
        return xi > -1e-10 && xi < 1 + 1e-10 ? std::make_optional(std::min(std::max(xi, 0.), 1.))
                                             : std::nullopt;
      }

      /// Of sections, means over the thickness: motion inward, along theta, and (v' + w) / R.
      struct Sections
      {
        std::vector<TraceRow> inward, along, stretch;
      };

      /// A section between cells has the rows of the first one, on the lowest rank. Collective.
      Sections sections_at(const std::vector<double> &angles) const
      {
        Sections result;
        for (std::vector<TraceRow> *const rows : {&result.inward, &result.along, &result.stretch})
          rows->resize(angles.size());
        for (const Cell &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            for (unsigned int i = 0; i < angles.size(); ++i)
              if (const auto xi = place(cell, angles[i]))
                add_rows(result, i, cell, *xi);
        for (std::vector<TraceRow> *const rows : {&result.inward, &result.along, &result.stretch})
        {
          const auto all = Utilities::MPI::all_gather(body.communicator(), *rows);
          for (unsigned int i = 0; i < angles.size(); ++i)
            for (auto of_rank = all.rbegin(); of_rank != all.rend(); ++of_rank)
              if (!(*of_rank)[i].empty())
                (*rows)[i] = (*of_rank)[i];
        }
        return result;
      }

      /// Mean motion of the section at xi, unless a cell before this one had it.
      void add_rows(Sections &sections, const unsigned int point, const Cell &cell, const double xi) const
      {
        if (!sections.inward[point].empty())
          return;
        std::vector<Point<2>> points;
        for (const Point<1> &p : gauss.get_points())
          points.push_back(direction(cell) == 0 ? Point<2>(xi, p[0]) : Point<2>(p[0], xi));
        FEValues<2> values(body.mapping, body.element, Quadrature<2>(points),
                           update_values | update_gradients | update_quadrature_points);
        values.reinit(cell);
        std::vector<types::global_dof_index> dofs(body.element.n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        std::map<types::global_dof_index, std::array<double, 3>> sums;
        for (unsigned int q = 0; q < points.size(); ++q)
        {
          const Point<2> &at = values.quadrature_point(q);
          const Tensor<1, 2> radial = outward(at), forward({-radial[1], radial[0]});
          const double r = (at - centre).norm();
          for (unsigned int k = 0; k < dofs.size(); ++k)
          {
            const unsigned int c = body.element.system_to_component_index(k).first;
            const double N = gauss.weight(q) * values.shape_value(k, q),
                         slope = gauss.weight(q) * r * (values.shape_grad(k, q) * forward);
            sums[dofs[k]][0] -= N * radial[c];
            sums[dofs[k]][1] += N * forward[c];
            sums[dofs[k]][2] += slope * forward[c] / ring.radius;
          }
        }
        for (const auto &[dof, weights] : sums)
        {
          sections.inward[point].emplace_back(dof, weights[0]);
          sections.along[point].emplace_back(dof, weights[1]);
          sections.stretch[point].emplace_back(dof, weights[2]);
        }
      }
    };
  } // namespace

  std::unique_ptr<SecondOrderSystem> assemble_solid_ring(const RingParameters &ring, const std::string &name,
                                                         const ContactGrid *const grid,
                                                         const MPI_Comm communicator)
  {
    ElasticModel<2> model;
    model.material.young_modulus = ring.young_modulus;
    model.material.poisson_ratio = 0;
    model.material.density = ring.density;
    const ElasticBody<2> body(annulus(ring, name, communicator), model, ring.degree);
    auto system = assemble_body(body);
    system->mass *= ring.width;
    system->stiffness *= ring.width;
    system->total_mass *= ring.width;
    const SolidRing solid(ring, body);
    solid.add_inflation_and_springs(system->stiffness);
    if (ring.damping_ratio > 0)
    {
      system->loss_stiffness.reinit(system->stiffness);
      system->loss_stiffness.copy_from(system->stiffness);
      system->loss_stiffness *= 2 * ring.damping_ratio;
      system->has_loss = true;
    }
    // the foundation holds it
    system->rigid_motions.clear();
    system->n_rigid_modes = 0;
    if (grid)
      system->trace = solid.trace(*grid);
    if (ring.rolling)
      system->flow = solid.flow(system->stiffness, grid != nullptr);
    return system;
  }
} // namespace vibrocontact

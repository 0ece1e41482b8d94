#include <vibrocontact/base/checksum.h>
#include <vibrocontact/waveguide/section_elements.h>

#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Displacement gradient d u_i / d x_j of one dof: the part with its value and the part with its derivative along x.
    struct AxialGradient
    {
      Tensor<2, 3> still, along;
    };

    AxialGradient axial_gradient(const unsigned int direction, const double value, const Tensor<1, 2> &slope)
    {
      AxialGradient result;
      result.still[direction][1] = slope[0];
      result.still[direction][2] = slope[1];
      result.along[direction][0] = value;
      return result;
    }

    double elastic_product(const ElasticMaterial &material, const Tensor<2, 3> &G, const Tensor<2, 3> &H)
    {
      return material.lambda() * trace(G) * trace(H) +
             material.mu() * (scalar_product(G, H) + scalar_product(G, transpose(H)));
    }
  } // namespace

  SectionElements::SectionElements(const Triangulation<2> &triangulation,
                                   const std::vector<ElasticMaterial> &materials, const unsigned int degree)
      : element(FE_Q<2>(degree), 3), mapping(std::max(2u, degree)), dof_handler(triangulation)
  {
    dof_handler.distribute_dofs(element);
    DoFRenumbering::Cuthill_McKee(dof_handler);
    DynamicSparsityPattern dynamic(n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, dynamic);
    pattern.copy_from(dynamic);
    for (unsigned int j = 0; j < 3; ++j)
    {
      stiffness[j].reinit(pattern);
      loss_stiffness[j].reinit(pattern);
    }
    mass.reinit(pattern);
    assemble(materials);

    std::vector<Point<2>> positions(n_dofs());
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, positions);
    dof_position = positions;
    dof_direction.resize(n_dofs());
    for (unsigned int direction = 0; direction < 3; ++direction)
      for (const auto dof :
           DoFTools::extract_dofs(dof_handler, element.component_mask(FEValuesExtractors::Scalar(direction))))
        dof_direction[dof] = direction;
  }

  void SectionElements::assemble(const std::vector<ElasticMaterial> &materials)
  {
    const QGauss<2> quadrature(element.degree + 2);
    FEValues<2> values(mapping, element, quadrature, update_values | update_gradients | update_JxW_values);
    const unsigned int n = element.n_dofs_per_cell();
    std::vector<types::global_dof_index> dofs(n);
    std::array<FullMatrix<double>, 3> K;
    FullMatrix<double> M(n, n);
    for (auto &matrix : K)
      matrix.reinit(n, n);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      const ElasticMaterial &material = materials.at(cell->material_id());
      M = 0;
      for (auto &matrix : K)
        matrix = 0;
      std::vector<AxialGradient> gradients(n);
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const double weight = values.JxW(q);
        area += weight;
        for (unsigned int a = 0; a < n; ++a)
          gradients[a] = axial_gradient(element.system_to_component_index(a).first, values.shape_value(a, q),
                                        values.shape_grad(a, q));
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
          {
            K[0](a, b) += weight * elastic_product(material, gradients[a].still, gradients[b].still);
            K[1](a, b) += weight * elastic_product(material, gradients[a].still, gradients[b].along);
            K[2](a, b) += weight * elastic_product(material, gradients[a].along, gradients[b].along);
            if (element.system_to_component_index(a).first == element.system_to_component_index(b).first)
              M(a, b) += weight * material.density * values.shape_value(a, q) * values.shape_value(b, q);
          }
      }
      cell->get_dof_indices(dofs);
      for (unsigned int j = 0; j < 3; ++j)
      {
        stiffness[j].add(dofs, K[j]);
        K[j] *= material.loss_factor;
        loss_stiffness[j].add(dofs, K[j]);
      }
      mass.add(dofs, M);
    }
  }

  Vector<double> SectionElements::boundary_load(const types::boundary_id boundary, const double from,
                                                const double to, const unsigned int direction,
                                                const unsigned int power, const double centre) const
  {
    Vector<double> load(n_dofs());
    const QGauss<1> gauss(element.degree + 3);
    std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary() || cell->face(f)->boundary_id() != boundary)
          continue;
        const auto y_at = [&](const double s)
        {
          const Point<2> unit =
              QProjector<2>::project_to_face(cell->reference_cell(), Quadrature<1>(Point<1>(s)), f).point(0);
          return mapping.transform_unit_to_real_cell(cell, unit)[0];
        };
        // where the face enters and leaves the interval; y is monotone along it
        const double y0 = y_at(0), y1 = y_at(1);
        const auto parameter = [&](const double y)
        {
          if ((y - y0) * (y1 - y0) <= 0)
            return 0.;
          if ((y - y1) * (y0 - y1) <= 0)
            return 1.;
          double low = 0, high = 1;
          for (unsigned int step = 0; step < 60; ++step)
          {
            const double middle = (low + high) / 2;
            ((y_at(middle) - y) * (y1 - y0) < 0 ? low : high) = middle;
          }
          return (low + high) / 2;
        };
        const double s0 = parameter(from), s1 = parameter(to), length = std::abs(s1 - s0);
        if (length < 1e-12)
          continue;
        std::vector<Point<1>> points = gauss.get_points();
        std::vector<double> weights = gauss.get_weights();
        for (unsigned int q = 0; q < points.size(); ++q)
        {
          points[q][0] = std::min(s0, s1) + length * points[q][0];
          weights[q] *= length;
        }
        FEFaceValues<2> values(mapping, element, Quadrature<1>(points, weights),
                               update_values | update_normal_vectors | update_quadrature_points |
                                   update_JxW_values);
        values.reinit(cell, f);
        cell->get_dof_indices(dofs);
        for (const unsigned int q : values.quadrature_point_indices())
        {
          const double weight = values.JxW(q) * std::abs(values.normal_vector(q)[1]) *
                                std::pow(values.quadrature_point(q)[0] - centre, power);
          for (unsigned int a = 0; a < dofs.size(); ++a)
            if (element.system_to_component_index(a).first == direction)
              load(dofs[a]) += weight * values.shape_value(a, q);
        }
      }
    return load;
  }

  void SectionElements::boundary_springs(const types::boundary_id boundary, const unsigned int direction,
                                         SparseMatrix<double> &into) const
  {
    FEFaceValues<2> values(mapping, element, QGauss<1>(element.degree + 1),
                           update_values | update_normal_vectors | update_JxW_values);
    std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == boundary)
        {
          values.reinit(cell, f);
          cell->get_dof_indices(dofs);
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int a = 0; a < dofs.size(); ++a)
              for (unsigned int b = 0; b < dofs.size(); ++b)
                if (element.system_to_component_index(a).first == direction &&
                    element.system_to_component_index(b).first == direction)
                  into.add(dofs[a], dofs[b],
                           values.JxW(q) * std::abs(values.normal_vector(q)[1]) * values.shape_value(a, q) *
                               values.shape_value(b, q));
        }
  }

  void SectionElements::motion_stiffness(const double k, const double square, const bool real_form,
                                         SparseMatrix<double> &into) const
  {
    into.copy_from(stiffness[0]);
    into.add(square, stiffness[2]);
    const auto sign = [&](const unsigned int row) { return real_form && dof_direction[row] != 0 ? -1. : 1.; };
    if (k != 0)
      for (auto entry = stiffness[1].begin(); entry != stiffness[1].end(); ++entry)
        if (entry->value() != 0)
        {
          const auto r = entry->row(), c = entry->column();
          into.add(r, c, sign(r) * k * entry->value());
          into.add(c, r, -sign(c) * k * entry->value());
        }
  }

  std::array<double, 2> SectionElements::extent(const types::boundary_id boundary) const
  {
    std::array<double, 2> result = {{1e300, -1e300}};
    for (const auto &face : dof_handler.get_triangulation().active_face_iterators())
      if (face->at_boundary() && face->boundary_id() == boundary)
        for (const unsigned int v : {0, 1})
        {
          result[0] = std::min(result[0], face->vertex(v)[0]);
          result[1] = std::max(result[1], face->vertex(v)[0]);
        }
    return result;
  }

  std::string SectionElements::mark_of_dofs() const
  {
    Checksum sum;
    sum.add(dof_position);
    sum.add(dof_direction);
    return hexadecimal(sum.value());
  }
} // namespace vibrocontact

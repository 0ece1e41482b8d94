#pragma once

#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace vibrocontact
{
  /// Polynomial map of a cell's face, from face coordinates s to space: of the unit square (hexahedra: the cell's other
  /// axes, ascending), or of the unit triangle.
  template <int dim>
  class FaceMap
  {
  public:
    /// @param degree of the geometry; triangles: 1 or 2
    FaceMap(const unsigned int degree, const bool is_triangle = false)
        : is_triangle(is_triangle), n(degree + 1), nodes(dealii::QGaussLobatto<1>(degree + 1).get_points()),
          basis(dealii::Polynomials::generate_complete_Lagrange_basis(nodes)), value(n, 2), slope(n, 2)
    {
    }

    /// Unit points on face @p f of the cell at which reinit() wants the positions.
    dealii::Quadrature<dim> support(const dealii::ReferenceCell &cell, const unsigned int f) const
    {
      std::vector<dealii::Point<dim>> points;
      if constexpr (dim == 3)
        if (is_triangle)
        {
          for (const dealii::Point<2> &s : triangle_nodes())
            points.push_back(on_face<3>(cell, f, s));
          return dealii::Quadrature<dim>(points);
        }
      for (unsigned int k = 0; k < dealii::Utilities::pow(n, dim - 1); ++k)
      {
        dealii::Point<dim - 1> s;
        s[0] = nodes[k % n][0];
        if (dim == 3)
          s[dim - 2] = nodes[k / n][0];
        points.push_back(on_face<dim>(cell, f, s));
      }
      return dealii::Quadrature<dim>(points);
    }

    void reinit(const std::vector<dealii::Point<dim>> &positions) { x = positions; }

    /// Position and derivatives with respect to s.
    void evaluate(const dealii::Point<dim - 1> &s, dealii::Point<dim> &position,
                  dealii::Tensor<1, dim - 1, dealii::Tensor<1, dim>> &derivative)
    {
      if constexpr (dim == 3)
        if (is_triangle)
        {
          evaluate_triangle(s, position, derivative);
          return;
        }
      double v[2];
      for (unsigned int d = 0; d < dim - 1; ++d)
        for (unsigned int k = 0; k < n; ++k)
        {
          basis[k].value(s[d], 1, v);
          value(k, d) = v[0];
          slope(k, d) = v[1];
        }
      position = dealii::Point<dim>();
      derivative = dealii::Tensor<1, dim - 1, dealii::Tensor<1, dim>>();
      for (unsigned int k = 0; k < x.size(); ++k)
      {
        const unsigned int i = k % n, j = k / n;
        const double vj = dim == 3 ? value(j, 1) : 1.;
        position += value(i, 0) * vj * x[k];
        derivative[0] += slope(i, 0) * vj * x[k];
        if (dim == 3)
          derivative[dim - 2] += value(i, 0) * slope(j, 1) * x[k];
      }
    }

    /// Find s with the tangential coordinates of @p target. False if the point is not on the face, or if
    /// Newton's method does not find it.
    bool invert(const dealii::Point<dim - 1> &target, dealii::Point<dim - 1> &s, double &height)
    {
      dealii::Point<dim> position;
      dealii::Tensor<1, dim - 1, dealii::Tensor<1, dim>> derivative;
      for (unsigned int d = 0; d < dim - 1; ++d)
        s[d] = is_triangle ? 1. / 3 : 0.5;
      double last_step = 1;
      for (unsigned int iteration = 0; iteration < 25 && last_step >= 1e-13; ++iteration)
      {
        evaluate(s, position, derivative);
        dealii::Tensor<2, dim - 1> J;
        dealii::Tensor<1, dim - 1> r;
        double size = 0;
        for (unsigned int i = 0; i < dim - 1; ++i)
        {
          r[i] = target[i] - position[i];
          for (unsigned int d = 0; d < dim - 1; ++d)
          {
            J[i][d] = derivative[d][i];
            size = std::max(size, derivative[d].norm());
          }
        }
        if (std::abs(dealii::determinant(J)) < 1e-3 * dealii::Utilities::fixed_power<dim - 1>(size))
          return false;
        const dealii::Tensor<1, dim - 1> step = dealii::invert(J) * r;
        for (unsigned int d = 0; d < dim - 1; ++d)
          s[d] = std::min(2., std::max(-1., s[d] + step[d]));
        last_step = step.norm();
      }
      // steps end in round-off of the coordinates, some 1e-12 far from the origin
      if (!(last_step < 1e-9))
        return false;
      height = position[dim - 1];
      double sum = 0;
      for (unsigned int d = 0; d < dim - 1; ++d)
      {
        if (s[d] < -1e-9 || s[d] > 1 + 1e-9)
          return false;
        sum += s[d];
      }
      return !is_triangle || sum < 1 + 1e-9;
    }

    /// Lengths of the face along x (and y) through its centre; of a triangle the side of a square of twice its area [m].
    std::array<double, 2> extent()
    {
      dealii::Point<dim> position;
      dealii::Tensor<1, dim - 1, dealii::Tensor<1, dim>> derivative;
      dealii::Point<dim - 1> centre;
      for (unsigned int d = 0; d < dim - 1; ++d)
        centre[d] = is_triangle ? 1. / 3 : 0.5;
      evaluate(centre, position, derivative);
      dealii::Tensor<2, dim - 1> J;
      for (unsigned int i = 0; i < dim - 1; ++i)
        for (unsigned int d = 0; d < dim - 1; ++d)
          J[i][d] = derivative[d][i];
      std::array<double, 2> length = {{0, 0}};
      if (std::abs(dealii::determinant(J)) < 1e-30)
        return length;
      if (is_triangle)
      {
        length.fill(std::sqrt(std::abs(dealii::determinant(J))));
        return length;
      }
      const dealii::Tensor<2, dim - 1> inverse = dealii::invert(J);
      for (unsigned int i = 0; i < dim - 1; ++i)
      {
        double largest = 0;
        for (unsigned int d = 0; d < dim - 1; ++d)
          largest = std::max(largest, std::abs(inverse[d][i]));
        length[i] = 1 / largest;
      }
      return length;
    }

    std::vector<dealii::Point<dim>> x;

  private:
    std::vector<dealii::Point<2>> triangle_nodes() const
    {
      std::vector<dealii::Point<2>> result = {{0, 0}, {1, 0}, {0, 1}};
      if (n == 3)
        for (const auto &[a, b] : {std::make_pair(0, 1), {1, 2}, {2, 0}})
          result.push_back(dealii::Point<2>((result[a] + result[b]) / 2));
      return result;
    }

    void evaluate_triangle(const dealii::Point<2> &s, dealii::Point<3> &position,
                           dealii::Tensor<1, 2, dealii::Tensor<1, 3>> &derivative) const
    {
      const std::array<double, 3> L = {{1 - s[0] - s[1], s[0], s[1]}};
      constexpr double slopes[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
      position = dealii::Point<3>();
      derivative = dealii::Tensor<1, 2, dealii::Tensor<1, 3>>();
      for (unsigned int k = 0; k < x.size(); ++k)
      {
        // corners, then middles of the edges from k to k + 1
        const unsigned int a = k % 3, b = (k + 1) % 3;
        const double N = k >= 3 ? 4 * L[a] * L[b] : n == 3 ? L[a] * (2 * L[a] - 1) : L[a];
        position += N * x[k];
        for (unsigned int d = 0; d < 2; ++d)
          derivative[d] += (k >= 3   ? 4 * (slopes[a][d] * L[b] + L[a] * slopes[b][d])
                            : n == 3 ? slopes[a][d] * (4 * L[a] - 1)
                                     : slopes[a][d]) *
                           x[k];
      }
    }

    const bool is_triangle;
    const unsigned int n;
    const std::vector<dealii::Point<1>> nodes;
    const std::vector<dealii::Polynomials::Polynomial<double>> basis;
    dealii::FullMatrix<double> value, slope;
  };
} // namespace vibrocontact

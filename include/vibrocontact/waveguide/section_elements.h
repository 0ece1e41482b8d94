#pragma once

#include <vibrocontact/scene/material.h>

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Finite elements of the cross-section of a prismatic body in 2.5 dimensions: three displacements u(x, y, z) =
  /// N(y, z) q(x), polynomials of the section times functions q of the place x along the axis, which stay open.
  ///
  /// The displacement gradient is G = (G0 + G1 d/dx) q. With the energy of an elastic material
  /// c(G, H) = lambda tr G tr H + mu G : (H + H^T), virtual work over a length of the body is
  ///
  ///   int dq^T K0 q + dq^T K1 q' + dq'^T K1^T q + dq'^T K2 q' - w^2 dq^T M q dx,
  ///   K0 = int c(G0, G0),  K1 = int c(G0, G1),  K2 = int c(G1, G1),  M = int rho N^T N  over the section.
  ///
  /// A wave q e^{ikx} has the stiffness K(k) = K0 + i k (K1 - K1^T) + k^2 K2 (semi-analytical finite elements: Gavric
  /// 1995; Hayashi, Song, Rose 2003). K1 couples the axial displacement with the others only, K0 and K2 never do.
  ///
  ///     z |  u_z                 the section lies in the plane (y, z), as its outline; x along the axis
  ///       |____ u_y
  class SectionElements
  {
  public:
    /// @param triangulation has to outlive the elements
    /// @param materials by material id of the cells
    /// @param degree polynomial degree of the displacements
    SectionElements(const dealii::Triangulation<2> &triangulation,
                    const std::vector<ElasticMaterial> &materials, unsigned int degree);

    unsigned int n_dofs() const { return dof_handler.n_dofs(); }

    /// int N_direction y-weighted dy over the part of a boundary between two places: what a load of 1 N/m^2 along x and y,
    /// times (y - centre)^power, does per length along x. @param direction 0 x, 1 y, 2 z @param power 0 or more
    dealii::Vector<double> boundary_load(dealii::types::boundary_id boundary, double from, double to,
                                         unsigned int direction, unsigned int power = 0,
                                         double centre = 0) const;

    /// int N_direction N_direction^T dy over a boundary: what springs of 1 N/m^3 below it add to K0 [m].
    void boundary_springs(dealii::types::boundary_id boundary, unsigned int direction,
                          dealii::SparseMatrix<double> &into) const;

    /// Stiffness of motions that go along x as e^{kx} or e^{ikx}, K0 + square K2 +- k (K1 - K1^T), without springs.
    /// @param square k^2 of waves, -k^2 of motions that grow @param real_form for waves: unknowns are q, of axial dofs
    /// -i q, and forces f, of axial dofs i f, so that all is real and symmetric
    void motion_stiffness(double k, double square, bool real_form, dealii::SparseMatrix<double> &into) const;

    /// smallest and largest y of a boundary [m]
    std::array<double, 2> extent(dealii::types::boundary_id boundary) const;

    dealii::SparsityPattern pattern;
    /// K0 [N/m^2], K1 [N/m], K2 [N], and the same with every cell times its loss factor
    std::array<dealii::SparseMatrix<double>, 3> stiffness, loss_stiffness;
    /// M [kg/m]
    dealii::SparseMatrix<double> mass;
    /// place (y, z) [m] and direction (0 x, 1 y, 2 z) of each dof
    std::vector<dealii::Point<2>> dof_position;
    std::vector<unsigned char> dof_direction;
    /// Sixteen digits that change with them.
    std::string mark_of_dofs() const;
    /// of the section [m^2]
    double area = 0;

  private:
    void assemble(const std::vector<ElasticMaterial> &materials);

    const dealii::FESystem<2> element;
    const dealii::MappingQ<2> mapping;
    dealii::DoFHandler<2> dof_handler;
  };
} // namespace vibrocontact

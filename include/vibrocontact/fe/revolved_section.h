#pragma once

#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/scene/elastic_model.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A body of revolution by finite elements on its half section, axial position a and radius r. Motions in n waves around
  /// the axle do not couple with others; theta is counted from the contact point. There are two families,
  ///
  ///   even   u_a = W cos(n theta),  u_r = U cos(n theta),  u_t =  V sin(n theta)
  ///   odd    u_a = W sin(n theta),  u_r = U sin(n theta),  u_t = -V cos(n theta)
  ///
  /// with the same matrices of (W, U, V) over the section, whose strains are linear in n:
  ///
  ///   e_aa = W,a   e_rr = U,r   e_tt = (U + n V) / r
  ///   g_ar = W,r + U,a   g_rt = V,r - (V + n U) / r   g_at = V,a - n W / r
  ///
  /// They are integrated around the axle: energies are those of the body. With n = 0 the family even is W and U, odd is V;
  /// one problem has both.
  class RevolvedSection
  {
  public:
    enum Component
    {
      axial,
      radial,
      circumferential
    };

    /// @param triangulation of the half section, boundary ids and material ids set; r > 0, or 0 on the axle of a body without
    /// bore
    /// @param model materials, held boundaries, gravity (x, y, z; z up at the contact, which is below the axle); nothing else
    RevolvedSection(const std::string &name, std::shared_ptr<const dealii::Triangulation<2>> triangulation,
                    const ElasticModel<3> &model, unsigned int degree);

    /// The matrices of n waves, on this rank alone, without load and trace. Rigid motions are in it.
    std::unique_ptr<SecondOrderSystem> system(unsigned int n) const;
    /// The load of the body's weight in n waves of a family, as SecondOrderSystem::load; null: there is none.
    std::unique_ptr<dealii::PETScWrappers::MPI::Vector> weight(unsigned int n, bool odd) const;

    /// Mean of a component over the part of a boundary that lies between two axial positions.
    /// @throws InputError if the boundary does not reach over all of it
    TraceRow mean_over(dealii::types::boundary_id boundary, double low, double high,
                       Component component) const;
    /// A component at the points: those of the section's boundary, one after the other around it.
    struct Boundary
    {
      /// (a, r), closed polygons one after the other; ends of each edge
      std::vector<dealii::Point<2>> points;
      std::vector<std::array<unsigned int, 2>> edges;
      /// rows[3 point + component]
      std::vector<TraceRow> rows;
    };
    Boundary boundary(unsigned int n) const;

    /// Support point (a, r) and component of each dof.
    const std::vector<dealii::Point<2>> &positions() const { return places; }
    const std::vector<unsigned char> &components() const { return directions; }
    unsigned int n_dofs() const { return dof_handler.n_dofs(); }
    /// of the body [kg]
    double mass() const { return total_mass; }

  private:
    /// over the section, not yet around it
    struct Cell
    {
      std::vector<dealii::types::global_dof_index> dofs;
      double loss_factor;
      /// stiffness in powers of n, mass
      dealii::FullMatrix<double> K_0, K_1, K_2, M;
      /// int rho N r of each dof's shape
      dealii::Vector<double> weight;
    };
    void compute_cells();
    dealii::AffineConstraints<double> constraints(unsigned int n) const;
    void add_rigid_motions(unsigned int n, const dealii::AffineConstraints<double> &constraints,
                           SecondOrderSystem &system) const;

    const std::string name;
    const std::shared_ptr<const dealii::Triangulation<2>> triangulation;
    const ElasticModel<3> model;
    const dealii::FESystem<2> element;
    dealii::MappingQCache<2> mapping;
    dealii::DoFHandler<2> dof_handler;
    std::vector<Cell> cells;
    std::vector<dealii::Point<2>> places;
    std::vector<unsigned char> directions;
    double total_mass = 0;
  };
} // namespace vibrocontact

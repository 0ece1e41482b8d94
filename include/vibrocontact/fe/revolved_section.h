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
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// What a rotation Omega about the axle adds to the motions of n waves, seen in axes that stand still while the material
  /// passes with Omega towards growing theta. With D = d/dt + Omega d/dtheta of displacements as vectors,
  ///
  ///   M q_e'' + 2 Omega G q_o' + (K - Omega^2 C + Omega^2 K_g) q_e = f_e
  ///   M q_o'' - 2 Omega G q_e' + (K - Omega^2 C + Omega^2 K_g) q_o = f_o,      e, o: families even, odd
  ///
  ///   G = n M + S,   C = n^2 M + 2 n S + M_across,   S = int rho (U V' + V U'),   M_across = int rho (U U' + V V')
  ///
  /// In axes that turn with the material a frequency is that here plus n Omega: only 2 Omega S and Omega^2 M_across stay.
  /// n = 0: G couples U and V of one problem that has both families, row even, column odd.
  struct RevolvedRotation
  {
    /// [kg]
    dealii::PETScWrappers::MPI::SparseMatrix coriolis, centripetal;
    /// K_g, of the stress that the body carries its own rotation with [kg]
    dealii::PETScWrappers::MPI::SparseMatrix geometric;
  };

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
    /// @param displacement of the section's points from where the triangulation has them [m]; null: none
    RevolvedSection(const std::string &name, std::shared_ptr<const dealii::Triangulation<2>> triangulation,
                    const ElasticModel<3> &model, unsigned int degree,
                    const std::function<dealii::Point<2>(const dealii::Point<2> &)> &displacement = {});

    /// The matrices of n waves, on this rank alone, without load and trace. Rigid motions are in it.
    /// @param added_loss loss factor of each part beside that of its material; empty: none
    std::unique_ptr<SecondOrderSystem> system(unsigned int n,
                                              const std::vector<double> &added_loss = {}) const;
    /// The load of the body's weight in n waves of a family, as SecondOrderSystem::load; null: there is none.
    std::unique_ptr<dealii::PETScWrappers::MPI::Vector> weight(unsigned int n, bool odd) const;

    /// Centrifugal forces per Omega^2, a load of n = 0 [kg m].
    dealii::PETScWrappers::MPI::Vector centrifugal_load() const;
    /// @param stretched displacements under centrifugal_load() [m s^2]
    std::unique_ptr<RevolvedRotation> rotation(unsigned int n,
                                               const dealii::PETScWrappers::MPI::Vector &stretched) const;

    /// Mean of a component over the part of a boundary that lies between two axial positions.
    /// @param what reaches over it, for the message @throws InputError if the boundary does not reach over all of it
    TraceRow mean_over(dealii::types::boundary_id boundary, double low, double high, Component component,
                       const std::string &what = "The contact grid") const;
    /// The components at the node nearest to a place (a, r) of those that are free to move.
    /// @param what is there, for the log and the message @throws InputError if the place does not lie on the section
    std::array<TraceRow, 3> node(const dealii::Point<2> &place, const std::string &what) const;
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

    /// An element of the section.
    struct Part
    {
      dealii::Point<2> centre;
      dealii::types::material_id material;
    };
    std::vector<Part> parts() const;
    /// phi_k^T K_e phi_l of each part e, around the axle, at [part][n_shapes k + l] (revolved_parts.cc).
    std::vector<std::vector<double>>
    energies_of_parts(unsigned int n, const std::vector<dealii::PETScWrappers::MPI::Vector> &shapes) const;

    /// A motion of the body as a rigid one, its rotations about the middle of the held boundary along the axle: along it with
    /// u_a = 1 and about it with V = r (n = 0); across it with U = -V = 1, tilt with W = r, V = -U = a (n = 1)
    /// (revolved_inertia.cc).
    enum class RigidMotion
    {
      along_axle,
      about_axle,
      across_axle,
      tilt
    };
    /// Axial position of that middle [m].
    double hub_place() const;
    /// One value per dof, held ones included; momentum() and inertia() are those of such motions, of the whole body.
    dealii::Vector<double> rigid_motion(RigidMotion motion) const;
    /// M v, of dofs that are free to move.
    dealii::PETScWrappers::MPI::Vector momentum(unsigned int n, const dealii::Vector<double> &motion) const;
    /// v^T M w
    double inertia(unsigned int n, const dealii::Vector<double> &motion,
                   const dealii::Vector<double> &other) const;

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
      /// int rho r N r of each radial shape
      dealii::Vector<double> centrifugal;
      /// int rho N r of each dof's shape
      dealii::Vector<double> weight;
    };
    void compute_cells();
    dealii::Vector<double> times_mass(const Cell &cell, unsigned int n,
                                      const dealii::Vector<double> &motion) const;
    /// int sigma : (grad N . grad N) over a cell, not around the axle, of a stress without waves
    dealii::FullMatrix<double>
    geometric_stiffness(const typename dealii::DoFHandler<2>::active_cell_iterator &cell, unsigned int n,
                        const dealii::Vector<double> &stretched) const;
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

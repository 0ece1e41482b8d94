#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/contact/leading_edge.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  template <typename Archive>
  void serialize(Archive &archive, ContactSolution &solution, const unsigned int)
  {
    archive &solution.R &solution.y &solution.status &solution.approach &solution.response_known;
    archive &solution.converged &solution.residual &solution.iterations &solution.factorisations;
    archive &solution.linear_iterations &solution.fallbacks &solution.seconds;
  }

  /// What the forces of a contact add up to, in its own frame and on its first body; of a scene: along x, y, z on body 1.
  struct ContactResultants
  {
    /// friction coefficient, at high speed if it depends on the slip [-]
    double friction = 0;
    double normal_force = 0;
    double tangential_force[2] = {0, 0};
    /// sum x Ty - y Tx about the nominal contact point [Nm]
    double spin_moment = 0;
    /// |Ft| / (mu N); zero without friction
    double utilisation = 0;
    /// approach less the smallest undeformed gap [m]
    double approach = 0;
    double max_pressure = 0;
    /// stated error of the normal and the tangential force [N] and of the spin moment [Nm] by the grid; negative: not known
    double normal_force_error = -1, force_error = -1, moment_error = -1;
    /// why they are not known
    std::string error_not_known;
    unsigned int contact_points = 0, stick_points = 0, slip_points = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &friction &normal_force &tangential_force &spin_moment &utilisation &approach;
      archive &max_pressure &normal_force_error &force_error &moment_error &error_not_known;
      archive &contact_points &stick_points &slip_points;
    }
  };

  /// Resultants of one case.
  struct RollingResult : ContactResultants
  {
    RollingCase rolling_case;
    ContactSolution solution;
    /// sentence of a solver that gave up; the solution then is without forces and not converged
    std::string failure;
    /// of each contact
    std::vector<ContactResultants> contacts;
    /// friction coefficient of each point, that of its slip speed if friction falls; n
    std::vector<double> point_friction;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int version)
    {
      ContactResultants::serialize(archive, version);
      archive &rolling_case &solution &failure &contacts &point_friction;
    }
  };

  /// A grid of contact points and what rolls on it.
  struct RollingGrid
  {
    ContactInterface interface;
    /// the contact operator y = A R for a rolling speed [m/s]
    std::function<std::shared_ptr<const ContactOperator>(double speed)> operator_at;
    CreepScheme scheme;
    /// gamma of the LeadingEdge along x and y [-]; zero: differences as the scheme has them
    std::array<double, 2> edge = {{0, 0}};
  };

  /// The grid of the results, and one of twice its spacing if there is one, which gives the stated error.
  struct RollingGrids
  {
    RollingGrid own;
    std::optional<RollingGrid> coarse;
    /// what the difference of the resultants on both grids is multiplied by for the stated error [-]
    double error_factor = 1;
    /// Tangential force and spin moment are those of a vanishing spacing, 2 F(own) - F(coarse).
    bool extrapolates = false;
  };
} // namespace vibrocontact

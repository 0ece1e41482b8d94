#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/contact/interface.h>
#include <vibrocontact/coupled_bodies/hub.h>
#include <vibrocontact/scene/axle.h>

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Rolling`: load and kinematics of steady rolling, and what is swept.
  struct RollingParameters
  {
    /// exactly one of the two holds a number, the other is empty: resultant normal force [N], downward
    /// displacement of the hub (the approach of two half-spaces) [m]
    std::vector<double> normal_force, hub_displacement;
    Creepage creepage;
    /// what becomes of the hub of body 1 in a motion about the equilibrium, in which the load finds its place:
    /// "held" there, "massless" under the constant normal force of the equilibrium, "suspended", or on an "axle"; "none" of a
    /// half-space: held under a displacement, massless under a force
    std::string hub = "held";
    SuspensionParameters suspension;
    AxleParameters axle;

    /// Values of the sweep; an empty list leaves the entry at its single value. Each of the first five lists
    /// is a curve of its own, the other entries staying at their single values; frictions repeat every curve.
    struct Sweep
    {
      std::vector<double> longitudinal, lateral, spin, normal_force, hub_displacement, friction;

      /// names of the entries that list values
      std::vector<std::string> given() const;
    } sweep;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError for combinations that make no sense
    /// @param frictionless pressing alone makes sense: nothing has to move
    void check(bool frictionless) const;
  };

  /// What to solve for one case.
  struct RollingCase
  {
    /// the swept entry, e.g. "Lateral creepage"; "single" without a sweep
    std::string curve;
    Creepage creepage;
    double friction = 0;
    /// one of the two is zero [N], [m]
    double normal_force = 0, hub_displacement = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &curve &creepage &friction &normal_force &hub_displacement;
    }
  };

  /// Cases of a run in the order in which they are solved: curve by curve, each friction from its first to
  /// its last value.
  std::vector<RollingCase> rolling_cases(const RollingParameters &rolling, const ContactSections &contact);

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
    unsigned int contact_points = 0, stick_points = 0, slip_points = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &friction &normal_force &tangential_force &spin_moment &utilisation &approach;
      archive &max_pressure &contact_points &stick_points &slip_points;
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

  /// Quasi-static rolling (Lai et al. 2018, section 4.1, Eq. 15): normal and tangential contact fully
  /// coupled, the solution of one case being the start of the next of its curve; every fourth case starts
  /// cold, so that the cases can be shared out over ranks. A case whose solver throws ConvergenceError counts
  /// as not converged, and the others go on.
  ///
  /// @param operator_at makes the contact operator for a rolling speed; called once, all cases share it
  /// @param finished called after each case, in order, whether it converged or not; on all ranks
  /// @param communicator the ranks that the cases are shared out over, see share_cases()
  /// @throws InputError if the contact reaches the edge of the grid
  std::vector<RollingResult>
  quasi_static_rolling(const RollingParameters &rolling, const ContactSections &contact,
                       const ContactSolverParameters &solver, const ContactInterface &interface,
                       const std::function<std::shared_ptr<const ContactOperator>(double speed)> &operator_at,
                       const std::function<void(const RollingResult &, const ContactProblem &)> &finished,
                       MPI_Comm communicator = MPI_COMM_SELF);
} // namespace vibrocontact

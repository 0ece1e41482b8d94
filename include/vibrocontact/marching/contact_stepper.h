#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/marching/dynamic_state.h>
#include <vibrocontact/marching/proximity.h>
#include <vibrocontact/marching/step_operator.h>
#include <vibrocontact/propagators/modal_step.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// Longest step for which reactions that are linear in the step do not ring, h = 2.7 sqrt(W~ / (Psi Psi^T)),
  /// the least over the normal rows of the contact points (doc/theory.md, "Time steps") [s]; infinite without
  /// modes, 0 for a rigid point. A rest that relaxes counts with h W / (h + 2 beta).
  double critical_time_step(const ContactPair &pair);

  /// What moves the bodies during a step, at its end.
  struct Drive
  {
    Creepage creepage;
    /// given normal force [N], or 0 if the approach is given [m]
    double normal_force = 0, approach = 0;
    /// of a given approach [m/s^2]; acts on the modes of body 1, which are those of the held structure: its hub
    /// moves by -approach along z, the modes are relative to that, p += Gamma_z d2(approach)/dt2. Of a suspended
    /// hub: the load beyond that of the equilibrium over the unsprung mass, > 0 downwards
    double hub_acceleration = 0;
    /// given force on body 1 at its only contact point along z [N]
    double force = 0;
    /// added to the undeformed gap [m]; n, empty: none (roughness)
    std::vector<double> gap;
  };

  /// One time step after another on the reduced pair (doc/theory.md, "One contact problem for
  /// every analysis" and "Time steps").
  ///
  /// The modes advance by their ModalStep and the poles by their StepWeights, the contact points have no mass: the reactions at the end of the
  /// step solve the contact problem
  ///
  ///   gap  = g + (Psi q1 + W~ R1)_n - approach
  ///   slip = V (creepage) + V d/dx (Psi q1 + W~ R1)_t + (Psi v1)_t + (W~ (R1 - R0))_t / h
  ///
  /// in which q1 and v1 are linear in R1, so that its operator
  ///
  ///   A_n = W~_n + (Psi G Psi^T)_n,   A_t = (V d/dx + 1/h) W~_t + V d/dx (Psi G Psi^T)_t + (Psi H Psi^T)_t
  ///
  /// (G, H: gains of displacement and velocity, ModalStep::g1) is constant as long as step and speed are. The
  /// rate r of W~ R is differenced backwards, as above: a trapezoidal rate rings. With a residual theta below 1 it is
  ///
  ///   r1 = W~ (R1 - R0) / (theta h) - (1 - theta) / theta r0
  ///
  /// whose error of first order is (theta - 1/2) h times its derivative; what rings is multiplied by (1 - theta) / theta in a step.
  /// Rests that relax take backward differences, beta (r1 - r0) / h + r1 = W R1, so that W~ above is rest_over_step() and b has
  /// what they keep, the sum of beta W s0 / (h + beta).
  ///
  /// What a step costs follows from what can matter in it: modes and contact meet in few shapes (PatchShapes),
  /// and only nearby points enter the contact problem (Proximity, StepOperator); a step that closes another is solved again with
  /// it.
  class ContactStepper
  {
  public:
    /// @param steps one per mode of the pair, for a step of h [s]; @param speed V [m/s], 0 without rolling
    /// @param pole_steps what the pair's poles do in it @param shapes shapes_of_steps(); null: they are found
    ContactStepper(const ContactPair &pair, const CreepScheme &scheme, const ContactSections &contact,
                   const std::vector<ModalStep> &steps, double h, double speed,
                   const StepWeights &pole_steps = {}, const PatchShapes *shapes = nullptr,
                   double residual_theta = 1);
    // members refer to each other
    ContactStepper(const ContactStepper &) = delete;
    ContactStepper &operator=(const ContactStepper &) = delete;

    /// state <- state at the end of the step. @return how the contact was solved; not converged: the best
    /// found
    const ContactSolution &advance(DynamicState &state, const Drive &drive, ContactSolver &solver);

    // what the derivative of a step needs
    const std::vector<ModalStep> &steps_of_modes() const { return steps; }
    const StepWeights &steps_of_poles() const { return pole_steps; }
    const StepMatrices &matrices_of_step() const { return matrices; }
    /// of the last step: points on the grid, their contact problem and its solution
    const std::vector<unsigned int> &nearby_points() const { return step_operator->points(); }
    const ContactProblem &last_problem() const { return problem; }
    const ContactSolution &last_solution() const { return solution; }
    /// rows of gap and slip per approach of all points, 3 n [-, 1/s]
    const DenseVector &approach_rows() const { return by_approach; }

  private:
    /// displacement <- of the shapes at the beginning of the step
    void set_displacement(const DynamicState &state);
    /// Adds to displacements at some rows what rests that relax keep of their forces before the step. @param force
    /// Drive::force at its end
    void add_kept(const DynamicState &state, double force, const std::vector<unsigned int> &rows,
                  double *to) const;
    /// displacement, velocity, c_n and c_t <- those at the end of the step
    void set_end_of_shapes();
    /// gaps <- those at the end of the step, whose shapes are set. Whether the solution closes points that are not nearby; then they
    /// are nearby as well.
    bool closes_another(DynamicState &state, double force);
    /// Operator and friction of the nearby points into the problem.
    void take_points(const std::vector<unsigned int> &points);
    /// q, v and z at the end of the step without the forces there.
    void advance_modes(const DynamicState &state, const Drive &drive);
    /// Amplitudes of the shapes that states of the poles add, and their rates unless null. @param feed forces on the states
    void add_poles(const std::vector<std::complex<double>> &states,
                   const std::vector<std::complex<double>> &feed, DenseVector &displacements,
                   DenseVector *velocities) const;
    /// The problem of the step, and where its solution starts: forces that go on changing as they did.
    void set_problem(const DynamicState &state, const Drive &drive, const DenseVector &rigid_slip);
    /// Solves it with mu at the slip of rolling and modes, without the rate of the residual displacements.
    void solve_with_modal_slip_in_friction(const DynamicState &state, ContactSolver &solver);
    /// state <- that at the end of the step, whose shapes and gaps are set.
    void take_over(DynamicState &state, const DenseVector &rigid_slip);

    /// w + (1 - theta) h r: residual displacement that the rate of a step is differenced from [m], r1 = (w1 - reference) / (theta h), and so the next
    /// one w1 / theta - (1 - theta) / theta times this; of a normal row, which has no rate, itself.
    double reference_of_rate(const DynamicState &state, const unsigned int row) const
    {
      return state.residual_displacement[row] + matrices.lead() * state.residual_rate[row];
    }

    const ContactPair &pair;
    const CreepScheme &scheme;
    /// beta / (h + beta) of each rest that relaxes
    std::vector<double> kept;
    const std::vector<ModalStep> steps;
    const StepWeights pole_steps;
    const double h, speed;
    const HubDamper damper;
    const StepMatrices matrices;
    const Proximity proximity;
    /// gap and slip without forces that never change: undeformed gap and loads; 3 n
    DenseVector constant_response;
    /// mu of all points, n, their laws, and ContactProblem::by_approach and to_force, 3 n
    std::vector<double> friction;
    PointLaws<NormalLaw> normal_laws;
    PointLaws<FrictionLaw> friction_laws;
    DenseVector by_approach, to_force;
    std::shared_ptr<const StepOperator> step_operator;
    /// of the nearby points
    ContactProblem problem;
    ContactSolution solution;
    /// modes without the forces at the end of the step; n_modes
    DenseVector q, v;
    /// poles without them; n_poles
    std::vector<std::complex<double>> z;
    /// their shapes; those that forces add while the problem is set, at the end of the step all; and basis^T R of normal and
    /// tangential forces (c_n: also of all); rank
    DenseVector free_displacement, free_velocity, displacement, velocity, c_n, c_t;
    /// of the points that are not nearby at the end of the step: gaps, on the whole grid (Proximity::set_gaps()), and (W~ R)_n
    DenseVector gaps, residual_of_others;
  };
} // namespace vibrocontact

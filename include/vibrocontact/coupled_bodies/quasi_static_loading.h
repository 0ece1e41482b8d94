#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/contact/interface.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/loading_parameters.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A grid of contact points and what presses on it without rolling.
  struct LoadingGrid
  {
    ContactInterface interface;
    /// jump of the contact displacements per contact force, body 1 being held by its hub; 3 n square [m/N]
    std::shared_ptr<const ContactOperator> compliance;
  };

  /// The grid of the results, and one of twice its spacing if there is one, by which errors are stated.
  struct LoadingGrids
  {
    LoadingGrid own;
    std::optional<LoadingGrid> coarse;
  };

  /// The grid of a pair of bodies: its static compliance and the gaps at rest, or the kernels of half-spaces alone.
  /// @throws InputError if a body can move freely
  LoadingGrid loading_grid(const ContactPair &pair);

  /// What a load comes to. Axes: x, y, and downwards, against the normal.
  struct LoadedState
  {
    /// that drives body 1 by its hub [N], in equilibrium with the contact forces on it; displacement of the hub [m]
    std::array<double, 3> force = {{0, 0, 0}}, displacement = {{0, 0, 0}};
    /// taken by friction in the last step; since the beginning: by friction, the work of the driving forces by the
    /// trapezoidal rule from where the first point touches; stored now in bodies and normal laws [J]
    double dissipated = 0, dissipated_sum = 0, work_sum = 0, stored = 0;
    /// contact problems that were solved, of all of them: Newton's or fixed point's iterations
    unsigned int solves = 0, iterations = 0;
    double seconds = 0;
    /// R: forces on body 1 [N]; y: gap and slip of the last step, body 1 minus body 2 [m]
    ContactSolution solution;
  };

  /// Two or more bodies in contact under loads that change without time: slip is the increment of the relative
  /// tangential displacement since the last load at each point.
  ///
  ///   y = A R + b + h u - (0, u_t before),    y = (gap, slip of the step)
  ///
  /// A: static compliance, h u: how the hub of body 1 moves all points, u_t: relative tangential displacements. This is a
  /// ContactProblem, solved by the solvers and laws of all analyses. A given normal force makes the approach an
  /// unknown of it. Where the force along x or y is given, the hub hangs on a spring along that axis (SprungOperator), the far
  /// end of which Broyden's method moves until it carries the force: a few solutions, each the start of the next. Their
  /// factors are kept from load to load.
  ///
  /// With constant normal forces and friction along one line what is found does not depend on the size of steps as long as
  /// loads do not turn within them; otherwise it is of first order in them (backward difference).
  class LoadedContact
  {
  public:
    /// @param grid has to outlive this
    LoadedContact(const LoadingGrid &grid, const ContactSections &sections,
                  const ContactSolverParameters &solver, const std::array<bool, 3> &force_given);
    /// Goes on to loads (forces or displacements along x, y, downwards).
    /// @return false if no equilibrium is found: failure() says why, and the state is the one before
    bool load(const std::array<double, 3> &loads);
    const LoadedState &state() const { return now; }
    /// u_t without what loads on the bodies do, (0, x, y); 3 n [m]
    const DenseVector &displacement() const { return moved; }
    const std::string &failure() const { return reason; }

  private:
    void solve(const std::array<double, 3> &place, ContactSolution &state, LoadedState &next);
    bool find(const std::array<double, 3> &loads, LoadedState &next);
    std::array<double, 3> force_of(const DenseVector &R) const;
    void account(LoadedState &next);

    const LoadingGrid &grid;
    const std::array<bool, 3> force_given;
    const double tolerance;
    /// h along x, y, z; 3 n rows
    std::array<DenseVector, 3> motion;
    PointLaws<NormalLaw> law;
    std::unique_ptr<ContactSolver> solver;
    /// with the gap alone in b
    ContactProblem problem;
    DenseVector start, moved;
    /// c and the far ends of the springs along x and y, and how these go with the forces that they carry [m/N]
    double compliance = 0;
    std::array<double, 2> far_end = {{0, 0}};
    std::array<std::array<double, 2>, 2> by_force = {};
    LoadedState now;
    std::string reason;
  };

  /// A history and its errors by the grid.
  struct LoadingResult
  {
    unsigned int steps_done = 0;
    LoadedState last;
    /// why it ended before its end; empty: it did not
    std::string failure;
    /// stated error along x, y, downwards of what answers to the load (displacement to a force, force to a displacement),
    /// the largest of all steps over the largest of that quantity (along x and y: of both), zero where all are zero; of
    /// what friction has taken, over its sum. Negative: not known
    std::array<double, 3> errors = {{-1, -1, -1}};
    double dissipated_error = -1;
    std::string error_not_known;
  };

  /// Goes through a history of loads on both grids. The stated error is the difference of both (doc/loading.md).
  /// @param finished called after each step with its number from 0 and what carries the state
  /// @throws InputError if the contact reaches the edge of the grid in the first step
  LoadingResult
  quasi_static_loading(const LoadHistory &history, const ContactSections &sections,
                       const ContactSolverParameters &solver, const LoadingGrids &grids,
                       const std::function<void(unsigned int, const LoadedContact &)> &finished);
} // namespace vibrocontact

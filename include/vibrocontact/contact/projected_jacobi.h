#pragma once

#include <vibrocontact/contact/contact_solver.h>

#include <array>

namespace vibrocontact
{
  /// The frictionless contact problem of rigid points where A differs little from a multiple of the identity, as that of many
  /// points with a tread of their own on a stiff ring:
  ///
  ///   R <- max(0, -(b + C R) / d),        A = d I + C,  d: the diagonal of A
  ///
  /// Each iteration brings R nearer to the one solution by a factor, ContactOperator::jacobi_factor(), since the projection
  /// never lengthens a distance (Cottle, Pang & Stone, The Linear Complementarity Problem, 1992, ch. 5). So the last change of
  /// R bounds what is left: it ends where that is below the tolerance times R. An iteration costs a product with A: no matrix
  /// is kept. It begins with C R, the displacements by the forces of other points, as those of the three solutions before
  /// lead to: forces of single points may jump from step to step, what many of them move together does not.
  class ProjectedJacobi : public ContactSolver
  {
  public:
    explicit ProjectedJacobi(const ContactSolverParameters &parameters = {}) : tolerance(parameters.tolerance)
    {
    }
    /// Rigid points without friction, the approach given, and I - A / d shrinks distances tenfold: then A is positive definite.
    static bool takes(const ContactProblem &problem);
    /// Open gaps are those of the iteration before: right to the tolerance times what the forces move.
    /// @throws ConvergenceError if b is not finite
    void solve(const ContactProblem &problem, ContactSolution &state) override;
    void renew() override { n_earlier = 0; }

  private:
    void begin_with_earlier_ones();

    const double tolerance;
    /// C R of this solution and of those before it, the newest first; how many of these are known
    std::array<std::vector<double>, 4> by_others;
    unsigned int n_earlier = 0;
    std::vector<unsigned int> all;
    DenseVector response;
  };
} // namespace vibrocontact

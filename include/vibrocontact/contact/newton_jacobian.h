#pragma once

#include <vibrocontact/contact/contact_problem.h>

#include <array>
#include <vector>

namespace vibrocontact
{
  /// The generalised Jacobian of R - projections at a state (R, y), on the points whose projected normal
  /// force is positive (the active ones); its rows are scaled like forces.
  ///
  ///   normal row      dN - dP,                        dP = P_N dN + P_g dgap
  ///   tangential rows dT - D (dT - rho_t ds) - mu r dP,   D, r: derivatives of the projection on the disc
  ///   last row        l . dR                          (only if the normal force is given)
  ///
  /// with (dgap, ds) = A dR - d_approach a (ContactProblem). Unknowns: changes of the forces of the m active points (normal of
  /// all, x, y, as many components as the problem has), then, if the normal force is given, the approach divided by approach_scale(), which makes it a
  /// force.
  class NewtonJacobian
  {
  public:
    /// Derivatives of the projections at a point; all zero: those of an open one, whose rows are its forces.
    struct Row
    {
      double by_force = 0, by_gap = 0;
      std::array<Vector2, 2> by_trial{};
      Vector2 by_radius{};
      /// rho_t of the point [N s/m]
      double rho = 0;
    };
    using Rows = std::vector<Row>;
    /// What the rows of a point multiply its own forces and its responses by, [row][component].
    struct Blocks
    {
      std::array<std::array<double, 3>, 3> by_force, by_response;
    };
    static Blocks blocks_of(const Row &row);

    /// Takes a state of a problem, which is referred to until the next one.
    /// @param residual whose rho the projections have
    void linearise(const ContactProblem &problem, const ContactResidual &residual, const DenseVector &R,
                   const DenseVector &y);

    /// active points, ascending
    const std::vector<unsigned int> &points() const { return active; }
    const Rows &rows_of_points() const { return rows; }
    unsigned int n_components() const { return components; }
    unsigned int size() const { return components * active.size() + (problem->force_given() ? 1 : 0); }
    /// [m/N]
    double approach_scale() const;

    /// The rows of active point k for changes of its own forces and responses.
    std::array<double, 3> apply(unsigned int k, double dN, double dTx, double dTy, double dgap, double dsx,
                                double dsy) const
    {
      return apply(rows[k], dN, dTx, dTy, dgap, dsx, dsy);
    }
    /// dst = J src without forming J; what GMRES calls.
    void vmult(DenseVector &dst, const DenseVector &src) const;
    /// @param response A among the active points (ContactOperator::extract)
    void assemble(const DenseMatrix &response, DenseMatrix &J) const;
    /// (dgap, ds) at active point k for a unit of the last unknown
    std::array<double, 3> response_to_approach(unsigned int k) const;
    /// Values at the active points into a full vector.
    void scatter(const DenseVector &values, DenseVector &full) const;

  private:
    static std::array<double, 3> apply(const Row &row, double dN, double dTx, double dTy, double dgap,
                                       double dsx, double dsy);

    const ContactProblem *problem = nullptr;
    unsigned int n = 0, components = 3;
    std::vector<unsigned int> active;
    Rows rows;
    mutable DenseVector dR, dy;
  };
} // namespace vibrocontact

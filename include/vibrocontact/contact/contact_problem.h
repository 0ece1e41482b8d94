#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/contact/contact_operator.h>
#include <vibrocontact/contact/laws/friction_law.h>
#include <vibrocontact/contact/laws/point_laws.h>
#include <vibrocontact/contact/laws/signorini.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The components of forces or responses at a point, zero where it has none.
  inline std::array<double, 3> at_point(const DenseVector &values, const unsigned int n_points,
                                        const unsigned int n_components, const unsigned int point)
  {
    return {{values[point], n_components > 1 ? values[n_points + point] : 0.,
             n_components > 2 ? values[2 * n_points + point] : 0.}};
  }

  /// The one discrete contact problem that every analysis ends in (doc/theory.md, "One contact problem for
  /// every analysis").
  ///
  ///   find R = (N, Tx, Ty) with   y = A R + b - approach a,   y = (gap, slip_x, slip_y)
  ///   N_i = P(N_i, gap_i)  (normal law)   and   T_i = Proj_disc(mu_i N_i)(T_i - rho s_i)  (Coulomb)
  ///
  /// at every point. The approach [m] is given, or it is one more unknown that makes l . R equal to a given normal
  /// force. Where one contact lies under the hub, a = l is one on every gap, so that l . R = sum N. Friction that depends on the slip speed makes mu_i part of the solution
  /// (friction_of_speed.h).
  ///
  /// A point has n_components() rows, those of A: 1 (frictionless, no tangential rows), 2 (friction along x) or 3. Sizes "rows"
  /// are n times that, by contact_row().
  struct ContactProblem
  {
    std::string title;
    std::shared_ptr<const ContactOperator> A;
    /// gap [m] and slip velocity [m/s] without contact forces, at approach zero; rows
    DenseVector b;
    /// friction coefficient of each point; n, of 1 component not looked at
    std::vector<double> mu;
    /// what mu follows; none: mu is given
    PointLaws<FrictionLaw> friction_law;
    PointLaws<NormalLaw> normal_law = signorini().make({});
    /// resultant N [N] > 0 to be reached, or 0 if the approach is given
    double normal_force = 0;
    /// given approach [m]; the starting value if the normal force is given
    double approach = 0;
    /// a: rows of y per approach [-, 1/s]; l: normal force per force [-]; rows each, empty: one on every gap
    DenseVector by_approach, to_force;

    unsigned int n_points() const { return A->n_points(); }
    unsigned int n_components() const { return A->n_components(); }
    unsigned int n_rows() const { return n_points() * n_components(); }
    bool force_given() const { return normal_force > 0; }
    /// a and l at a point; zero in rows that it has not.
    std::array<double, 3> approach_of(const unsigned int point) const { return rows_of(by_approach, point); }
    std::array<double, 3> share_of(const unsigned int point) const { return rows_of(to_force, point); }
    /// l . R [N]
    double resultant(const DenseVector &R) const;
    /// y -= change a
    void move(DenseVector &y, double change) const;

  private:
    std::array<double, 3> rows_of(const DenseVector &values, const unsigned int point) const
    {
      if (values.size() == 0)
        return {{1, 0, 0}};
      return at_point(values, n_points(), n_components(), point);
    }
  };

  /// @throws ConvergenceError if gaps, slips, friction coefficients or loads of the problem are not finite:
  /// they would pass for open points
  void check_finite(const ContactProblem &problem);

  enum class ContactStatus : unsigned char
  {
    open = 0,
    stick = 1,
    slip = 2
  };

  /// What solutions have cost, counted.
  struct SolverCost
  {
    unsigned int iterations = 0, factorisations = 0, linear_iterations = 0, fallbacks = 0;

    SolverCost &operator+=(const SolverCost &more)
    {
      iterations += more.iterations;
      factorisations += more.factorisations;
      linear_iterations += more.linear_iterations;
      fallbacks += more.fallbacks;
      return *this;
    }
  };

  /// A state of the contact and how it was reached.
  struct ContactSolution : SolverCost
  {
    /// (N, Tx, Ty) on body 1 [N], (gap [m], slip_x, slip_y [m/s]); rows of the problem each
    DenseVector R, y;
    std::vector<ContactStatus> status;
    /// [m]
    double approach = 0;
    /// of a start: y is that of R and approach for the problem to be solved, nobody has to compute it
    bool response_known = false;
    bool converged = false;
    /// relative size of R - projections, see ContactResidual
    double residual = 0;
    /// of those who ask for a solution, not for a step
    double seconds = 0;
    bool empty() const { return R.size() == 0; }
    SolverCost &cost() { return *this; }
    const SolverCost &cost() const { return *this; }
    /// whether all forces and the approach are finite numbers: what can be started from
    bool is_finite() const;
  };

  /// The residual by which all solvers are judged: R minus its projections, each point with rho of its own, 1 / A_nn and
  /// 2 / (A_xx + A_yy). One rho for all would not see the forces of points that are much stiffer than the mean.
  ///
  ///   F_n = N - P(N, gap; rho_n),   F_t = T - Proj_disc(mu P)(T - rho_t s)
  ///   residual^2 = |F_n|^2 / max(|m N|, |N| / 1000)^2 + |F_t|^2 / |m N|^2,   m = min(mu, 1)
  ///
  /// So the forces of friction are right to the tolerance for any mu: below 1e-3 the normal ones would otherwise have to be
  /// right beyond rounding, above 1 sticking ones would not be looked at. Without friction it is |F_n| / |N|.
  class ContactResidual
  {
  public:
    /// @param tangential_factor multiplies rho_t: solvers may look at the same problem with another rho
    explicit ContactResidual(const ContactProblem &problem, double tangential_factor = 1);

    /// Projections of a state: next = (P, Proj), their status (a point without tangential rows sticks), and the relative
    /// residual.
    double evaluate(const DenseVector &R, const DenseVector &y, DenseVector &projected,
                    std::vector<ContactStatus> &status) const;

    /// of a point [N/m], [N s/m]
    double rho_normal_of(const unsigned int point) const { return rho_of_points[point].normal; }
    double rho_tangential_of(const unsigned int point) const { return rho_of_points[point].tangential; }

    /// those of the mean diagonal, of points without compliance of their own
    const double rho_normal, rho_tangential;

  private:
    struct Rho
    {
      double normal, tangential;
    };

    const ContactProblem &problem;
    /// asked for in every iteration
    std::vector<Rho> rho_of_points;
  };

  /// Points with a force that is not zero.
  std::vector<unsigned int> loaded_points(const DenseVector &R, unsigned int n_points);
  /// y = A R + b - approach a
  void contact_response(const ContactProblem &problem, const DenseVector &R, double approach, DenseVector &y);
} // namespace vibrocontact

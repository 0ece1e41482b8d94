#pragma once

#include <vibrocontact/contact/contact_solver.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The frictionless contact problem of many steps with one matrix,
  ///
  ///   0 <= q  perp  gap = b + M q >= 0        (ContactProblem with 1 component, Signorini's law, the approach given)
  ///
  /// faster than the general solvers, which it agrees with to 1e-12. M need not be symmetric, but positive definite, so
  /// that there is one solution whatever b is.
  ///
  /// One point: q = max(0, -b / M). Up to four: the closed points of the step before are tried first, then all
  /// sets, each with its inverse at hand. More: the closed set of the step before is corrected wherever q < 0 or
  /// gap < 0, all such points at once, and if that does not lessen their number four times in a row, the last of them
  /// only (Murty's rule, which ends for such M; Judice & Pires, Computers Oper. Res. 21 (1994) 587). The inverse of
  /// M over the closed set is kept from step to step and bordered or shrunk point by point; what rounding leaves in
  /// the closed gaps is corrected with it once more.
  ///
  /// The method is direct: what it finds has converged. Its residual is that of ContactResidual before closed gaps are set to
  /// zero; open gaps above -1e-14 of the largest of b are none. Iterations are corrections of the closed set.
  class ActiveSetSolver : public ContactSolver
  {
  public:
    explicit ActiveSetSolver(const ContactSolverParameters & = {}) {}
    static bool takes(const ContactProblem &problem);

    /// The start is the closed set of the last solution, whatever the state.
    /// @throws ConvergenceError if b is not finite
    void solve(const ContactProblem &problem, ContactSolution &state) override;
    /// @throws InputError if M is not positive definite
    void prepare(const ContactProblem &problem) override;
    /// Makes the inverse over the closed points anew, so that it does not depend on how they came to be closed.
    void renew() override;
    /// The closed points; when read their inverse is made anew.
    void exchange(CheckpointFile &file) override;

  private:
    template <unsigned int N>
    void solve_few(const ContactProblem &problem, ContactSolution &state);
    void solve_many(const ContactProblem &problem, ContactSolution &state);
    template <unsigned int N>
    bool try_set(unsigned int set, const double *b, double scale, ContactSolution &state);
    void keep(const DenseMatrix &full);
    void rebuild();
    void add(unsigned int point);
    void remove(unsigned int place);
    void multiply_inverse(const double *b, double *x) const;
    void response(const double *b, double *gap, const double *x) const;

    /// whose M is kept
    std::shared_ptr<const ContactOperator> A;
    unsigned int n = 0;
    /// 1 / mean diagonal of M; of one point its inverse
    double rho = 0;
    /// few points: M by rows; inverses over every set, n square each with zeros outside; the set closed last
    std::vector<double> set_inverses;
    unsigned int last_set = 0;
    /// many points: M by columns of padded length, closed points and their inverse (by columns of that length)
    std::size_t stride = 0;
    std::vector<double> matrix, inverse, work_1, work_2, x, b, start, now;
    std::vector<unsigned int> closed, wrong;
    std::vector<char> is_closed;
    unsigned long since_rebuilt = 0;
  };

  /// @param where said in the message, such as "at the time step 1e-05 s"
  /// @throws InputError if M is not positive definite (its symmetric part: x^T M x > 0), so that forces would not be unique
  void check_unique_forces(const DenseMatrix &matrix, const std::string &where);
} // namespace vibrocontact

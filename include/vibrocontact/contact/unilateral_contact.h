#pragma once

#include <vibrocontact/base/checkpoint_file.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The frictionless contact problem of many steps with one matrix,
  ///
  ///   0 <= q  perp  gap = gap_0 + M q >= 0,       M = B + S        (doc/modal_convolution.md)
  ///
  /// faster than the common solvers (contact/contact_solver.h), which it agrees with to 1e-12: the special case mu = 0
  /// of ContactProblem with M as its normal block. M need not be symmetric, but positive definite, so that there is
  /// one solution whatever gap_0 is.
  ///
  /// One point: q = max(0, -gap_0 / M). Up to four: the closed points of the step before are tried first, then all
  /// sets, each with its inverse at hand. More: the closed set of the step before is corrected wherever q < 0 or
  /// gap < 0, all such points at once, and if that does not lessen their number three times in a row, the last of them
  /// only (Murty's rule, which ends for such M; Judice & Pires, Computers Oper. Res. 21 (1994) 587). The inverse of
  /// M over the closed set is kept from step to step and bordered or shrunk point by point; what rounding leaves in
  /// the closed gaps is corrected with it once more.
  class UnilateralContact
  {
  public:
    /// @param where said in the message, e.g. "at the time step 1e-05 s"
    /// @throws InputError if M is not positive definite (its symmetric part: x^T M x > 0)
    UnilateralContact(const DenseMatrix &matrix, const std::string &where);

    /// @param gap gap_0 [m] on entry, the gap with q on return; @param q [N]; n each
    /// @throws ConvergenceError if gap_0 is not finite
    void solve(double *gap, double *q);

    /// The closed points; when read their inverse is made anew.
    void exchange(CheckpointFile &file);
    /// Makes the inverse over the closed points anew, so that it does not depend on how they came to be closed: called at
    /// fixed steps, it makes a resumed run equal to an uninterrupted one bit for bit.
    void renew();

    unsigned int n_points() const { return n; }
    /// corrections of the closed set so far; up to four points: steps whose closed set was another than before
    unsigned long corrections() const { return n_corrections; }
    /// points closed by the last solve
    unsigned int n_closed() const;
    /// Largest violation of the last solution over the largest gap_0 [-]: closed gaps; up to four points also open gaps
    /// below zero and forces below zero times M_ii. One point is exact, 0.
    double residual() const { return last_residual; }

  private:
    template <unsigned int N>
    void solve_few(double *gap, double *q);
    void solve_many(double *gap, double *q);
    template <unsigned int N>
    bool try_set(unsigned int set, const double *gap_0, double *gap, double *q);
    void rebuild();
    void add(unsigned int point);
    void remove(unsigned int place);
    void multiply_inverse(const double *b, double *x) const;
    void response(const double *gap_0, double *gap, const double *x) const;

    unsigned int n;
    double inverse_1 = 0;
    /// few points: inverses over every set, n square each with zeros outside; the set closed last
    std::vector<double> set_inverses;
    unsigned int last_set = 0;
    /// many points: M by columns of padded length, closed points and their inverse (by columns of that length)
    std::size_t stride = 0;
    std::vector<double> matrix, inverse, work_1, work_2, x, b, start, now;
    std::vector<unsigned int> closed, wrong;
    std::vector<char> is_closed;
    unsigned long n_corrections = 0, since_rebuilt = 0;
    double last_residual = 0;
  };

  /// @param where said in the message
  /// @throws InputError if M is not positive definite, so that forces would not be unique
  void check_unique_forces(const DenseMatrix &matrix, const std::string &where);

  /// Smallest eigenvalue of the symmetric part of M over the largest modulus: <= 0 if x^T M x > 0 fails.
  double definiteness(const DenseMatrix &matrix);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/contact/newton_jacobian.h>
#include <vibrocontact/contact/secant_pairs.h>

namespace vibrocontact
{
  /// The factorised matrix of a Newton step, kept while it serves: from one step to the next, and from one
  /// problem of the same operator to the next (time steps).
  ///
  /// A point that changes between stick and slip changes its tangential rows of J, t = 1 or 2. As long as few have done so since the
  /// factorisation J = L U, the new matrix J + E D (E: unit columns of these rows, D: their differences) is
  /// solved by
  ///
  ///   (J + E D)^-1 r = x - Z (I + D Z)^-1 D x,   x = J^-1 r,   Z = J^-1 E    (Sherman, Morrison & Woodbury)
  ///
  /// at two solves per changed point, once. In time steps, whose problems follow each other with one operator, the rows of sliding
  /// points turn little by little besides: what steps have shown of that mends directions (SecantPairs) as long as no point
  /// changes its status, so that factors serve longer.
  class NewtonFactorisation
  {
  public:
    /// Another problem begins.
    void begin_problem();
    /// What a step may leave of the residual for the factors to serve on.
    double largest_gain() const;
    /// Makes the matrix that `solve` solves with suit J, at the least cost.
    /// @param status of all points of the problem; @param anew factorise in any case
    /// @param factorisations counts them; @return false if the matrix is singular
    bool prepare(const ContactProblem &problem, const NewtonJacobian &J,
                 const std::vector<ContactStatus> &status, bool anew, unsigned int &factorisations);
    /// x <- J^-1 x
    void solve(DenseVector &x);
    /// The last direction was taken in full, or there is another one that these factors did not give.
    void took_direction() { direction_taken = true; }
    void leave_direction() { last_direction.reinit(0); }
    void forget();

  private:
    bool factorise(const ContactProblem &problem, const NewtonJacobian &J,
                   const std::vector<ContactStatus> &now);
    bool update(const NewtonJacobian &J);
    void solve_by_factors(DenseVector &x);

    /// whether lu is kept, the operator of lu and response, and the kind of load of lu
    bool is_factorised = false;
    std::weak_ptr<const ContactOperator> A;
    bool force_given = false;
    /// active points, their status and rows when lu was made
    std::vector<unsigned int> points;
    std::vector<ContactStatus> status;
    NewtonJacobian::Rows rows;
    /// A among the points
    DenseMatrix response;
    DenseMatrix lu;
    /// points (among the active ones) with another status than when lu was made, and now
    std::vector<unsigned int> changed, flipped;
    /// Z, size x t changed; D, t changed x size; I + D Z, factorised
    DenseMatrix columns, differences, small;
    /// problems that have begun since lu was made, and solves of the last of them
    unsigned int n_problems = 0, n_solves = 0;
    SecantPairs pairs;
    /// of the last solve; none: of another problem or another matrix
    DenseVector last_residual, last_direction;
    bool direction_taken = false;
  };
} // namespace vibrocontact

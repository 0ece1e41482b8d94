#pragma once

#include <vibrocontact/contact/newton_jacobian.h>

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
  /// at two solves per changed point, once.
  class NewtonFactorisation
  {
  public:
    /// Makes the matrix that `solve` solves with suit J, at the least cost.
    /// @param status of all points of the problem; @param anew factorise in any case
    /// @param factorisations counts them; @return false if the matrix is singular
    bool prepare(const ContactProblem &problem, const NewtonJacobian &J,
                 const std::vector<ContactStatus> &status, bool anew, unsigned int &factorisations);
    /// x <- J^-1 x
    void solve(DenseVector &x);
    void forget() { A.reset(); }

  private:
    bool factorise(const ContactProblem &problem, const NewtonJacobian &J,
                   const std::vector<ContactStatus> &now);
    bool update(const NewtonJacobian &J);

    /// operator and kind of load that lu belongs to; null: nothing is kept
    std::shared_ptr<const ContactOperator> A;
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
  };
} // namespace vibrocontact

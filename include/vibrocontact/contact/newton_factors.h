#pragma once

#include <vibrocontact/contact/condensed_jacobian.h>
#include <vibrocontact/contact/secant_pairs.h>
#include <vibrocontact/numerics/single_factors.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace vibrocontact
{
  /// Places that some points have among others. @param some, all ascending, all of some among all
  std::vector<unsigned int> places_among(const std::vector<unsigned int> &some,
                                         const std::vector<unsigned int> &all);

  /// A Newton matrix as some points have it, its active ones or more.
  struct JacobianOnPoints
  {
    /// @param points ascending, the active ones among them @param status of all points of the problem
    /// @param approach_scale of the last unknown [m/N]
    void take(const NewtonJacobian &J, const std::vector<unsigned int> &points,
              const std::vector<ContactStatus> &status, double approach_scale);

    std::vector<unsigned int> points;
    /// of a point that is not active: zero, and open
    NewtonJacobian::Rows rows;
    std::vector<ContactStatus> status;
    unsigned int components = 3;
    bool force_given = false;
    double approach_scale = 1;
    unsigned int size() const { return components * points.size() + (force_given ? 1 : 0); }
  };

  /// A Newton matrix, factorised: J itself, or what is left of it where A was inverted (CondensedJacobian).
  ///
  /// A point that changes its status since then changes rows of J: the tangential ones between stick and slip, all if it closes or
  /// opens. As long as these are few, the new matrix J + E D (E: unit columns of these rows, D: their differences) is solved by
  ///
  ///   (J + E D)^-1 r = x - Z (I + D Z)^-1 D x,   x = J^-1 r,   Z = J^-1 E    (Sherman, Morrison & Woodbury)
  ///
  /// at a solution for each changed row, once. D has blocks F and G of a point alone, for x and for A x.
  class NewtonFactors
  {
  public:
    /// @param inverse of A at these points, or null: J is factorised itself
    NewtonFactors(const JacobianOnPoints &at, std::shared_ptr<const InverseResponse> inverse);

    const JacobianOnPoints &at() const { return made_for; }
    bool is_condensed() const { return condensed.has_value(); }
    /// unknowns that are factorised
    unsigned int n_factorised() const { return condensed ? condensed->size() : made_for.size(); }
    /// Factorises what is left of J, or if it is not condensed J, as assemble(J) makes it. @return false if it is singular
    bool factorise(const std::function<void(DenseMatrix &)> &assemble, bool in_single_precision);

    /// Places of the points whose status now is another one than when the factors were made.
    std::vector<unsigned int> changed_points(const JacobianOnPoints &now) const;
    /// Whether the factors were made, or last updated, for points with such a status.
    bool has(const JacobianOnPoints &now, const std::vector<unsigned int> &changed) const;
    /// changed points that the factors do not know yet
    unsigned int n_new(const std::vector<unsigned int> &changed) const;
    /// Takes the points that have changed into account. @param rows_of_A at the changed points, one point's after the other's, by
    /// unknowns of J; empty if J is condensed. @return false if the matrix is singular
    bool update(const JacobianOnPoints &now, const std::vector<unsigned int> &changed, DenseMatrix rows_of_A);
    /// x <- J^-1 x, rows of the points; with the normal force given the last one. @return false if the matrix is singular
    bool solve(DenseVector &x);

    /// of the state that they last served
    SecantPairs pairs;
    /// number of that problem
    unsigned long last_used = 0;

  private:
    /// A row that has changed, and its differences.
    struct ChangedRow
    {
      /// place of its point
      unsigned int point;
      unsigned int component;
      std::array<double, 3> by_force, by_response;
    };

    /// by the matrix that was factorised
    bool solve_as_made(DenseVector &x);
    bool solve_factorised(DenseVector &x);
    /// A x by rows of all points; if J is not condensed, of the changed ones alone.
    /// @param x if J is condensed, the last that solve_as_made() gave
    DenseVector response(const DenseVector &x) const;
    /// D x. @param response of x
    DenseVector differences_by(const DenseVector &x, const DenseVector &response) const;

    JacobianOnPoints made_for;
    std::optional<CondensedJacobian> condensed;
    /// the matrix itself until the first solution by single_lu was tried with it, then empty or factorised
    DenseMatrix lu;
    /// empty: lu serves
    SingleFactors single_lu;
    /// places of the changed points and their status
    std::vector<unsigned int> changed;
    std::vector<ContactStatus> changed_status;
    std::vector<ChangedRow> changed_rows;
    /// Z, and response() of its columns
    std::vector<DenseVector> columns, responses_of_columns;
    /// of A at the changed points
    DenseMatrix rows_of_A;
    /// I + D Z, factorised
    DenseMatrix small;
    DenseVector right_side, condensed_side;
  };
} // namespace vibrocontact

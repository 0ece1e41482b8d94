#pragma once

#include <vibrocontact/contact/newton_jacobian.h>
#include <vibrocontact/contact/secant_pairs.h>
#include <vibrocontact/numerics/single_factors.h>

#include <memory>

namespace vibrocontact
{
  /// The factorised matrices of Newton steps, kept while they serve: from one step to the next, and from one
  /// problem of the same operator to the next (time steps).
  ///
  /// A problem begins with the matrix whose rows are nearest to its own: vibrations come back to states where they were
  /// before. Another one is factorised where none reduces the residual, and where the steps that better ones would have
  /// saved since the last time come to the price of a factorisation.
  ///
  /// A point that changes between stick and slip changes its tangential rows of J, t = 1 or 2. As long as few have done so since the
  /// factorisation J = L U, the new matrix J + E D (E: unit columns of these rows, D: their differences) is
  /// solved by
  ///
  ///   (J + E D)^-1 r = x - Z (I + D Z)^-1 D x,   x = J^-1 r,   Z = J^-1 E    (Sherman, Morrison & Woodbury)
  ///
  /// at two solves per changed point, once. In time steps, whose problems follow each other with one operator, the rows of sliding
  /// points turn little by little besides: what steps have shown of that mends directions (SecantPairs) as long as no point
  /// changes its status.
  ///
  /// Many unknowns of time steps are solved for in single precision, which halves the memory that a step reads: residuals are
  /// those of the problem, in double precision. A matrix whose first solution shows that this is too coarse has double precision.
  /// So have those of the first problem of an operator, which are not kept for the next one.
  class NewtonFactorisation
  {
  public:
    /// Another problem begins.
    void begin_problem();
    /// Makes the matrix that `solve` solves with suit J, at the least cost.
    /// @param status of all points of the problem
    /// @param gain what the last step left of the residual [-], 0 before the first one
    /// @param factorisations counts them; @return false if the matrix is singular
    bool prepare(const ContactProblem &problem, const NewtonJacobian &J,
                 const std::vector<ContactStatus> &status, double gain, unsigned int &factorisations);
    /// x <- J^-1 x. @return false if the matrix is singular
    bool solve(DenseVector &x);
    /// The last direction was taken in full, or there is another one that these factors did not give.
    void took_direction() { direction_taken = true; }
    void leave_direction() { last_direction.reinit(0); }
    /// The direction led nowhere. @return whether the next one comes from a matrix of its own, which this one had not
    bool distrust();
    void forget();

  private:
    /// J at some state, factorised.
    struct Factors
    {
      /// active points, their status and rows
      std::vector<unsigned int> points;
      std::vector<ContactStatus> status;
      NewtonJacobian::Rows rows;
      /// J itself until the first solution by single_lu was tried with it, then empty or factorised
      DenseMatrix lu;
      /// empty: lu serves
      SingleFactors single_lu;
      /// points (among the active ones) with another status than when lu was made
      std::vector<unsigned int> changed;
      /// Z, size x t changed; D, t changed x size; I + D Z, factorised
      DenseMatrix columns, differences, small;
      SecantPairs pairs;
      /// number of the last problem that they served
      unsigned long last_used = 0;
    };

    /// The kept factors nearest to J, or null.
    Factors *nearest(const NewtonJacobian &J) const;
    /// flipped <- points of those in use that have another status now than when they were made; whether they are few.
    bool find_flipped(const std::vector<ContactStatus> &now);
    /// They are singular, by themselves or with what has changed.
    void drop_used();
    bool wants_another(double gain) const;
    bool factorise(const ContactProblem &problem, const NewtonJacobian &J,
                   const std::vector<ContactStatus> &now);
    /// Takes points that have changed their status into the factors in use.
    bool update(const ContactOperator &of, const NewtonJacobian &J);
    /// A among the points, until the next call with others.
    const DenseMatrix &response_of(const ContactOperator &of, const std::vector<unsigned int> &points);
    bool solve_by_factors(DenseVector &x);
    bool solve_by_lu(DenseVector &x);

    /// of all factors: their operator and the kind of load
    std::weak_ptr<const ContactOperator> A;
    bool force_given = false;
    /// A among some points
    struct Response
    {
      std::vector<unsigned int> points;
      DenseMatrix matrix;
    };
    /// the last ones asked for, the latest first
    std::vector<Response> responses;
    std::vector<std::unique_ptr<Factors>> kept;
    /// those in use; null: none
    Factors *used = nullptr;
    /// problems of this operator, solves of the last one
    unsigned long n_problems = 0;
    unsigned int n_solves = 0;
    /// steps since the last factorisation that better matrices would have saved
    unsigned int excess = 0;
    /// whether the matrix of this problem comes from an earlier one
    bool is_earlier = false;
    /// whether the next step has to have a matrix of its own
    bool is_distrusted = false;
    std::vector<unsigned int> flipped;
    /// of the last solve; none: of another problem or another matrix
    DenseVector last_residual, last_direction, right_side;
    bool direction_taken = false;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/contact/newton_factors.h>

#include <memory>

namespace vibrocontact
{
  /// The factorised matrices of Newton steps, kept while they serve: from one step to the next, and from one
  /// problem of the same operator to the next (time steps).
  ///
  /// A problem begins with the matrix whose rows are nearest to its own: vibrations come back to states where they were
  /// before. Another one is factorised where none reduces the residual, and where the steps that better ones would have
  /// saved since the last time come to the price of a factorisation. Points that change their status are taken into the factors as
  /// long as they are few (NewtonFactors). In time steps, whose problems follow each other with one operator, the rows of sliding
  /// points turn little by little besides: what steps have shown of that mends directions (SecantPairs) as long as no point changes
  /// its status.
  ///
  /// Many unknowns of time steps are solved for in single precision, which halves the memory that a step reads: residuals are
  /// those of the problem, in double precision. A matrix whose first solution shows that this is too coarse has double precision.
  /// So have those of the first problem of an operator, which are not kept for the next one.
  ///
  /// Where a second matrix of many unknowns has to be factorised, A is inverted instead, at all points of the problem if most are
  /// active, otherwise at those that have been active; this and further matrices are condensed by that (CondensedJacobian). One that
  /// fails to reduce the residual, although it is that of this very state, is followed by one that is not condensed.
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
    /// The last direction was taken in full.
    void took_direction() { direction_taken = true; }
    /// The next direction is one that these factors did not give.
    void leave_direction() { last_direction.reinit(0); }
    /// The direction led nowhere. @return whether the next one comes from a matrix of its own, which this one had not
    bool distrust();
    void forget();
    /// Whether the matrix in use was condensed.
    bool is_condensed() const { return used != nullptr && used->is_condensed(); }

  private:
    /// Those of the kept factors that can be used for J and are nearest to it, or null.
    NewtonFactors *nearest() const;
    /// J as the factors have it.
    const JacobianOnPoints &as_in(const NewtonFactors &factors) const
    {
      return factors.is_condensed() ? on_inverse : on_active;
    }
    /// Looks at J on the active points and on those of the inverse.
    void look_at(const NewtonJacobian &J, const std::vector<ContactStatus> &status);
    bool has_same_points(const NewtonFactors &factors) const
    {
      return as_in(factors).points == factors.at().points;
    }
    /// Whether points that have changed their status are few enough to be taken into factors of the same points.
    bool has_few_changes(const NewtonFactors &factors) const;
    /// They are singular, by themselves or with what has changed.
    void drop_used();
    bool wants_another(double gain) const;
    /// of factors like those in use, in steps of Newton's method
    double price() const;
    /// @param may_condense whether the matrix may be condensed
    bool factorise(const ContactProblem &problem, const NewtonJacobian &J,
                   const std::vector<ContactStatus> &status, bool may_condense);
    /// Where the unknowns of J are among those of the factors in use.
    void set_places(const NewtonJacobian &J);
    /// Whether there is an inverse by which J is condensed; makes one where that pays.
    bool find_inverse(const ContactProblem &problem, const NewtonJacobian &J,
                      const std::vector<ContactStatus> &status);
    /// Whether the factors are those of its operator and its load.
    bool is_of(const ContactProblem &problem) const;
    /// All points of a problem if most are active, otherwise those of J and of the factors that are kept.
    std::vector<unsigned int> points_in_use(const ContactProblem &problem, const NewtonJacobian &J) const;
    /// A among the points, until the next call with others.
    const DenseMatrix &response_of(const ContactOperator &of, const std::vector<unsigned int> &points);
    /// Its rows at some of the active points (places), one point's after the other's, by unknowns of J.
    DenseMatrix response_rows(const ContactOperator &of, const NewtonJacobian &J,
                              const std::vector<unsigned int> &places);

    /// of all factors: their operator and how they are loaded
    std::weak_ptr<const ContactOperator> A;
    bool force_given = false;
    DenseVector by_approach, to_force;
    /// A among some points
    struct Response
    {
      std::vector<unsigned int> points;
      DenseMatrix matrix;
    };
    /// the last ones asked for, the latest first
    std::vector<Response> responses;
    std::vector<std::unique_ptr<NewtonFactors>> kept;
    /// those in use; null: none
    NewtonFactors *used = nullptr;
    /// the last one made; null: none
    std::shared_ptr<const InverseResponse> inverse;
    /// matrices that were factorised for want of an inverse since it was made, and after how many another one is
    unsigned int n_without_inverse = 0, wanted_without_inverse = 1;
    /// matrices that the last one served
    unsigned int n_by_inverse = 0;
    /// J now; no points on an inverse that does not cover the active ones
    JacobianOnPoints on_active, on_inverse;
    /// row of those in use that each row of J is, and the last unknown of J over theirs
    std::vector<unsigned int> places;
    double approach_factor = 1;
    /// problems of this operator, solves of the last one
    unsigned long n_problems = 0;
    unsigned int n_solves = 0;
    /// steps since the last factorisation that better matrices would have saved
    unsigned int excess = 0;
    /// whether the matrix of this problem comes from an earlier one
    bool is_earlier = false;
    /// whether the next step has to have a matrix of its own
    bool is_distrusted = false;
    /// of the last solve, in rows of those in use; none: of another problem or another matrix
    DenseVector last_residual, last_direction;
    /// a vector of J in rows of those in use
    DenseVector on_points;
    bool direction_taken = false;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/contact/newton_jacobian.h>
#include <vibrocontact/numerics/wide_loops.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// A among some points, inverted in single precision: the forces that answer to given gaps and slips.
  ///
  /// Rows of A are divided by their component's mean diagonal, so that all numbers have the size of forces. If the normal force is
  /// given, A is bordered by the approach (the last column, in units of mean_diagonal(0) [m/N]) and by the resultant (the last row).
  class InverseResponse
  {
  public:
    /// @param points ascending
    InverseResponse(const ContactProblem &problem, std::vector<unsigned int> points);

    const std::vector<unsigned int> &points() const { return of_points; }
    bool covers(const std::vector<unsigned int> &points) const;
    /// false: A is singular, or so near to it that single precision does not serve
    bool is_exact_enough() const { return exact_enough; }
    unsigned int size() const { return n_rows; }
    std::size_t padded_size() const { return stride; }
    /// mean diagonal of a component [m/N, m/(N s)]
    double scale(const unsigned int component) const { return scales[component]; }
    /// forces by a unit response of a row
    const float *column(const unsigned int row) const { return inverse.data() + stride * row; }
    /// forces += sum over some rows of response_j * column_j. @param forces of padded size
    void add_forces(const std::vector<unsigned int> &rows, const std::vector<float> &responses,
                    AlignedSingleVector &forces) const;

  private:
    bool invert(const DenseMatrix &matrix);

    std::vector<unsigned int> of_points;
    unsigned int n_rows = 0;
    std::size_t stride = 0;
    std::array<double, 3> scales{};
    AlignedSingleVector inverse;
    bool exact_enough = false;
  };

  /// Newton's matrix condensed to the responses that are not prescribed.
  ///
  /// J = F + G A, where F and G have a block for each point, and A is the same for all states of a contact. With its inverse K and
  /// v = A x, J x = r is (F K + G) v = r. Rows of F are zero where a response is prescribed: gaps of closed points, slips of
  /// sticking ones. Their v is known at once, and what is left to factorise,
  ///
  ///   M = F K + G   among the slips of sliding points and all responses of open ones,
  ///
  /// is small where most points stick: contacts whose hundreds of points change their status in every step pay for those that slide
  /// alone.
  class CondensedJacobian
  {
  public:
    /// @param rows at the points of the inverse
    CondensedJacobian(const NewtonJacobian::Rows &rows, unsigned int n_components,
                      std::shared_ptr<const InverseResponse> inverse);

    /// rows of M
    unsigned int size() const { return left.size(); }
    void assemble(DenseMatrix &M) const;
    /// The right-hand side of M that belongs to J x = r. @param r rows of the inverse
    void condense(const DenseVector &r, DenseVector &right_side);
    /// x of the last right-hand side from what M gives
    void expand(const DenseVector &of_left_rows, DenseVector &x);
    /// A x of the last x in a row of a point [m, m/s], approach included
    double response(const unsigned int row) const { return responses[row] * inverse->scale(row / n); }

  private:
    /// A row that does not prescribe its response.
    struct LeftRow
    {
      unsigned int row;
      /// the rows of its point, and F and G in them, G by responses as the inverse has them
      std::array<unsigned int, 3> of_point;
      std::array<double, 3> by_force, by_scaled_response;
    };

    std::shared_ptr<const InverseResponse> inverse;
    unsigned int n, components;
    /// rows whose responses are prescribed, and these (as the inverse has them) by the right-hand side
    std::vector<unsigned int> prescribed;
    std::vector<double> by_residual;
    std::vector<LeftRow> left;
    std::vector<unsigned int> left_rows;
    /// of the last right-hand side, by row
    std::vector<double> responses;
    AlignedSingleVector forces;
    std::vector<float> factors;
  };

  /// Rows that are left if a matrix with such rows is condensed.
  unsigned int condensed_size(const NewtonJacobian::Rows &rows, unsigned int n_components);
} // namespace vibrocontact

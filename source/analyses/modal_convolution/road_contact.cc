#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/even_line_operator.h>
#include <vibrocontact/contact/projected_jacobi.h>
#include <vibrocontact/numerics/eigenvalues.h>

#include <algorithm>

namespace vibrocontact
{
  ContactProblem road_contact_problem(const DenseMatrix &matrix, const unsigned int n_points,
                                      const RoadLaws &laws, const double time_step, const double speed)
  {
    const unsigned int n = n_points, n_rows = std::min<unsigned int>(matrix.m(), 2 * n);
    const bool flows = matrix.m() == 3 * n;
    AssertThrow(flows || matrix.m() == n_rows, dealii::ExcDimensionMismatch(matrix.m(), 2 * n));
    DenseMatrix rows(n_rows, n_rows);
    for (unsigned int j = 0; j < n_rows; ++j)
      for (unsigned int i = 0; i < n_rows; ++i)
        rows(i, j) =
            i < n ? matrix(i, j) : matrix(i, j) / time_step - (flows ? speed * matrix(n + i, j) : 0.);
    ContactProblem problem;
    problem.title = "contact with the road";
    problem.A = std::make_shared<DenseContactOperator>(std::move(rows), n_rows / n);
    problem.b.reinit(n_rows);
    problem.normal_law = laws.normal;
    problem.friction_law = laws.friction;
    for (unsigned int i = 0; i < n; ++i)
      problem.mu.push_back(laws.friction ? laws.friction[i].at_rest() : 0.);
    return problem;
  }

  void use_even_line(ContactProblem &problem, const DenseMatrix &matrix)
  {
    if (problem.n_components() > 1)
      return;
    ContactProblem by_products = problem;
    by_products.A = EvenLineOperator::of(matrix);
    if (by_products.A && ProjectedJacobi::takes(by_products))
      problem.A = by_products.A;
  }

  void check_road_friction(const DenseMatrix &compliance)
  {
    if (!(definiteness(compliance) > 0))
      throw InputError(
          "Modal convolution/Friction is true, but unit forces at the contact points, along the "
          "road too, do not make a positive definite matrix of displacements in one step: the body "
          "does not move along the road; set Friction to false.");
  }
} // namespace vibrocontact

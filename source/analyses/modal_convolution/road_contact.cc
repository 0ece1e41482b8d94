#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/least_squares.h>

namespace vibrocontact
{
  ContactProblem road_contact_problem(const DenseMatrix &matrix, const unsigned int n_points,
                                      const RoadLaws &laws, const double time_step)
  {
    const unsigned int n = n_points, n_rows = matrix.m();
    AssertThrow(n_rows == n || n_rows == 2 * n, dealii::ExcDimensionMismatch(n_rows, 2 * n));
    DenseMatrix rows = matrix;
    for (unsigned int i = n; i < n_rows; ++i)
      for (unsigned int j = 0; j < n_rows; ++j)
        rows(i, j) /= time_step;
    ContactProblem problem;
    problem.title = "contact with the road";
    problem.A = std::make_shared<DenseContactOperator>(std::move(rows), n_rows / n);
    problem.b.reinit(n_rows);
    problem.normal_law = laws.normal;
    problem.friction_law = laws.friction;
    problem.mu.assign(n, laws.friction ? laws.friction->at_rest() : 0.);
    return problem;
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

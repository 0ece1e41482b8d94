// Factors of Newton's matrices, condensed or not, against LU of the matrix itself.

#include "pressed_block.h"

#include <vibrocontact/contact/newton_factorisation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <optional>

using namespace vibrocontact;

namespace
{
  /// A pressed block of 7 by 6 points at a state of our own, neither solved nor consistent.
  class Block
  {
  public:
    explicit Block(const bool force_given)
    {
      problem.title = "block";
      problem.A = pressed_block::response(7, 6);
      n = problem.n_points();
      problem.b.reinit(3 * n);
      problem.mu.assign(n, 0.3);
      if (force_given)
      {
        problem.normal_force = 100;
        // a hub that is inclined
        problem.by_approach.reinit(3 * n);
        problem.to_force.reinit(3 * n);
        for (unsigned int i = 0; i < n; ++i)
        {
          problem.by_approach[i] = problem.to_force[i] = 0.8;
          problem.to_force[n + i] = 0.6;
          problem.by_approach[n + i] = 6e3;
        }
      }
      residual.emplace(problem);
      R.reinit(3 * n);
      y.reinit(3 * n);
      for (unsigned int i = 0; i < n; ++i)
        set(i, i % 7 == 3 ? ContactStatus::open : i % 3 == 0 ? ContactStatus::stick : ContactStatus::slip);
    }

    void set(const unsigned int i, const ContactStatus wanted)
    {
      const double rho = residual->rho_normal_of(i), rho_t = residual->rho_tangential_of(i);
      R[i] = wanted == ContactStatus::open ? 0 : 2 + std::sin(1. * i);
      y[i] = (wanted == ContactStatus::open ? 1 : 0.1) / rho;
      for (unsigned int c = 1; c < 3; ++c)
      {
        R[c * n + i] = 0.1 * std::cos(c + 2. * i);
        y[c * n + i] = (wanted == ContactStatus::slip ? 2 * std::sin(c + 0.1 * i) : 0.01) / rho_t;
      }
    }

    /// J and the status at the state
    void look()
    {
      DenseVector projected;
      residual->evaluate(R, y, projected, status);
      J.linearise(problem, *residual, R, y);
    }

    /// Solution of J x = r by LU; r = 1, 1/2, 1/3, ...
    DenseVector solution() const
    {
      DenseMatrix A, matrix;
      problem.A->extract(J.points(), A);
      J.assemble(A, matrix);
      matrix.compute_lu_factorization();
      DenseVector x(J.size());
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] = 1. / (1 + i);
      matrix.solve(x);
      return x;
    }

    unsigned int n;
    ContactProblem problem;
    std::optional<ContactResidual> residual;
    DenseVector R, y;
    std::vector<ContactStatus> status;
    NewtonJacobian J;
  };

  /// Largest difference of what factors give from the solution by LU, relative to its largest force; those of open points are zero.
  double error_of(NewtonFactors &factors, const Block &block)
  {
    const NewtonJacobian &J = block.J;
    const JacobianOnPoints &at = factors.at();
    const unsigned int m = J.points().size(), all = at.points.size();
    DenseVector x(at.size());
    std::vector<unsigned int> places(J.size(), at.size() - 1);
    const std::vector<unsigned int> of_points = places_among(J.points(), at.points);
    for (unsigned int row = 0; row < 3 * m; ++row)
      places[row] = row / m * all + of_points[row % m];
    for (unsigned int row = 0; row < J.size(); ++row)
      x[places[row]] = 1. / (1 + row);
    EXPECT_TRUE(factors.solve(x));
    if (at.force_given)
      x[at.size() - 1] *= at.approach_scale / J.approach_scale();
    const DenseVector exact = block.solution();
    double error = 0;
    for (unsigned int row = 0; row < J.size(); ++row)
    {
      error = std::max(error, std::abs(x[places[row]] - exact[row]));
      x[places[row]] = 0;
    }
    return std::max(error, x.linfty_norm()) / exact.linfty_norm();
  }

  std::vector<unsigned int> all_points(const unsigned int n)
  {
    std::vector<unsigned int> result(n);
    std::iota(result.begin(), result.end(), 0u);
    return result;
  }
} // namespace

TEST(NewtonFactors, CondensedMatrixHasTheSolutionOfTheWhole)
{
  for (const bool force_given : {false, true})
  {
    Block block(force_given);
    block.look();
    const auto inverse = std::make_shared<InverseResponse>(block.problem, all_points(block.n));
    ASSERT_TRUE(inverse->is_exact_enough());
    JacobianOnPoints at;
    at.take(block.J, inverse->points(), block.status, inverse->scale(0));
    NewtonFactors factors(at, inverse);
    ASSERT_TRUE(factors.factorise({}, true));
    // gaps of closed points and slips of sticking ones are not left
    unsigned int left = 0;
    for (const ContactStatus status : block.status)
      left += status == ContactStatus::open ? 3 : status == ContactStatus::slip ? 2 : 0;
    EXPECT_EQ(factors.n_factorised(), left);
    EXPECT_EQ(condensed_size(at.rows, 3), left);
    EXPECT_LT(error_of(factors, block), 2e-5) << force_given;
  }
}

TEST(NewtonFactors, PointsThatOpenCloseSlideAndStickAreTakenIn)
{
  for (const bool force_given : {false, true})
  {
    Block block(force_given);
    block.look();
    const auto inverse = std::make_shared<InverseResponse>(block.problem, all_points(block.n));
    JacobianOnPoints at;
    at.take(block.J, inverse->points(), block.status, inverse->scale(0));
    NewtonFactors factors(at, inverse);
    ASSERT_TRUE(factors.factorise({}, true));
    // one after the other, so that columns are kept, and back again
    const std::pair<unsigned int, ContactStatus> changes[] = {
        {3, ContactStatus::slip},  {4, ContactStatus::open},  {6, ContactStatus::slip},
        {8, ContactStatus::stick}, {4, ContactStatus::stick}, {3, ContactStatus::open},
        {8, ContactStatus::open}};
    const unsigned int n_changed[] = {1, 2, 3, 4, 4, 3, 3};
    for (unsigned int k = 0; k < 7; ++k)
    {
      block.set(changes[k].first, changes[k].second);
      block.look();
      ASSERT_EQ(block.status[changes[k].first], changes[k].second);
      JacobianOnPoints now;
      now.take(block.J, inverse->points(), block.status, inverse->scale(0));
      const std::vector<unsigned int> changed = factors.changed_points(now);
      EXPECT_EQ(changed.size(), n_changed[k]);
      EXPECT_EQ(factors.n_new(changed), k < 4 ? 1u : 0u);
      EXPECT_FALSE(factors.has(now, changed));
      ASSERT_TRUE(factors.update(now, changed, DenseMatrix()));
      EXPECT_TRUE(factors.has(now, changed));
      EXPECT_LT(error_of(factors, block), 5e-5) << force_given << " " << k;
    }
  }
}

TEST(NewtonFactors, PointsThatSlideAreTakenIntoTheWholeMatrix)
{
  for (const bool force_given : {false, true})
  {
    Block block(force_given);
    block.look();
    JacobianOnPoints at, now;
    at.take(block.J, block.J.points(), block.status, block.J.approach_scale());
    NewtonFactors factors(at, nullptr);
    DenseMatrix A, matrix;
    block.problem.A->extract(block.J.points(), A);
    block.J.assemble(A, matrix);
    ASSERT_TRUE(factors.factorise([&](DenseMatrix &J) { J = matrix; }, false));
    EXPECT_LT(error_of(factors, block), 1e-12);
    block.set(6, ContactStatus::slip);
    block.set(8, ContactStatus::stick);
    block.look();
    now.take(block.J, block.J.points(), block.status, block.J.approach_scale());
    const std::vector<unsigned int> changed = factors.changed_points(now);
    ASSERT_EQ(changed.size(), 2u);
    const unsigned int m = now.points.size();
    DenseMatrix rows(6, now.size());
    for (unsigned int row = 0; row < 6; ++row)
    {
      for (unsigned int j = 0; j < 3 * m; ++j)
        rows(row, j) = A(row % 3 * m + changed[row / 3], j);
      if (force_given)
        rows(row, 3 * m) = block.J.response_to_approach(changed[row / 3])[row % 3];
    }
    ASSERT_TRUE(factors.update(now, changed, rows));
    EXPECT_LT(error_of(factors, block), 1e-11) << force_given;
  }
}

// Two rows of A that are the same have no inverse.
TEST(NewtonFactors, ASingularResponseIsNotInverted)
{
  DenseMatrix A(6);
  for (unsigned int i = 0; i < 6; ++i)
    A(i, i) = 1;
  A(0, 1) = A(1, 0) = 1;
  ContactProblem problem;
  problem.A = std::make_shared<DenseContactOperator>(std::move(A));
  EXPECT_FALSE(InverseResponse(problem, {0, 1}).is_exact_enough());
  EXPECT_TRUE(InverseResponse(problem, {1}).is_exact_enough());
  EXPECT_TRUE(InverseResponse(problem, {1}).covers({1}));
  EXPECT_FALSE(InverseResponse(problem, {1}).covers({0, 1}));
}

// Where all points stick nothing is left to factorise, and one that slides is taken in all the same.
TEST(NewtonFactors, AllStick)
{
  Block block(false);
  for (unsigned int i = 0; i < block.n; ++i)
    block.set(i, ContactStatus::stick);
  block.look();
  const auto inverse = std::make_shared<InverseResponse>(block.problem, all_points(block.n));
  JacobianOnPoints at, now;
  at.take(block.J, inverse->points(), block.status, inverse->scale(0));
  NewtonFactors factors(at, inverse);
  ASSERT_TRUE(factors.factorise({}, true));
  EXPECT_EQ(factors.n_factorised(), 0u);
  EXPECT_LT(error_of(factors, block), 2e-5);
  block.set(5, ContactStatus::slip);
  block.look();
  now.take(block.J, inverse->points(), block.status, inverse->scale(0));
  ASSERT_TRUE(factors.update(now, factors.changed_points(now), DenseMatrix()));
  EXPECT_LT(error_of(factors, block), 2e-5);
}

// Problems with normal rows alone, and with normal rows and x.
TEST(NewtonFactors, FewerComponents)
{
  for (const unsigned int components : {1u, 2u})
  {
    const unsigned int n = 12;
    DenseMatrix A(components * n);
    for (unsigned int i = 0; i < components * n; ++i)
      for (unsigned int j = 0; j < components * n; ++j)
        A(i, j) = (i == j ? 2 : 0) + 1 / (1. + std::abs(int(i) - int(j)));
    ContactProblem problem;
    problem.A = std::make_shared<DenseContactOperator>(A, components);
    problem.b.reinit(components * n);
    problem.mu.assign(n, 0.3);
    const ContactResidual residual(problem);
    DenseVector R(components * n), y(components * n), projected;
    for (unsigned int i = 0; i < n; ++i)
    {
      R[i] = i % 4 == 0 ? 0 : 1;
      y[i] = i % 4 == 0 ? 1 : 0;
      if (components > 1)
        y[n + i] = i % 3 == 0 ? 1 : 0.01;
    }
    std::vector<ContactStatus> status;
    residual.evaluate(R, y, projected, status);
    NewtonJacobian J;
    J.linearise(problem, residual, R, y);
    const auto inverse = std::make_shared<InverseResponse>(problem, all_points(n));
    JacobianOnPoints at;
    at.take(J, inverse->points(), status, inverse->scale(0));
    NewtonFactors factors(at, inverse);
    ASSERT_TRUE(factors.factorise({}, true));
    DenseMatrix block, matrix;
    problem.A->extract(J.points(), block);
    J.assemble(block, matrix);
    matrix.compute_lu_factorization();
    DenseVector exact(J.size()), x(at.size());
    const unsigned int m = J.points().size();
    for (unsigned int row = 0; row < J.size(); ++row)
      x[row / m * n + J.points()[row % m]] = exact[row] = 1. / (1 + row);
    matrix.solve(exact);
    ASSERT_TRUE(factors.solve(x));
    for (unsigned int row = 0; row < J.size(); ++row)
      EXPECT_NEAR(x[row / m * n + J.points()[row % m]], exact[row], 1e-5) << components << " " << row;
  }
}

// In a march the matrix of the second problem is whole, the next that has to be made is condensed.
TEST(NewtonFactors, AMarchInvertsAOnce)
{
  Block block(true);
  NewtonFactorisation kept;
  unsigned int factorisations = 0;
  const auto solve = [&](const double gain)
  {
    block.look();
    EXPECT_TRUE(kept.prepare(block.problem, block.J, block.status, gain, factorisations));
    DenseVector x(block.J.size());
    for (unsigned int row = 0; row < x.size(); ++row)
      x[row] = 1. / (1 + row);
    EXPECT_TRUE(kept.solve(x));
    x -= block.solution();
    return x.linfty_norm() / block.solution().linfty_norm();
  };
  kept.begin_problem();
  EXPECT_LT(solve(0), 1e-11);
  kept.begin_problem();
  EXPECT_LT(solve(0), 1e-4);
  EXPECT_FALSE(kept.is_condensed());
  EXPECT_EQ(factorisations, 2u);
  // a point closes: another set of active ones
  kept.begin_problem();
  block.set(3, ContactStatus::slip);
  EXPECT_LT(solve(0), 1e-4);
  EXPECT_TRUE(kept.is_condensed());
  EXPECT_EQ(factorisations, 3u);
  // others do: taken in
  kept.begin_problem();
  block.set(3, ContactStatus::open);
  block.set(10, ContactStatus::stick);
  EXPECT_LT(solve(0), 1e-4);
  EXPECT_EQ(factorisations, 3u);
  // the next matrix of this very state is made by the inverse, and if it fails itself a whole one
  EXPECT_LT(solve(0.95), 1e-4);
  EXPECT_TRUE(kept.is_condensed());
  EXPECT_LT(solve(0.5), 1e-4);
  EXPECT_FALSE(kept.is_condensed());
  EXPECT_EQ(factorisations, 5u);
  // a hub that moves otherwise
  block.problem.by_approach[0] = 0.7;
  kept.begin_problem();
  EXPECT_LT(solve(0), 1e-11);
}

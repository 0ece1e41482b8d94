// Contact problems that are hard by their numbers: friction from 0 to 10, jamming, redundant points, compliances and gaps of
// many magnitudes, a load at lift-off, penalties of 1e14.

#include "../unit/random_contact.h"
#include "report.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/contact_solvers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace vibrocontact;

namespace
{
  ContactProblem problem_of(DenseMatrix A, const std::vector<double> &b, const double mu,
                            const unsigned int components = 3)
  {
    ContactProblem problem;
    problem.title = "hard";
    problem.A = std::make_shared<DenseContactOperator>(std::move(A), components);
    problem.b.reinit(b.size());
    std::copy(b.begin(), b.end(), problem.b.begin());
    problem.mu.assign(b.size() / components, mu);
    return problem;
  }

  DenseMatrix diagonal(const std::vector<double> &values)
  {
    DenseMatrix A(values.size());
    for (unsigned int i = 0; i < values.size(); ++i)
      A(i, i) = values[i];
    return A;
  }

  /// A solution of every solver that takes the problem, but for some.
  std::vector<std::pair<std::string, ContactSolution>> by_all(const ContactProblem &problem,
                                                              const std::string &but = "")
  {
    std::vector<std::pair<std::string, ContactSolution>> solutions;
    for (const ContactSolverEntry &entry : contact_solvers())
    {
      if (entry.name == but || (entry.takes && !entry.takes(problem)))
        continue;
      ContactSolverParameters parameters;
      parameters.method = entry.name;
      solutions.emplace_back(entry.name, create_contact_solver(parameters)->solved(problem));
    }
    return solutions;
  }

  /// Largest difference of the forces over the largest force.
  double off(const DenseVector &R, const std::vector<double> &truth)
  {
    double worst = 0, size = 0;
    for (unsigned int i = 0; i < truth.size(); ++i)
    {
      worst = std::max(worst, std::abs(R[i] - truth[i]));
      size = std::max(size, std::abs(truth[i]));
    }
    return worst / size;
  }

  void expect_by_all(const ContactProblem &problem, const std::vector<double> &truth, const double tolerance,
                     const char *what)
  {
    double worst = 0;
    for (const auto &[name, s] : by_all(problem))
    {
      EXPECT_TRUE(s.converged) << what << ", " << name << " " << s.residual;
      EXPECT_LE(off(s.R, truth), tolerance) << what << ", " << name;
      worst = std::max(worst, off(s.R, truth));
    }
    report(what, worst);
  }

  /// Forces (N, Tx, Ty) that stick: A R = approach - b, by LU.
  std::vector<double> stuck(const ContactProblem &problem)
  {
    const unsigned int n = problem.n_points(), m = problem.n_rows();
    std::vector<unsigned int> points(n);
    for (unsigned int i = 0; i < n; ++i)
      points[i] = i;
    DenseMatrix A(m);
    problem.A->extract(points, A);
    DenseVector x(m);
    for (unsigned int i = 0; i < m; ++i)
      x[i] = (i < n ? problem.approach : 0.) - problem.b[i];
    A.compute_lu_factorization();
    A.solve(x);
    return {x.begin(), x.end()};
  }
} // namespace

// Three points under a common approach, friction 2 and 10: where A R = approach - b lies within the cones, they stick.
TEST(HardContact, FrictionTwoAndTenStick)
{
  unsigned int stick = 0;
  double worst = 0;
  for (unsigned int seed = 0; seed < 40; ++seed)
    for (const double mu : {2., 10.})
    {
      ContactProblem problem = random_contact(3, 3, mu, create_normal_law("signorini"), seed);
      problem.approach = 1e-3;
      const std::vector<double> truth = stuck(problem);
      bool within = true;
      for (unsigned int i = 0; i < 3; ++i)
        within = within && truth[i] > 0 && std::hypot(truth[3 + i], truth[6 + i]) < mu * truth[i];
      if (!within)
        continue;
      ++stick;
      for (const auto &[name, s] : by_all(problem))
      {
        EXPECT_TRUE(s.converged) << seed << " " << mu << " " << name << " " << s.residual;
        EXPECT_LE(off(s.R, truth), 1e-9) << seed << " " << mu << " " << name;
        worst = std::max(worst, off(s.R, truth));
      }
    }
  report("forces", worst);
  EXPECT_GT(stick, 20u);
}

// One point, friction along x, mu at and beside mu_c = W_nn / W_nt, where sliding forwards closes no gap. Forwards it then
// sticks, A (N, T) = (depth, -slip); backwards it slides, N = depth / (W_nn + mu W_nt).
TEST(HardContact, JammingAgainstStickingClosedForm)
{
  const double w_nn = 1e-8, w_nt = 2e-9, w_tt = 1e-8, determinant = w_nn * w_tt - w_nt * w_nt;
  double worst = 0;
  for (const double slip : {1e-4, -1e-4, 1e-3, -1e-3})
    for (const double depth : {1e-5, 1e-6})
      for (const double factor : {1., 1 - 1e-9, 1 + 1e-9, 2.})
      {
        const double mu = factor * w_nn / w_nt;
        DenseMatrix A = diagonal({w_nn, w_tt});
        A(0, 1) = A(1, 0) = w_nt;
        const double sliding = depth / (w_nn + mu * w_nt);
        const std::vector<double> truth =
            slip > 0 ? std::vector<double>{(w_tt * depth + w_nt * slip) / determinant,
                                           -(w_nn * slip + w_nt * depth) / determinant}
                     : std::vector<double>{sliding, mu * sliding};
        for (const auto &[name, s] : by_all(problem_of(A, {-depth, slip}, mu, 2)))
        {
          if (name == "fixed point" && slip < 0 && factor != 2) // it alternates, and says so
          {
            EXPECT_TRUE(!s.converged || off(s.R, truth) < 1e-9);
            continue;
          }
          EXPECT_TRUE(s.converged) << name << " " << slip << " " << depth << " " << factor << " "
                                   << s.residual;
          EXPECT_LE(off(s.R, truth), 1e-9) << name << " " << slip << " " << depth << " " << factor;
          worst = std::max(worst, off(s.R, truth));
        }
      }
  report("forces", worst);
}

// The same where nothing yields along x: up to mu_c the point slides, N = depth / (W_nn - mu W_nt); from there on no force
// closes the gap, and none is told.
TEST(HardContact, JammingWithoutSolution)
{
  const double w_nn = 1e-8, w_nt = 2e-9, depth = 1e-6;
  double worst = 0;
  for (const double below : {1e-1, 1e-3, 1e-6, 0., -1e-3, -1.})
  {
    const double mu = (1 - below) * w_nn / w_nt, N = depth / (w_nn - mu * w_nt);
    DenseMatrix A = diagonal({w_nn, 0});
    A(0, 1) = A(1, 0) = w_nt;
    for (const auto &[name, s] : by_all(problem_of(A, {-depth, 1}, mu, 2), "fixed point"))
    {
      EXPECT_TRUE(s.is_finite()) << name;
      if (below <= 0)
        EXPECT_FALSE(s.converged) << name << " " << below << " " << s.R[0];
      else
      {
        EXPECT_TRUE(s.converged) << name << " " << below << " " << s.residual;
        EXPECT_NEAR(s.R[0] / N, 1, 1e-8 + 1e-14 / below) << name;
        worst = std::max(worst, std::abs(s.R[0] / N - 1));
      }
    }
  }
  report("N up to mu_c (1 - 1e-6)", worst);
}

// One point, friction from none to 1e300: N = depth / w, T = -min(mu N, slip / w).
TEST(HardContact, FrictionOfExtremeNumbers)
{
  const double w = 1e-8, depth = 1e-6, slip = 1e-6;
  for (const double mu : {0., 1e-150, 1e-15, 1e6, 1e15, 1e300})
  {
    const double N = depth / w, T = -std::min(mu * N, slip / w);
    for (const auto &[name, s] : by_all(problem_of(diagonal({w, w, w}), {-depth, slip, 0}, mu)))
    {
      EXPECT_TRUE(s.converged) << name << " " << mu;
      EXPECT_NEAR(s.R[0] / N, 1, 1e-12) << name << " " << mu;
      if (mu == 0)
        EXPECT_EQ(s.R[1], 0) << name;
      else
        EXPECT_NEAR(s.R[1] / T, 1, 1e-9) << name << " " << mu;
    }
  }
}

// Points that do not feel each other, compliances from 1e-9 to 1 m/N, the same depth: N_i = depth / w_i. The fixed point's
// constant rho is that of the softest: it ends unfinished, and says so.
TEST(HardContact, StiffnessRatioOfABillion)
{
  std::vector<double> w, b, truth;
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int i = 0; i < 10; ++i)
    {
      w.push_back(std::pow(10., -double(i)));
      b.push_back(c == 0 ? -1e-6 : 0.);
      truth.push_back(c == 0 ? 1e-6 / w.back() : 0.);
    }
  double worst = 0;
  for (const auto &[name, s] : by_all(problem_of(diagonal(w), b, 0.3)))
  {
    EXPECT_TRUE(s.converged || name == "fixed point") << name << " " << s.residual;
    for (unsigned int i = 0; i < 10 && s.converged; ++i)
    {
      EXPECT_NEAR(s.R[i] / truth[i], 1, 1e-9) << name << " " << i;
      worst = std::max(worst, std::abs(s.R[i] / truth[i] - 1));
    }
  }
  report("each force", worst);
}

// A start that is off by a hundredth at a point 1e9 times as stiff as the other is no solution.
TEST(HardContact, StaleForceAtAStiffPoint)
{
  for (const unsigned int components : {1u, 2u})
  {
    std::vector<double> w{1, 1e-9}, b{-1e-6, -1e-6}, truth{1e-6, 1e3};
    if (components == 2) // a slip that friction of 1 N and 3e-7 N stops
    {
      w.insert(w.end(), {1, 1e-9});
      b.insert(b.end(), {1e-7, 1e-9});
      truth.insert(truth.end(), {-1e-7, -1.});
    }
    const ContactProblem problem = problem_of(diagonal(w), b, components == 1 ? 0 : 0.3, components);
    ContactSolution start;
    start.R.reinit(2 * components);
    std::copy(truth.begin(), truth.end(), start.R.begin());
    start.R[2 * components - 1] *= 1.01;
    double worst = 0;
    for (const ContactSolverEntry &entry : contact_solvers())
    {
      if (entry.takes && !entry.takes(problem))
        continue;
      ContactSolverParameters parameters;
      parameters.method = entry.name;
      const ContactSolution s = create_contact_solver(parameters)->solved(problem, start);
      // the fixed point may end unfinished, but not with that force
      EXPECT_TRUE(s.converged || entry.name == "fixed point") << entry.name << " " << s.residual;
      for (unsigned int i = 0; i < truth.size() && s.converged; ++i)
      {
        EXPECT_NEAR(s.R[i] / truth[i], 1, 1e-9) << entry.name << " " << i;
        worst = std::max(worst, std::abs(s.R[i] / truth[i] - 1));
      }
    }
    report(components == 1 ? "normal forces" : "with friction", worst);
  }
}

// Friction so small that rounding of the normal forces is more than the friction: N of mu = 0, T = -mu N along the slip.
TEST(HardContact, HardlyAnyFriction)
{
  double worst = 0;
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    ContactProblem problem = random_contact(6, 3, 0, create_normal_law("signorini"), seed);
    problem.approach = 1e-4;
    const ContactSolution smooth = create_contact_solver({})->solved(problem);
    for (const double mu : {1e-6, 1e-9, 1e-15})
    {
      problem.mu.assign(6, mu);
      for (const auto &[name, s] : by_all(problem))
      {
        if (name == "fixed point") // its rho is that of a symmetric matrix
          continue;
        EXPECT_TRUE(s.converged) << seed << " " << mu << " " << name << " " << s.residual;
        for (unsigned int i = 0; i < 6; ++i)
        {
          const auto R = at_point(s.R, 6, 3, i), y = at_point(smooth.y, 6, 3, i);
          EXPECT_NEAR(R[0], smooth.R[i], 10 * mu * smooth.R.l2_norm()) << name;
          for (unsigned int c = 1; c < 3; ++c)
          {
            const double truth = -smooth.R[i] * y[c] / std::hypot(y[1], y[2]);
            const double error = std::abs(R[c] / mu - truth) / smooth.R.l2_norm();
            EXPECT_LE(error, 1e-9 + 100 * mu) << name << " " << mu;
            if (mu < 1e-6)
              worst = std::max(worst, error);
          }
        }
      }
    }
  }
  report("T / mu", worst);
}

// All lengths times 1e-11, gaps of a femtometre: all forces times 1e-11, for the graphs are cones.
TEST(HardContact, GapsOfAFemtometre)
{
  double worst = 0;
  for (unsigned int seed = 0; seed < 30; ++seed)
  {
    ContactProblem problem =
        random_contact(1 + seed % 6, 1 + seed % 3, 0.3, create_normal_law("signorini"), seed);
    problem.approach = 5e-5;
    const auto full = by_all(problem);
    for (double &b : problem.b)
      b *= 1e-11;
    problem.approach *= 1e-11;
    const auto tiny = by_all(problem);
    for (unsigned int k = 0; k < full.size(); ++k)
    {
      ASSERT_TRUE(full[k].second.converged && tiny[k].second.converged) << seed << full[k].first;
      DenseVector scaled = tiny[k].second.R;
      scaled *= 1e11;
      if (full[k].second.R.l2_norm() == 0)
        EXPECT_EQ(scaled.l2_norm(), 0.);
      else
      {
        const double error = off(scaled, {full[k].second.R.begin(), full[k].second.R.end()});
        EXPECT_LE(error, 1e-9) << seed << " " << full[k].first;
        worst = std::max(worst, error);
      }
    }
  }
  report("forces over 1e-11", worst);
}

// Gaps of 1e-15 m between faces that are pressed by 1e-6 m: N = (depth - gap) / w.
TEST(HardContact, GapsBelowRounding)
{
  std::vector<double> w(30, 1e-8), b(30, 0.), truth(30, 0.);
  for (unsigned int i = 0; i < 10; ++i)
  {
    b[i] = (i % 2 ? 1 : -1) * 1e-15 - 1e-6;
    truth[i] = -b[i] / w[i];
  }
  expect_by_all(problem_of(diagonal(w), b, 0.3), truth, 1e-12, "pressed");
  // under a force of 1e-6 N that reaches over the gaps of 1e-15 m
  ContactProblem problem = problem_of(diagonal(w), b, 0.3);
  for (unsigned int i = 0; i < 10; ++i)
    problem.b[i] = (i % 2 ? 1e-15 : 0);
  problem.normal_force = 1e-6;
  // 5 (d + d - 1e-15) / w = F, if d > 1e-15
  const double d = (problem.normal_force * w[0] + 5e-15) / 10;
  for (const auto &[name, s] : by_all(problem))
  {
    EXPECT_TRUE(s.converged) << name << s.residual;
    EXPECT_NEAR(s.approach / d, 1, 1e-9) << name;
    EXPECT_NEAR(s.R[0] / (d / w[0]), 1, 1e-9) << name;
    EXPECT_NEAR(s.R[1] / ((d - 1e-15) / w[0]), 1, 1e-9) << name;
  }
}

// The gap that is just closed bears nothing; beyond, the depth over the compliance, as far as the gap has digits.
TEST(HardContact, ApproachAtLiftOff)
{
  const double gap = 1e-5, w = 1e-8, rounding = std::nextafter(gap, 1.) - gap;
  double worst = 0;
  for (const unsigned int components : {1u, 3u})
    for (const unsigned int n : {1u, 3u, 6u})
      for (const double depth : {-1e-12, -rounding, 0., rounding, 1e-12, 1e-9})
      {
        std::vector<double> b(components * n, 0.);
        std::fill(b.begin(), b.begin() + n, gap);
        ContactProblem problem =
            problem_of(diagonal(std::vector<double>(components * n, w)), b, 0.3, components);
        problem.approach = gap + depth;
        for (const auto &[name, s] : by_all(problem))
        {
          EXPECT_TRUE(s.converged) << name << " " << depth;
          for (unsigned int i = 0; i < n; ++i)
            if (depth <= 0)
              EXPECT_EQ(s.R[i], 0) << name << " " << depth;
            else
            {
              EXPECT_GT(s.R[i], 0) << name << " " << depth;
              const double error = std::abs(s.R[i] * w - (problem.approach - gap));
              EXPECT_LE(error, rounding + 1e-10 * depth) << name << " " << depth;
              worst = std::max(worst, error);
            }
        }
      }
  report("depth [m]", worst);
}

// A spring of 1e14 N/m in series with compliances of 1e-8 m/N: N = depth / (w + 1/k).
TEST(HardContact, PenaltyOfOneHundredTrillion)
{
  const double w = 1e-8, depth = 1e-6;
  for (const double k : {1e14, 1e18})
  {
    std::vector<double> b(18, 0.), truth(18, 0.);
    for (unsigned int i = 0; i < 6; ++i)
    {
      b[i] = i < 4 ? -depth : depth;
      truth[i] = i < 4 ? depth / (w + 1 / k) : 0;
      b[6 + i] = 1.; // slips: T = -mu N
      truth[6 + i] = -0.3 * truth[i];
    }
    ContactProblem problem = problem_of(diagonal(std::vector<double>(18, w)), b, 0.3);
    problem.normal_law = create_normal_law("linear spring", {1., k});
    expect_by_all(problem, truth, 1e-9, k == 1e14 ? "linear spring of 1e14" : "of 1e18");
    // the exponential penalty needs its own depth of the force, here below 1e-9 of the whole
    problem.normal_law = create_normal_law("exponential penalty", {1e4, k / 1e4});
    for (const auto &[name, s] : by_all(problem))
    {
      EXPECT_TRUE(s.converged) << name << " " << s.residual;
      for (unsigned int i = 0; i < 4; ++i)
        EXPECT_NEAR(s.R[i] * w / depth, 1, 2e-4 * 1e14 / k) << name;
    }
  }
}

// Redundant points: two that move as one share the force; sums are those of one point, sticking and slipping.
TEST(HardContact, PointsThatAreOne)
{
  const double w = 1e-8, depth = 1e-6;
  for (const double slip : {1e-8, 1.})
  {
    DenseMatrix A(6);
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          A(2 * c + i, 2 * c + j) = w;
    const ContactProblem problem = problem_of(A, {-depth, -depth, slip, slip, 0, 0}, 0.3);
    const double N = depth / w, T = -std::min(0.3 * N, slip / w);
    for (const auto &[name, s] : by_all(problem))
    {
      EXPECT_TRUE(s.converged) << name << " " << slip << " " << s.residual;
      EXPECT_NEAR((s.R[0] + s.R[1]) / N, 1, 1e-9) << name;
      EXPECT_NEAR((s.R[2] + s.R[3]) / T, 1, 1e-9) << name;
      EXPECT_NEAR((s.R[4] + s.R[5]) / N, 0, 1e-9) << name;
    }
  }
}

// Slip that turns: a point that slips along a direction found from slip and force together (anisotropic compliance).
TEST(HardContact, SlipDirectionOfAnisotropicCompliance)
{
  // T = -mu N s/|s|, s = s0 + diag(wx, wy) T: bisection on |s|
  const double w = 1e-8, wx = 1e-5, wy = 1e-11, depth = 1e-6, mu = 0.5, N = depth / w;
  const double sx = 1e-3, sy = 2e-9;
  // s_i = s0_i / (1 + w_i mu N / |s|)
  double low = 0, high = std::hypot(sx, sy);
  for (unsigned int k = 0; k < 300; ++k)
  {
    const double m = 0.5 * (low + high);
    const double value = std::hypot(sx / (m + wx * mu * N), sy / (m + wy * mu * N));
    (value > 1 ? low : high) = m;
  }
  const double s = low, x = sx / (1 + wx * mu * N / s) / s, y = sy / (1 + wy * mu * N / s) / s;
  expect_by_all(problem_of(diagonal({w, wx, wy}), {-depth, sx, sy}, mu), {N, -mu * N * x, -mu * N * y}, 1e-7,
                "forces");
}

// Propagators against each other and against closed forms; the contact of a step against the common solver.
#include "matrix_difference.h"

#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/contact/even_line_operator.h>
#include <vibrocontact/contact/newton.h>
#include <vibrocontact/contact/projected_jacobi.h>
#include <vibrocontact/numerics/phi_functions.h>
#include <vibrocontact/numerics/piecewise_polynomial.h>
#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/propagators/modal_step.h>
#include <vibrocontact/propagators/propagator_types.h>
#include <vibrocontact/propagators/step_weights.h>
#include <vibrocontact/propagators/thin_product.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace vibrocontact;

namespace
{
  /// Modes of a random structure; rows that differ, left shapes of their own if asked for.
  BodyInContact random_model(const unsigned int n_rows, const unsigned int n_modes, const bool rolling,
                             const double tread)
  {
    std::mt19937 random(7 * n_rows + n_modes);
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<double> omega, zeta, load;
    DenseMatrix trace(n_rows, n_modes), residual(n_rows, n_rows);
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      omega.push_back(200 + 150 * k);
      zeta.push_back(0.05);
      load.push_back(-5 * number(random));
      for (unsigned int i = 0; i < n_rows; ++i)
        trace(i, k) = number(random);
    }
    for (unsigned int i = 0; i < n_rows; ++i)
      residual(i, i) = tread;
    BodyInContact model = by_poles({omega, zeta, trace, load, residual, {}});
    if (rolling)
      for (unsigned int k = 0; k < n_modes; ++k)
        for (unsigned int i = 0; i < n_rows; ++i)
        {
          model.right(i, k) *= std::complex<double>(1, 0.02 * i);
          model.left(i, k) *= std::complex<double>(1, -0.02 * i);
        }
    return model;
  }

  std::vector<double> road(const unsigned int n_rows, const double t)
  {
    std::vector<double> heights(n_rows);
    for (unsigned int i = 0; i < n_rows; ++i)
      heights[i] = 1e-4 * std::sin(300 * t + i) + 5e-5;
    return heights;
  }

  /// Displacements at the end of each step, with contact.
  std::vector<double> run(Propagator &propagator, const unsigned int n_steps, const double h)
  {
    const unsigned int n = propagator.n_rows();
    ContactProblem problem = road_contact_problem(propagator.compliance(), n, {}, h);
    ActiveSetSolver contact;
    ContactSolution solution;
    std::vector<double> history;
    for (unsigned int step = 1; step <= n_steps; ++step)
    {
      const std::vector<double> heights = road(n, step * h);
      for (unsigned int i = 0; i < n; ++i)
        problem.b[i] = propagator.free_displacement()[i] - heights[i];
      contact.solve(problem, solution);
      propagator.advance(solution.R.data());
      for (unsigned int i = 0; i < n; ++i)
        history.push_back(solution.y[i] + heights[i]);
    }
    return history;
  }
} // namespace

TEST(PhiFunctions, SeriesAndQuotientsAreOneFunction)
{
  using Complex = std::complex<double>;
  // by their integral: phi_n(x) = int_0^1 e^(x (1 - s)) s^(n-1) / (n-1)! ds, Simpson
  for (const Complex &x :
       {Complex(-1e-9, 1e-9), Complex(-0.3, 1.2), Complex(-1.4, 0.7), Complex(-4, 3), Complex(-0.1, 9)})
    for (unsigned int n = 1; n <= 3; ++n)
    {
      Complex sum = 0;
      const unsigned int m = 4000;
      for (unsigned int k = 0; k <= m; ++k)
      {
        const double s = double(k) / m, weight = k == 0 || k == m ? 1 : k % 2 == 1 ? 4 : 2;
        sum += weight * std::exp(x * (1 - s)) * std::pow(s, n - 1) / std::tgamma(n) / (3. * m);
      }
      EXPECT_NEAR(std::abs(phi(n, x) / sum - 1.), 0, 1e-11) << n << " " << x;
    }
}

TEST(WideLoops, ScalarProductOfAnyLength)
{
  std::vector<double> a, b;
  double exact = 0;
  for (unsigned int n = 0; n < 200; ++n)
  {
    EXPECT_NEAR(wide_dot(a.data(), b.data(), n), exact, 1e-12 * (1 + std::abs(exact))) << n;
    a.push_back(0.5 + n % 7);
    b.push_back(1. / (1 + n));
    exact += a.back() * b.back();
  }
}

TEST(PiecewisePolynomial, ValuesDerivativesIntegral)
{
  const PiecewisePolynomial sine([](const double x) { return std::sin(30 * x) + 0.1 * x; }, -1, 3, 0.7);
  for (double x = -1; x <= 3; x += 0.0137)
  {
    const auto at = sine.at(x);
    EXPECT_NEAR(at.value, std::sin(30 * x) + 0.1 * x, 1e-13);
    EXPECT_NEAR(sine.value(x), at.value, 1e-15);
    EXPECT_NEAR(at.first, 30 * std::cos(30 * x) + 0.1, 1e-10);
    EXPECT_NEAR(at.second, -900 * std::sin(30 * x), 1e-7);
    EXPECT_NEAR(sine.integral().value(x), (std::cos(-30.) - std::cos(30 * x)) / 30 + 0.05 * (x * x - 1),
                1e-12);
  }
  std::vector<double> x, y;
  for (unsigned int k = 0; k <= 100; ++k)
  {
    x.push_back(0.06 * k + 0.01 * std::sin(k));
    y.push_back(std::sin(x.back()));
  }
  const PiecewisePolynomial spline = PiecewisePolynomial::spline(x, y);
  for (unsigned int k = 0; k <= 100; ++k)
    EXPECT_NEAR(spline.value(x[k]), y[k], 1e-14);
  for (double s = 1; s < 5; s += 0.01)
  {
    EXPECT_NEAR(spline.at(s).value, std::sin(s), 1e-6);
    EXPECT_NEAR(spline.at(s).second, -std::sin(s), 2e-3);
  }
}

// The oscillator under forces that are known: closed forms of each force interpolation.
TEST(Propagator, ForceInterpolationsAreExact)
{
  const double w = 300, zeta = 0.1, h = 0.004, wd = w * std::sqrt(1 - zeta * zeta);
  DenseMatrix trace(1, 1), residual(1, 1);
  trace(0, 0) = 0.5;
  residual(0, 0) = 1e-6;
  const BodyInContact model = by_poles({{w}, {zeta}, trace, {}, residual, {}});
  const auto g = [&](const double t)
  { return t <= 0 ? 0. : 0.25 / wd * std::exp(-zeta * w * t) * std::sin(wd * t); };
  // displacement under a unit step and a unit ramp, M = 4
  const auto step_response = [&](const double t)
  {
    return t <= 0 ? 0.
                  : 0.25 / (w * w) *
                        (1 - std::exp(-zeta * w * t) * (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t)));
  };
  const auto ramp_response = [&](const double t)
  {
    if (t <= 0)
      return 0.;
    // u = (t - 2 zeta / w) / K + decaying part from u(0) = u'(0) = 0
    const double a = 2 * zeta / w, b = (-1 + zeta * w * a) / wd;
    return 0.25 / (w * w) * (t - a + std::exp(-zeta * w * t) * (a * std::cos(wd * t) + b * std::sin(wd * t)));
  };
  const std::vector<double> forces = {3, -1, 4, 1, 5, -9};
  for (const PropagatorType &method : propagator_types())
    for (const ForceInterpolation interpolation :
         {ForceInterpolation::impulse, ForceInterpolation::constant, ForceInterpolation::linear})
    {
      if (method.name == "theta method")
        continue; // the next test
      PropagatorSettings settings;
      settings.time_step = h;
      settings.interpolation = interpolation;
      settings.n_steps = 200;
      const auto propagator = method.create(model, state_at_rest(model), settings);
      for (unsigned int n = 0; n < 150; ++n)
      {
        const double q = n < forces.size() ? forces[n] : 0;
        const double u = propagator->free_displacement()[0] + propagator->compliance()(0, 0) * q;
        const double t = (n + 1) * h;
        double exact = 1e-6 * q;
        for (unsigned int m = 0; m < forces.size() && m <= n; ++m)
          if (interpolation == ForceInterpolation::impulse)
            exact += forces[m] * h * g(t - m * h);
          else if (interpolation == ForceInterpolation::constant)
            exact += forces[m] * (step_response(t - m * h) - step_response(t - (m + 1) * h));
          else
            exact += forces[m] / h *
                     (ramp_response(t - m * h) - 2 * ramp_response(t - (m + 1) * h) +
                      ramp_response(t - (m + 2) * h));
        EXPECT_NEAR(u, exact, 1e-17) << method.name << " " << n;
        propagator->advance(&q);
      }
    }
}

// On poles as on modes: the recursion against the steps of q and q' that the transient makes, damped beyond critical too.
TEST(Propagator, ThetaMethodIsThatOfTheTransient)
{
  const double h = 0.004, w = 300;
  const std::vector<double> forces = {3, -1, 4, 1, 5, -9};
  for (const double zeta : {0., 0.1, 1.4})
    for (const double theta : {0.5, 0.53, 1.})
      for (const bool linear : {false, true})
      {
        DenseMatrix trace(1, 1), residual(1, 1);
        trace(0, 0) = 0.5;
        residual(0, 0) = 1e-6;
        const BodyInContact model = by_poles({{w}, {zeta}, trace, {}, residual, {}});
        PropagatorSettings settings;
        settings.time_step = h;
        settings.theta = theta;
        settings.interpolation = linear ? ForceInterpolation::linear : ForceInterpolation::constant;
        const auto propagator = create_propagator("theta method", model, state_at_rest(model), settings);
        const ModalStep step = theta_step(
            w, zeta, theta, h, linear ? ReactionWeighting::as_other_forces : ReactionWeighting::end_of_step);
        double q = 0, v = 0, before = 0, worst = 0, largest = 0;
        for (unsigned int n = 0; n < 60; ++n)
        {
          const double force = n < forces.size() ? forces[n] : 0,
                       u = propagator->free_displacement()[0] + propagator->compliance()(0, 0) * force;
          propagator->advance(&force);
          const double p0 = 0.5 * before, p1 = 0.5 * force,
                       q1 = step.T[0][0] * q + step.T[0][1] * v + step.g0[0] * p0 + step.g1[0] * p1;
          v = step.T[1][0] * q + step.T[1][1] * v + step.g0[1] * p0 + step.g1[1] * p1;
          q = q1;
          before = force;
          worst = std::max(worst, std::abs(u - 0.5 * q - 1e-6 * force));
          largest = std::max(largest, std::abs(u));
        }
        EXPECT_LT(worst, 1e-13 * largest) << zeta << " " << theta << linear;
      }
}

TEST(Propagator, DirectBlockAndModalAreEqual)
{
  for (const unsigned int n_rows : {1u, 3u, 6u, 17u})
    for (const ForceInterpolation interpolation :
         {ForceInterpolation::impulse, ForceInterpolation::constant, ForceInterpolation::linear})
    {
      const BodyInContact model = random_model(n_rows, n_rows == 17 ? 40 : 12, n_rows != 3, 2e-6);
      PropagatorSettings settings;
      settings.time_step = 2e-5;
      settings.interpolation = interpolation;
      settings.n_steps = n_rows == 17 ? 300 : 1500;
      std::vector<std::complex<double>> state = state_in_equilibrium(model);
      state[0] *= 0.3;
      const auto history = [&](const std::string &method) {
        return run(*create_propagator(method, model, state, settings), settings.n_steps, settings.time_step);
      };
      const std::vector<double> modal = history("modal recursion"), direct = history("direct convolution");
      EXPECT_LT(difference(direct, modal), 1e-12) << n_rows;
      EXPECT_LT(difference(direct, history("block convolution")), 1e-12) << n_rows;
    }
}

TEST(Propagator, MemoryOfTheOnePercentRule)
{
  // the paper's oscillator: 3655 steps of 0.1 ms
  DenseMatrix trace(1, 1);
  trace(0, 0) = 1;
  BodyInContact model = by_poles({{std::sqrt(4e5)}, {0.02}, trace, {}, DenseMatrix(), {}});
  EXPECT_NEAR(steps_of_memory(model, 1e-4, 0.01, 100000), 3655, 1);
  EXPECT_EQ(steps_of_memory(model, 1e-4, 0.01, 1000), 1000);
  // what answers at once is not remembered
  model.residual.reinit(1, 1);
  model.residual(0, 0) = 1e-3;
  EXPECT_NEAR(steps_of_memory(model, 1e-4, 0.01, 100000), 3655, 1);
  // without damping nothing is ever forgotten: the whole run, up to the last quarter of a period
  EXPECT_NEAR(
      steps_of_memory(by_poles({{std::sqrt(4e5)}, {0.}, trace, {}, DenseMatrix(), {}}), 1e-4, 0.01, 5000),
      5000, 25);
}

namespace
{
  /// Two masses behind springs S of their own, held closed from a disturbance on: the forces' growth over n steps.
  double growth(const ForceInterpolation interpolation, const double step, const BodyInContact &model,
                const unsigned int n_steps)
  {
    PropagatorSettings settings;
    settings.time_step = step;
    settings.interpolation = interpolation;
    const auto propagator = create_propagator("modal recursion", model, state_at_rest(model), settings);
    DenseMatrix inverse = propagator->compliance();
    inverse.invert();
    double first = 0, last = 0;
    for (unsigned int k = 0; k < n_steps; ++k)
    {
      double q[2], size = 0;
      for (unsigned int i = 0; i < 2; ++i)
      {
        q[i] = 0;
        for (unsigned int j = 0; j < 2; ++j)
          q[i] += inverse(i, j) * ((k == 0 ? 1e-6 * (j + 1.) : 0.) - propagator->free_displacement()[j]);
        size = std::max(size, std::abs(q[i]));
      }
      propagator->advance(q);
      first = k == 0 ? size : first;
      last = size;
    }
    return last / first;
  }
} // namespace

TEST(Propagator, LongestStep)
{
  // a rigid translation and a rotation of two points; the softer combination of both decides, no point by itself
  DenseMatrix trace(2, 2), S(2, 2);
  trace(0, 0) = trace(1, 0) = 1;
  trace(0, 1) = 0.5;
  trace(1, 1) = -0.5;
  S(0, 0) = S(1, 1) = 1e-6;
  const BodyInContact model = by_poles({{100., 150.}, {0.02, 0.02}, trace, {}, S, {}}),
                      rigid = by_poles({{100., 150.}, {0.02, 0.02}, trace, {}, DenseMatrix(2, 2), {}});
  const DenseMatrix slope = initial_derivative(model, 1);
  EXPECT_EQ(critical_time_step(S, slope, ForceInterpolation::impulse),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(critical_time_step(S, slope, ForceInterpolation::constant),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(critical_time_step(DenseMatrix(2, 2), slope, ForceInterpolation::constant), 0);
  EXPECT_EQ(critical_time_step(DenseMatrix(2, 2), slope, ForceInterpolation::linear), 0);
  // both together: g'(0) of the translation is (1, 1; 1, 1), eigenvalue 2
  const double longest = critical_time_step(S, slope, ForceInterpolation::linear);
  EXPECT_NEAR(longest / (2.7 * std::sqrt(1e-6 / 2)), 1, 1e-12);
  // the motion itself: bounded below, growing above sqrt(12) sqrt(S / g'(0))
  EXPECT_LT(growth(ForceInterpolation::linear, longest, model, 400), 1);
  EXPECT_GT(growth(ForceInterpolation::linear, 1.35 * longest, model, 400), 1e3);
  EXPECT_LT(growth(ForceInterpolation::constant, 10 * longest, model, 400), 1);
  EXPECT_GT(growth(ForceInterpolation::linear, 1e-4, rigid, 40), 1e3);
}

TEST(ActiveSet, AgreesWithNewton)
{
  for (const unsigned int n : {1u, 2u, 3u, 4u, 5u, 30u})
  {
    const BodyInContact model = random_model(n, 40, n == 3 || n == 30, 3e-6);
    PropagatorSettings settings;
    settings.time_step = 5e-5;
    settings.interpolation = ForceInterpolation::constant;
    const DenseMatrix matrix =
        create_propagator("modal recursion", model, state_at_rest(model), settings)->compliance();
    ContactProblem problem = road_contact_problem(matrix, n, {}, settings.time_step);
    ActiveSetSolver fast;
    ContactSolverParameters parameters;
    parameters.tolerance = 1e-13;
    NewtonSolver common(parameters);
    ContactSolution solution, found;
    double residual = 0;
    unsigned int corrections = 0;
    for (unsigned int step = 0; step < 200; ++step)
    {
      for (unsigned int i = 0; i < n; ++i)
        problem.b[i] = 1e-4 * std::sin(0.1 * step + 0.7 * i) + 3e-5 * std::cos(2.3 * step * i);
      fast.solve(problem, found);
      residual = std::max(residual, found.residual);
      corrections += found.iterations;
      common.solve(problem, solution);
      double size = 0;
      for (unsigned int i = 0; i < n; ++i)
        size = std::max(size, std::abs(solution.R[i]));
      for (unsigned int i = 0; i < n; ++i)
      {
        EXPECT_NEAR(found.R[i], solution.R[i], 1e-12 * size) << n << " points, step " << step;
        EXPECT_GE(found.y[i], -1e-17);
        EXPECT_EQ(found.y[i] * found.R[i], 0);
      }
    }
    // that of one point is no number to speak of; the closed set of the step before is right in most steps
    EXPECT_LT(residual, 1e-12) << n;
    if (n > 1)
    {
      EXPECT_GT(residual, 0) << n;
      EXPECT_GT(corrections, 0) << n;
    }
    if (n == 3)
      EXPECT_LT(corrections, 200);
  }
}

namespace
{
  /// unit diagonal and a kernel that turns and falls, not the same to both sides
  DenseMatrix even_line(const unsigned int n, const double coupling)
  {
    DenseMatrix matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        const double distance = double(i) - double(j);
        matrix(i, j) = (i == j) + coupling * std::cos(0.1 * distance) * std::exp(-0.05 * std::abs(distance)) +
                       coupling * std::sin(0.03 * distance) * std::exp(-0.1 * std::abs(distance));
      }
    return matrix;
  }

  std::vector<unsigned int> places_of(const DenseVector &values)
  {
    std::vector<unsigned int> places;
    for (unsigned int i = 0; i < values.size(); ++i)
      if (values[i] != 0)
        places.push_back(i);
    return places;
  }
} // namespace

TEST(EvenLine, ProductsAreThoseOfTheMatrix)
{
  const unsigned int n = 200;
  const DenseMatrix matrix = even_line(n, 0.01);
  const auto line = EvenLineOperator::of(matrix);
  ASSERT_TRUE(line);
  std::vector<unsigned int> some = {3, 70, 71, 199};
  DenseMatrix block;
  line->extract(some, block);
  for (unsigned int i = 0; i < some.size(); ++i)
    for (unsigned int j = 0; j < some.size(); ++j)
      EXPECT_NEAR(block(i, j), matrix(some[i], some[j]), 1e-15);
  // sources at either end, all over and none
  for (const auto &[begin, end] : {std::pair(0u, 5u), {190u, 200u}, {97u, 98u}, {0u, 200u}, {7u, 7u}})
  {
    DenseVector R(n), product, exact(n);
    for (unsigned int i = begin; i < end; ++i)
      R[i] = std::sin(1. + i);
    line->vmult(product, R, places_of(R));
    matrix.vmult(exact, R);
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_NEAR(product[i], exact[i], 1e-14) << begin << " " << i;
  }
  DenseMatrix other = matrix;
  other(17, 90) += 1e-9;
  EXPECT_FALSE(EvenLineOperator::of(other));
}

TEST(EvenLine, FactorIsThatOfTheWorstErrors)
{
  // power iteration of what a step leaves of an error, on a part of the line
  const unsigned int n = 200;
  for (const double coupling : {1e-3, 0.01, 0.03})
  {
    const DenseMatrix matrix = even_line(n, coupling);
    const double factor = EvenLineOperator::of(matrix)->jacobi_factor();
    DenseVector error(n), left(n), image(n);
    for (unsigned int i = 0; i < n; ++i)
      error[i] = std::sin(1. + i * i);
    double longest = 0;
    for (unsigned int k = 0; k < 200; ++k)
    {
      error /= error.l2_norm();
      // transposed after it: singular values
      matrix.vmult(image, error);
      left = error;
      left.add(-1 / matrix(0, 0), image);
      longest = left.l2_norm();
      matrix.Tvmult(image, left);
      error = left;
      error.add(-1 / matrix(0, 0), image);
    }
    EXPECT_LE(longest, factor * (1 + 1e-6));
    EXPECT_GT(longest, 0.8 * factor);
    EXPECT_LT(factor, 30 * coupling);
  }
}

TEST(ProjectedJacobi, AgreesWithTheActiveSet)
{
  const unsigned int n = 200;
  ContactProblem dense = road_contact_problem(even_line(n, 2e-3), n, {}, 1.), products = dense;
  products.A = EvenLineOperator::of(even_line(n, 2e-3));
  EXPECT_TRUE(ProjectedJacobi::takes(products));
  EXPECT_FALSE(ActiveSetSolver::takes(products));
  EXPECT_FALSE(ProjectedJacobi::takes(dense));
  ActiveSetSolver direct;
  ProjectedJacobi iterated;
  ContactSolution exact, found;
  for (unsigned int step = 0; step < 60; ++step)
  {
    // lifted off at last
    for (unsigned int i = 0; i < n; ++i)
      dense.b[i] = products.b[i] =
          std::pow((i - 100.) / 60, 2) - 0.5 + 0.2 * std::sin(0.3 * step + 0.2 * i) + (step > 55) * 2.;
    direct.solve(dense, exact);
    iterated.solve(products, found);
    EXPECT_TRUE(found.converged);
    EXPECT_LT(found.iterations, 12u);
    double difference = 0, size = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      difference += std::pow(found.R[i] - exact.R[i], 2);
      size += std::pow(exact.R[i], 2);
      EXPECT_NEAR(found.y[i], exact.y[i], 1e-8);
      EXPECT_EQ(found.y[i] * found.R[i], 0);
    }
    EXPECT_LE(std::sqrt(difference), 1e-10 * std::sqrt(size)) << step;
    EXPECT_EQ(size > 0, step <= 55);
  }
  products.b[3] = std::nan("");
  EXPECT_THROW(iterated.solve(products, found), ConvergenceError);
}

TEST(ThinProduct, FewShapesGiveTheSame)
{
  // shapes that turn slowly from row to row, amplitudes of any size
  const unsigned int n = 120, m = 90;
  DenseMatrix right(n, m), left(n, m), uneven(n, m);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int k = 0; k < m; ++k)
    {
      const double size = std::pow(10., k % 7 - 3.);
      right(i, k) = size * std::sin(0.002 * k * i + k);
      left(i, k) = std::cos(0.002 * k * i - k) / size;
      uneven(i, k) = std::sin(i * i + 3. * k * k);
    }
  for (const auto &[one, other] : {std::pair(right, left), {uneven, uneven}})
  {
    RowsAndStates through = rows_and_states(one, other);
    std::vector<double> states(padded(m), 0.), forces(n, 0.), u(padded(n), 1.);
    for (unsigned int k = 0; k < m; ++k)
      states[k] = std::sin(5. + k) * std::pow(10., 3. - k % 7);
    for (unsigned int i = 30; i < 60; ++i)
      forces[i] = std::cos(3. + i);
    std::vector<double> after = states;
    through.show.add_to(u.data(), states.data());
    through.load.add_sparse_to(after.data(), forces.data());
    for (unsigned int i = 0; i < n; ++i)
    {
      double exact = 1, size = 0;
      for (unsigned int k = 0; k < m; ++k)
      {
        exact += one(i, k) * states[k];
        size += std::abs(one(i, k) * states[k]);
      }
      EXPECT_NEAR(u[i], exact, 1e-11 * size);
    }
    for (unsigned int k = 0; k < m; ++k)
    {
      double exact = states[k], largest = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        exact += other(i, k) * forces[i];
        largest = std::max(largest, std::abs(other(i, k)));
      }
      EXPECT_NEAR(after[k], exact, 1e-12 * (30 * largest + std::abs(exact)));
    }
  }
}

TEST(ActiveSet, RefusesWhatIsNotPositiveDefinite)
{
  DenseMatrix matrix(2, 2);
  matrix(0, 0) = matrix(1, 1) = 1;
  matrix(0, 1) = matrix(1, 0) = 1.1;
  EXPECT_THROW(ActiveSetSolver().prepare(road_contact_problem(matrix, 2, {}, 1)), InputError);
  matrix(0, 1) = -1.1; // a rotation beside the identity
  EXPECT_NO_THROW(ActiveSetSolver().prepare(road_contact_problem(matrix, 2, {}, 1)));
}

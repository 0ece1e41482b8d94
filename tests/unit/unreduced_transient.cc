// The transient on unreduced finite elements: the operator of its step against a dense factorisation of the elements'
// matrices, the bouncing bar in closed form, growth against the eigenvalues of the elements, and what a reduction to
// few modes changes.

#include "element_scene.h"
#include "one_oscillation.h"
#include "pi.h"

#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/coupled_bodies/finite_element_pair.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/numerics/null_space.h>

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

using namespace vibrocontact;

namespace
{
  TransientParameters end_of_step(const double theta, const double step, const double end)
  {
    TransientParameters p;
    p.model = "finite elements";
    p.reaction = "end of step";
    p.theta = theta;
    p.time_step = step;
    p.end_time = end;
    return p;
  }

  /// of the processor per step
  double microseconds(const std::clock_t began, const TransientResult &result)
  {
    return 1e6 * (std::clock() - began) / CLOCKS_PER_SEC / result.steps;
  }
} // namespace

// A = h^2 theta P D^-1 P^T in the gaps, V d/dx of it and h P D^-1 P^T in the slip; D = M + h theta C + h^2 theta^2 K;
// and a step without contact, D v1 = (M - h (1 - theta) C - h^2 theta (1 - theta) K) v0 - h K u0.
TEST(UnreducedTransientMpi, StepIsThatOfTheElements)
{
  LayerParameters layer;
  layer.divisions_x = 5;
  layer.divisions_z = 3;
  const auto scene = layer_scene(layer, soft(), 9);
  for (unsigned int k = 0; k < 9; ++k)
    scene->pair.damping_ratio.at(k) = scene->all.damping_ratio.at(k) = 0.02 + 0.01 * k;
  const InertialPair elements = finite_element_pair({{scene->system.get(), &scene->modes}, {}}, scene->pair);
  const unsigned int N = elements.mass.m(), n = scene->pair.n_points();
  ASSERT_EQ(scene->all.n_modes(), N);
  const CreepScheme &scheme = creep_schemes().front();
  const double speed = 3;
  // the modes themselves: U = Phi q, q = Phi^T M U
  const DenseSystem dense = dense_system(*scene->system);
  const DenseMatrix Phi =
      dense_vectors(*scene->system, dense, all_modes(*scene->system, scene->modes).shapes);
  for (const double theta : {0.5, 1.})
    for (const double h : {1e-7, 1e-5, 1e-3})
    {
      DenseMatrix D = elements.mass;
      D.add(h * theta, elements.damping);
      D.add(h * h * theta * theta, elements.stiffness);
      D.compute_lu_factorization();
      DenseMatrix response(N, 3 * n);
      for (unsigned int i = 0; i < 3 * n; ++i)
        for (unsigned int j = 0; j < N; ++j)
          response(j, i) = elements.trace(i, j);
      D.solve(response);
      const DenseMatrix S = product(elements.trace, response);
      DenseMatrix expected = S;
      expected *= h * h * theta;
      convert_to_slip_rows(scene->all.interface.contacts.only(), scheme, speed, expected);
      for (unsigned int j = 0; j < 3 * n; ++j)
        for (unsigned int i = n; i < 3 * n; ++i)
          expected(i, j) += h * S(i, j);

      std::vector<ModalStep> steps;
      for (unsigned int k = 0; k < N; ++k)
        steps.push_back(theta_step(scene->all.omega[k], scene->all.damping_ratio[k], theta, h,
                                   ReactionWeighting::end_of_step));
      const StepMatrices matrices = step_matrices(scheme, scene->all, steps, h, speed);
      // gaps and slips have their own units; across the plane nothing moves
      double worst = 0;
      for (unsigned int row = 0; row < 2; ++row)
        for (unsigned int column = 0; column < 2; ++column)
        {
          double largest = 0, difference = 0;
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i)
            {
              const double value = expected(row * n + i, column * n + j);
              largest = std::max(largest, std::abs(value));
              difference =
                  std::max(difference, std::abs(matrices.response(row * n + i, column * n + j) - value));
            }
          worst = std::max(worst, difference / largest);
        }
      EXPECT_LT(worst, 1e-9) << theta << " " << h;

      DenseVector u(N), v(N), q(N), w(N), rhs(N), help(N);
      for (unsigned int i = 0; i < N; ++i)
      {
        u[i] = std::sin(1. + 3 * i);
        v[i] = std::cos(2. + 5 * i) / h;
      }
      elements.mass.vmult(help, u);
      Phi.Tvmult(q, help);
      elements.mass.vmult(rhs, v);
      Phi.Tvmult(w, rhs);
      elements.damping.vmult(help, v);
      rhs.add(-h * (1 - theta), help);
      elements.stiffness.vmult(help, v);
      rhs.add(-h * h * theta * (1 - theta), help);
      elements.stiffness.vmult(help, u);
      rhs.add(-h, help);
      D.solve(rhs);
      for (unsigned int k = 0; k < N; ++k)
        q[k] = steps[k].T[1][0] * q[k] + steps[k].T[1][1] * w[k];
      Phi.vmult(help, q);
      help -= rhs;
      EXPECT_LT(help.linfty_norm(), 1e-9 * (rhs.linfty_norm() + v.linfty_norm())) << theta << " " << h;
      std::printf("theta %.1f, h %.0e s: operator of the step %.1e, free step %.1e off\n", theta, h, worst,
                  help.linfty_norm() / v.linfty_norm());
    }
}

namespace
{
  struct Bounce
  {
    double impulse, energy, penetration, peak, rebound, microseconds;
  };

  Bounce bounce(const ContactPair &pair, TransientParameters parameters)
  {
    parameters.initial_state = "undeformed";
    parameters.initial_gap = 5;
    parameters.initial_velocity = -10;
    ContactParameters contact;
    contact.friction = 0;
    const DriveFunction drive = [](double)
    {
      Drive d;
      d.creepage.speed = 0;
      return d;
    };
    DynamicState state = initial_state(parameters, contact, {}, pair, drive(0));
    double peak = 0;
    const std::clock_t began = std::clock();
    const TransientResult result = transient(parameters, contact, {}, pair, drive, state,
                                             [&](const DynamicState &s, const TransientResult &)
                                             {
                                               peak = std::max(peak, s.R[0]);
                                               return true;
                                             });
    EXPECT_TRUE(result.converged) << result.message;
    return {result.impulse / 200 - 1,
            result.energy.stored / result.energy.initial - 1,
            -result.smallest_gap,
            peak / 300,
            state.v[0] / (10 * pair.participation(0, 2)),
            microseconds(began, result)};
  }
} // namespace

// Exact: contact from 0.5 to 1.16667 s, force 300, impulse 200, rebound 10, energy kept. Siconos, Moreau-Jean 1/2, 100 elements:
// impulse 0.6 % off, energy 0.33 %, penetration 5e-3.
TEST(UnreducedTransientMpi, BouncingBar)
{
  std::printf("%-28s %6s %9s  %10s %10s %10s %8s %9s %9s\n", "", "theta", "step", "impulse", "energy",
              "penetrat.", "peak/300", "rebound", "us/step");
  const auto show =
      [](const std::string &what, const ContactPair &pair, const TransientParameters &parameters)
  {
    const Bounce b = bounce(pair, parameters);
    std::printf("%-28s %6.2f %9.1e  %+10.2e %+10.2e %10.2e %8.3f %9.4f %9.2f\n", what.c_str(),
                parameters.theta, parameters.time_step, b.impulse, b.energy, b.penetration, b.peak, b.rebound,
                b.microseconds);
    return b;
  };
  std::vector<double> impulses;
  for (const unsigned int divisions : {50, 100, 200})
  {
    const auto scene = bar_scene(divisions, 1, 20);
    ASSERT_EQ(scene->all.n_modes(), divisions + 1);
    for (const double theta : {0.5, 0.6, 1.})
      for (const double h :
           divisions == 100 ? std::vector<double>{2e-3, 1e-3, 5e-4} : std::vector<double>{0.1 / divisions})
      {
        const Bounce b =
            show(std::to_string(divisions) + " linear elements", scene->all, end_of_step(theta, h, 1.5));
        EXPECT_LT(b.penetration, 1e-10);
        EXPECT_LT(b.energy, 1e-9);
        if (theta == 0.5)
          EXPECT_GT(b.energy, -0.015);
        if (h == 0.1 / divisions)
          impulses.push_back(std::abs(b.impulse));
      }
    if (divisions == 100)
    {
      TransientParameters ringing = end_of_step(0.5, 1e-3, 1.5);
      ringing.reaction = "as other forces";
      EXPECT_GT(show("as other forces", scene->all, ringing).peak, 20);
    }
  }
  // theta 1/2 with 100 elements; theta 1 damps; both tend to the exact impulse with mesh and step
  EXPECT_LT(impulses[3], 8e-3);
  EXPECT_GT(impulses[5], impulses[3]);
  EXPECT_LT(impulses[6], 0.8 * impulses[0]);
  EXPECT_LT(impulses[8], 0.8 * impulses[2]);

  const auto shipped = bar_scene(40, 4, 20);
  TransientParameters parameters = end_of_step(0.5, 1e-3, 1.5);
  show("40 elements of degree 4", shipped->all, parameters);
  show("their 20 modes, end of step", shipped->pair, parameters);
  parameters.reaction = "as other forces";
  EXPECT_LT(std::abs(show("their 20 modes", shipped->pair, parameters).impulse), 1e-3);
}

namespace
{
  /// The layer pressed down by 0.02 mm and dragged at 0.1 m/s, friction 0.2, at rest in that frame.
  struct SlidingLayer
  {
    ContactParameters contact;
    ContactSolverParameters solver;
    RollingEquilibrium equilibrium;
    DynamicState rest;

    explicit SlidingLayer(const ContactPair &pair)
    {
      contact.friction = 0.2;
      solver.tolerance = 1e-11;
      rest = initial_state({}, contact, solver, pair, drive(0));
      equilibrium.contact = rest.contact;
      equilibrium.friction.assign(pair.n_points(), contact.friction);
      equilibrium.speed = 0;
    }

    static Drive drive(double)
    {
      Drive d;
      d.creepage.speed = 0;
      d.creepage.sliding_x = 0.1;
      d.approach = 2e-5;
      return d;
    }
  };

  /// Growth and frequency of a transient that starts in the shape of a root.
  std::complex<double> growth_in_time(const ContactPair &pair, const SlidingLayer &layer,
                                      const StabilityRoot &root, TransientParameters parameters)
  {
    const std::complex<double> lambda(root.growth, 2 * pi * root.frequency);
    parameters.end_time = std::max(1 / root.growth, 20 / root.frequency);
    const unsigned int k =
        std::find(pair.labels.begin(), pair.labels.end(), root.label) - pair.labels.begin();
    const unsigned int every = std::max(1l, std::lround(0.1 / root.frequency / parameters.time_step));
    DynamicState state = layer.rest;
    double largest = 0;
    for (unsigned int i = 0; i < pair.n_modes(); ++i)
      largest = std::max(largest, std::abs(state.q[i]));
    const double amplitude = 1e-4 * largest / std::abs(root.shape[k]);
    for (unsigned int i = 0; i < pair.n_modes(); ++i)
    {
      state.q[i] += amplitude * root.shape[i].real();
      state.v[i] += amplitude * (lambda * root.shape[i]).real();
    }
    std::vector<double> samples;
    unsigned int count = 0;
    const std::clock_t began = std::clock();
    const TransientResult result =
        transient(parameters, layer.contact, layer.solver, pair, SlidingLayer::drive, state,
                  [&](const DynamicState &now, const TransientResult &)
                  {
                    if (++count % every == 0)
                      samples.push_back(now.v[k]);
                    return true;
                  });
    EXPECT_TRUE(result.converged) << result.message;
    EXPECT_EQ(result.fallbacks, 0u);
    const std::complex<double> measured = fit_one_oscillation(samples, every * parameters.time_step);
    std::printf("%-16s theta %.2f step %.1e s: %9.3f Hz %9.3f 1/s, root %9.3f Hz %9.3f 1/s: %+.2e %+.2e; "
                "%.1f us/step\n",
                parameters.reaction.c_str(), parameters.theta, parameters.time_step, measured.imag() / 2 / pi,
                measured.real(), root.frequency, root.growth, measured.imag() / (2 * pi * root.frequency) - 1,
                measured.real() / root.growth - 1, microseconds(began, result));
    return measured;
  }

  const StabilityRoot &fastest(const std::vector<StabilityRoot> &roots)
  {
    return *std::max_element(roots.begin(), roots.end(),
                             [](const auto &a, const auto &b) { return a.growth < b.growth; });
  }

  const StabilityRoot &lowest_unstable(const std::vector<StabilityRoot> &roots)
  {
    return *std::find_if(roots.begin(), roots.end(), [](const auto &root) { return root.growth > 1; });
  }
} // namespace

TEST(UnreducedTransientMpi, GrowthOfTheLayerIsTheRootOfItsElements)
{
  LayerParameters parameters;
  parameters.divisions_x = 8;
  parameters.divisions_z = 4;
  const auto scene = layer_scene(parameters, soft(), 20);
  const SlidingLayer layer(scene->all);
  const CreepScheme &scheme = find_creep_scheme(layer.contact.creep_scheme);
  const std::vector<StabilityRoot> truth = inertial_roots(
                                       finite_element_pair({{scene->system.get(), &scene->modes}, {}},
                                                           scene->pair),
                                       scheme, layer.equilibrium, {}),
                                   roots = inertial_roots(inertial_pair(scene->all), scheme,
                                                          layer.equilibrium, {});
  ASSERT_EQ(truth.size(), roots.size());
  for (const auto choose : {fastest, lowest_unstable})
  {
    const StabilityRoot &root = choose(roots), &expected = choose(truth);
    EXPECT_NEAR(root.growth / expected.growth, 1, 1e-6);
    EXPECT_NEAR(root.frequency / expected.frequency, 1, 1e-9);
    std::complex<double> measured;
    for (const double h : {4e-7, 2e-7, 1e-7})
      measured = growth_in_time(scene->all, layer, root, end_of_step(0.5, h, 0));
    EXPECT_NEAR(measured.real() / expected.growth, 1, 1e-2);
    EXPECT_NEAR(measured.imag() / (2 * pi * expected.frequency), 1, 1e-3);
  }
  // the same in the reduced model
  const SlidingLayer reduced(scene->pair);
  const std::vector<StabilityRoot> of_modes =
      stability_roots(scene->pair, linearised_contact(scene->pair, scheme, reduced.equilibrium, {}));
  for (const auto choose : {fastest, lowest_unstable})
  {
    std::complex<double> measured;
    TransientParameters p;
    for (const double h : {4e-7, 2e-7})
    {
      p.time_step = h;
      measured = growth_in_time(scene->pair, reduced, choose(of_modes), p);
    }
    EXPECT_NEAR(measured.real() / choose(of_modes).growth, 1, 1e-2);
  }
}

namespace
{
  struct History
  {
    std::vector<double> normal, tangential;
    double microseconds = 0;
  };

  /// The sliding layer is pressed 10 % deeper and let go, 5000 times a second; forces at the ends of each microsecond.
  History pressed(const ContactPair &pair, TransientParameters parameters, const double end)
  {
    const SlidingLayer layer(pair);
    parameters.end_time = end;
    const double w = 2 * pi * 5000, depth = 2e-6;
    const DriveFunction drive = [=](const double t)
    {
      Drive d = SlidingLayer::drive(t);
      d.approach += depth * (1 - std::cos(w * t)) / 2;
      d.hub_acceleration = depth * w * w * std::cos(w * t) / 2;
      return d;
    };
    DynamicState state = initial_state(parameters, layer.contact, layer.solver, pair, drive(0));
    const unsigned int every = std::lround(1e-6 / parameters.time_step), n = pair.n_points();
    History history;
    unsigned int count = 0;
    const std::clock_t began = std::clock();
    const TransientResult result = transient(parameters, layer.contact, layer.solver, pair, drive, state,
                                             [&](const DynamicState &now, const TransientResult &)
                                             {
                                               if (++count % every == 0)
                                               {
                                                 double N = 0, T = 0;
                                                 for (unsigned int i = 0; i < n; ++i)
                                                 {
                                                   N += now.R[i];
                                                   T += now.R[n + i];
                                                 }
                                                 history.normal.push_back(N);
                                                 history.tangential.push_back(T);
                                               }
                                               return true;
                                             });
    EXPECT_TRUE(result.converged) << result.message;
    history.microseconds = microseconds(began, result);
    return history;
  }

  /// rms of the difference over rms of the variation
  double distance(const std::vector<double> &a, const std::vector<double> &truth)
  {
    double mean = 0, difference = 0, variation = 0;
    for (const double value : truth)
      mean += value / truth.size();
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      difference += std::pow(a.at(i) - truth[i], 2);
      variation += std::pow(truth[i] - mean, 2);
    }
    return std::sqrt(difference / variation);
  }
} // namespace

TEST(UnreducedTransientMpi, ReducedForcesTendToThoseOfTheElements)
{
  const double end = 4e-4, h = 1e-7;
  LayerParameters parameters;
  std::vector<double> errors;
  History truth;
  for (const unsigned int n_modes : {80, 40, 20, 10, 5})
  {
    const auto scene = layer_scene(parameters, soft(), n_modes);
    if (errors.empty())
    {
      truth = pressed(scene->all, end_of_step(0.5, h / 4, end), end);
      for (const double step : {5 * h, h})
      {
        const History own = pressed(scene->all, end_of_step(0.5, step, end), end);
        std::printf("%4u modes (all) theta 0.5, step %.1e s: N %.2e, %.1f us/step\n", scene->all.n_modes(),
                    step, distance(own.normal, truth.normal), own.microseconds);
        EXPECT_LT(distance(own.normal, truth.normal), step == h ? 2e-3 : 5e-2);
      }
      const History damped = pressed(scene->all, end_of_step(1, h, end), end);
      std::printf("%4u modes (all) theta 1, step %.1e s: N %.2e, %.1f us/step\n", scene->all.n_modes(), h,
                  distance(damped.normal, truth.normal), damped.microseconds);
      EXPECT_LT(distance(damped.normal, truth.normal), 5e-2);
    }
    TransientParameters p;
    p.time_step = h;
    const History reduced = pressed(scene->pair, p, end);
    errors.push_back(distance(reduced.normal, truth.normal));
    std::printf("%4u modes, step %.1e s: N %.2e, T %.2e, %.1f us/step\n", scene->pair.n_modes(), h,
                errors.back(), distance(reduced.tangential, truth.tangential), reduced.microseconds);
  }
  EXPECT_LT(errors.front(), 0.05);
  EXPECT_LT(errors.front(), 0.2 * errors.back());
}

TEST(NullSpace, OfMoreColumnsThanRowsOrDependentOnesThereIsNone)
{
  DenseMatrix columns(3, 2);
  columns(0, 0) = columns(1, 1) = columns(2, 1) = 1;
  const auto basis = null_space(columns, 3);
  ASSERT_TRUE(basis);
  ASSERT_EQ(basis->n(), 1u);
  EXPECT_NEAR(std::abs((*basis)(1, 0)), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR((*basis)(1, 0) + (*basis)(2, 0), 0, 1e-14);
  EXPECT_NEAR((*basis)(0, 0), 0, 1e-14);
  columns(0, 1) = 1;
  columns(1, 0) = columns(2, 0) = 1;
  EXPECT_FALSE(null_space(columns, 3));
  EXPECT_FALSE(null_space(DenseMatrix(2, 3), 2));
  EXPECT_EQ(null_space(DenseMatrix(), 4)->n(), 4u);
}

// Time steps that settle on a periodic motion against a rigid stop: second order against shooting, a plateau without penetration;
// one reduced body by every analysis that can move it.

#include "axial_bar.h"

#include <vibrocontact/analyses/periodic/periodic_motion.h>
#include <vibrocontact/analyses/periodic/shooting.h>
#include <vibrocontact/contact/laws/normal_laws.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/propagators/propagator_types.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace vibrocontact;

namespace
{
  ForcedBody without_relaxation(ForcedBody body)
  {
    body.relaxation = 0;
    return body;
  }

  /// Body 1 above a rigid plane: heights are displacements away from the stop, -u.
  ContactPair pair_of(const ForcedBody &body)
  {
    ContactPair pair;
    ContactGrid &grid = pair.interface.contacts.only();
    grid.n_x = grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = 1;
    pair.interface.gap = body.gap;
    const unsigned int n = body.n_modes();
    pair.omega = body.omega;
    pair.damping_ratio = body.damping_ratio;
    pair.labels.assign(n, "bar:mode");
    pair.body.assign(n, 1);
    pair.modal_load.assign(n, 0.);
    pair.participation.reinit(n, 3);
    pair.trace.reinit(3, n);
    for (unsigned int k = 0; k < n; ++k)
      pair.trace(0, k) = body.trace(0, k);
    pair.residual.reinit(3, 3);
    for (unsigned int i = 0; i < 3; ++i)
      pair.residual(i, i) = body.residual(0, 0);
    pair.force_residual = {body.residual_force(0), 0., 0.};
    if (body.relaxation > 0)
      pair.relaxing = {{1, body.relaxation, pair.residual}};
    return pair;
  }

  struct Period
  {
    /// of the tip towards the stop [m], contact force [N] at the phases k / n, k = 1..n
    std::vector<double> displacement, force;
    /// rms change over the last period over the rms
    double change = 0;
  };

  /// Steps from rest until the motion repeats.
  Period settled(const ForcedBody &body, const AxialBarCase &c, const std::string &integrator,
                 const unsigned int per_period, const double theta = 0.5)
  {
    const ContactPair pair = pair_of(body);
    TransientParameters parameters;
    parameters.integrator = integrator;
    parameters.theta = theta;
    parameters.time_step = 1 / c.frequency / per_period;
    parameters.end_time = 300 / c.frequency;
    parameters.initial_state = "undeformed";
    ContactParameters contact;
    contact.friction = 0;
    const DriveFunction drive = [&](const double t)
    {
      Drive now;
      now.creepage.speed = 0;
      now.force = -AxialBarCase::force * std::sin(2 * M_PI * c.frequency * t);
      return now;
    };
    DynamicState state = initial_state(parameters, contact, {}, pair, drive(0));
    Period now, before;
    const TransientResult result =
        transient(parameters, contact, {}, pair, drive, state,
                  [&](const DynamicState &s, const TransientResult &)
                  {
                    now.displacement.push_back(body.gap[0] - s.contact.y[0]);
                    now.force.push_back(s.R[0]);
                    if (now.force.size() < per_period)
                      return true;
                    if (!before.force.empty())
                      now.change = relative_error(before.displacement, now.displacement);
                    const bool goes_on = before.force.empty() || now.change > 1e-10;
                    before = now;
                    now = {};
                    return goes_on;
                  });
    EXPECT_TRUE(result.converged);
    EXPECT_LT(before.change, 1e-8);
    return before;
  }

  Period sampled(const ShootingSolution &reference, const unsigned int n)
  {
    Period period;
    for (unsigned int k = 1; k <= n; ++k)
    {
      const MotionSample s = reference.at(double(k) / n);
      period.displacement.push_back(s.displacement);
      period.force.push_back(s.force);
    }
    return period;
  }
} // namespace

TEST(PeriodicInTime, ThetaMethodIsOfSecondOrder)
{
  for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
  {
    const ForcedBody body = without_relaxation(axial_bar(c, true));
    const ShootingSolution reference = shoot(body, create_normal_law("signorini"), c.excitation());
    std::vector<double> errors;
    for (const unsigned int n : {512u, 1024u, 2048u, 4096u})
    {
      const Period found = settled(body, c, "theta method", n), exact = sampled(reference, n);
      errors.push_back(relative_error(found.displacement, exact.displacement));
      double penetration = 0, force = 0;
      unsigned int closed = 0;
      for (unsigned int k = 0; k < n; ++k)
        if (found.force[k] > 0)
        {
          penetration = std::max(penetration, std::abs(found.displacement[k] - c.gap));
          force = std::max(force, found.force[k]);
          ++closed;
        }
      EXPECT_GT(closed, n / 20);
      EXPECT_LT(penetration, 1e-13 * c.linear_amplitude);
      std::printf("%4.0f Hz, %4u steps: tip %.3e, force %.3e, largest force %.5g N, plateau of %u steps flat "
                  "to %.1e m\n",
                  c.frequency, n, errors.back(), relative_error(found.force, exact.force), force, closed,
                  penetration);
    }
    for (unsigned int k = 1; k < errors.size(); ++k)
      EXPECT_GT(std::log2(errors[k - 1] / errors[k]), 1.7) << c.frequency;
    EXPECT_LT(errors.back(), 1e-3);
  }
}

class OneBody : public testing::TestWithParam<bool>
{
};

// Six modes and the static answers of the others, at once or relaxing as the bar's stiffness does.
TEST_P(OneBody, ByEveryAnalysis)
{
  for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
  {
    const ForcedBody whole = axial_bar(c, true),
                     body = with_modes(GetParam() ? whole : without_relaxation(whole), 6, true);
    const ShootingSolution reference = shoot(body, create_normal_law("signorini"), c.excitation());
    constexpr unsigned int n = 2048;
    const Period exact = sampled(reference, n);
    const auto compare = [&](const char *const name, const Period &found, const double largest)
    {
      const double error = relative_error(found.displacement, exact.displacement);
      std::printf("%4.0f Hz, %-18s tip %.3e, force %.3e\n", c.frequency, name, error,
                  relative_error(found.force, exact.force));
      EXPECT_LT(error, largest) << name << c.frequency;
    };
    // what relaxes goes by a difference of first order
    const double limit = GetParam() ? 2e-4 : 1e-4;
    compare("theta method", settled(body, c, "theta method", n), limit);
    compare("exact propagator", settled(body, c, "exact propagator", n), limit);

    // Green's functions: the exciting force acts where the contact's does
    PropagatorSettings response_settings;
    const double h = response_settings.time_step = 1 / c.frequency / n;
    response_settings.interpolation = ForceInterpolation::linear;
    response_settings.n_steps = 300 * n;
    const BodyInContact model = by_poles(body);
    for (const std::string method : {"modal recursion", "theta method", "block convolution"})
    {
      const std::clock_t begin = std::clock();
      const auto propagator = create_propagator(method, model, state_at_rest(model), response_settings);
      const double compliance = propagator->compliance()(0, 0);
      Period last;
      for (unsigned int k = 1; k <= 300 * n; ++k)
      {
        const double excitation = -AxialBarCase::force * std::sin(2 * M_PI * c.frequency * k * h),
                     free = propagator->free_displacement()[0] + compliance * excitation,
                     force = std::max(0., -(c.gap + free) / compliance), q = force + excitation;
        propagator->advance(&q);
        if (k <= 299 * n)
          continue;
        last.displacement.push_back(-(free + compliance * force));
        last.force.push_back(force);
      }
      std::printf("%.0f ns a step; ", 1e9 * (std::clock() - begin) / CLOCKS_PER_SEC / (300. * n));
      compare(method.c_str(), last, limit);
    }

    BalanceSettings settings;
    settings.n_functions = 255;
    settings.n_samples = 16384;
    PeriodicBalance balance(body, create_normal_law("signorini"), settings);
    balance.set_force(c.excitation());
    const PeriodicSolution solution = balance.solve();
    EXPECT_TRUE(solution.converged);
    const PeriodicMotion motion = sample_motion(balance, solution, n);
    Period fourier{motion.points[0].displacement, motion.points[0].contact_force};
    // phases 1/n to 1 in place of 0 to 1 - 1/n
    std::rotate(fourier.displacement.begin(), fourier.displacement.begin() + 1, fourier.displacement.end());
    std::rotate(fourier.force.begin(), fourier.force.begin() + 1, fourier.force.end());
    compare("Fourier, 255", fourier, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(PeriodicInTime, OneBody, testing::Bool(),
                         [](const auto &info) { return info.param ? "relaxing" : "at_once"; });

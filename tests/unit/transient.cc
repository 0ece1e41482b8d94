// Steps in time: a free bar thrown against a rigid stop by its exact modes and residual flexibility (closed
// form: contact from 0.5 to 1.16667, force 300, impulse 200, uniform rebound at 10, energy kept).

#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  constexpr double length = 10, young = 900, density = 1, section = 1, speed = 10, gap = 5;

  ContactPair bar(const unsigned int n_modes)
  {
    ContactPair pair;
    ContactGrid &grid = pair.interface.contacts.only();
    grid.n_x = grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = std::sqrt(section);
    pair.interface.gap = {0.};
    const double pi = dealii::numbers::PI, mass = density * section * length;
    pair.trace.reinit(3, n_modes);
    pair.participation.reinit(n_modes, 3);
    double residual = length / (3 * young * section);
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      pair.omega.push_back(k * pi * std::sqrt(young / density) / length);
      pair.damping_ratio.push_back(0);
      pair.labels.push_back("bar:" + std::to_string(k));
      pair.body.push_back(1);
      pair.trace(0, k) = std::sqrt((k == 0 ? 1 : 2) / mass);
      pair.modal_load.push_back(0);
      pair.participation(k, 2) = k == 0 ? std::sqrt(mass) : 0;
      if (k > 0)
        residual -= std::pow(pair.trace(0, k) / pair.omega[k], 2);
    }
    pair.residual.reinit(3, 3);
    for (unsigned int i = 0; i < 3; ++i)
      pair.residual(i, i) = residual;
    return pair;
  }

  struct Outcome
  {
    double impulse, energy, penetration, peak, rebound;
  };

  Outcome bounce(TransientParameters parameters, const unsigned int n_modes, const double step,
                 const double end_time = 1.5)
  {
    const ContactPair pair = bar(n_modes);
    parameters.time_step = step;
    parameters.end_time = end_time;
    parameters.initial_state = "undeformed";
    parameters.initial_gap = gap;
    parameters.initial_velocity = -speed;
    ContactParameters contact;
    contact.friction = 0;
    const ContactSolverParameters solver;
    const DriveFunction drive = [](double)
    {
      Drive d;
      d.creepage.speed = 0;
      return d;
    };
    DynamicState state = initial_state(parameters, contact, solver, pair, drive(0));
    double peak = 0;
    const TransientResult result = transient(parameters, contact, solver, pair, drive, state,
                                             [&](const DynamicState &s, const TransientResult &)
                                             {
                                               peak = std::max(peak, s.R[0]);
                                               return true;
                                             });
    EXPECT_TRUE(result.converged);
    return {result.impulse / 200 - 1, result.energy.stored / result.energy.initial - 1, -result.smallest_gap,
            peak / 300, state.v[0] / std::sqrt(density * section * length) / speed};
  }
} // namespace

TEST(Transient, BouncingBar)
{
  TransientParameters parameters;
  const Outcome one = bounce(parameters, 21, 1e-3);
  EXPECT_LT(std::abs(one.impulse), 1e-3);
  EXPECT_LT(std::abs(one.energy), 5e-4);
  EXPECT_LT(one.penetration, 1e-12);
  std::printf("%-20s %-16s %6s %9s  %10s %10s %10s %8s\n", "integrator", "reaction", "theta", "step",
              "impulse", "energy", "penetrat.", "peak/300");
  for (const std::string integrator : {"theta method", "exact propagator"})
    for (const std::string reaction : {"as other forces", "end of step"})
      for (const double theta :
           integrator == "theta method" ? std::vector<double>{0.5, 0.6, 0.75, 1} : std::vector<double>{0.5})
        for (const double step : {2e-3, 1e-3, 5e-4})
        {
          parameters.integrator = integrator;
          parameters.reaction = reaction;
          parameters.theta = theta;
          const Outcome o = bounce(parameters, 21, step);
          std::printf("%-20s %-16s %6.2f %9.1e  %+10.2e %+10.2e %10.2e %8.3f\n", integrator.c_str(),
                      reaction.c_str(), theta, step, o.impulse, o.energy, o.penetration, o.peak);
        }
}

TEST(Transient, TheSmallestGapOfWhatDoesNotLandIsOpen)
{
  const double end_time = 0.3;
  EXPECT_NEAR(-bounce({}, 21, 1e-3, end_time).penetration, gap - speed * end_time, 1e-9);
}

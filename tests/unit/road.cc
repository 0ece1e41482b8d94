// Roads with kinks and steps: where they are, what a rigid point feels there, by closed forms; tables between their points;
// the load that an indentation makes.
#include "pi.h"
#include "scratch_folder.h"

#include <vibrocontact/analyses/modal_convolution/static_load.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/numerics/chebyshev_fit.h>
#include <vibrocontact/propagators/event_located.h>
#include <vibrocontact/propagators/propagator_types.h>
#include <vibrocontact/scene/oscillator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <numeric>

using namespace vibrocontact;

namespace
{
  RoadParameters expression(const std::string &text, const double speed)
  {
    RoadParameters parameters;
    parameters.profile = "expression";
    parameters.expression = text;
    parameters.speed = speed;
    return parameters;
  }

  RoadParameters table(const std::string &rows, const std::string &interpolation, const double speed)
  {
    const std::string name = scratch_folder() + "/road_table.csv";
    std::ofstream(name) << "position_m,height_m\n" << rows;
    RoadParameters parameters;
    parameters.profile = "table";
    parameters.table = name;
    parameters.interpolation = interpolation;
    parameters.speed = speed;
    return parameters;
  }

  /// 1 kg on 4e5 N/m
  struct Mass
  {
    OscillatorParameters parameters;
    BodyInContact model = by_poles(parameters.between_points(false, 0));
    double omega = std::sqrt(parameters.stiffness / parameters.mass), zeta = parameters.damping_ratio,
           rest = -parameters.mass * parameters.gravity / parameters.stiffness;

    Mass() { model.residual.reinit(1, 1); }

    /// displacement and rate of a flight from u, v after t
    std::pair<double, double> flight(const double u, const double v, const double t) const
    {
      const double d = omega * std::sqrt(1 - zeta * zeta), a = u - rest, b = (v + zeta * omega * a) / d,
                   e = std::exp(-zeta * omega * t), c = std::cos(d * t), s = std::sin(d * t);
      return {rest + e * (a * c + b * s),
              e * ((d * b - zeta * omega * a) * c - (d * a + zeta * omega * b) * s)};
    }

    std::unique_ptr<EventLocated> run(const Road &road, const double end) const
    {
      auto motion = std::make_unique<EventLocated>(model, state_at_rest(model), road, 1e300);
      motion->advance(end, [](const EventLocated::Piece &) {});
      return motion;
    }

    /// when a flight from u, v at `begin` first meets the road, by steps and bisection
    double landing(const Road &road, const double begin, const double u, const double v) const
    {
      const auto gap = [&](const double t) { return flight(u, v, t - begin).first - road.height(0, t); };
      double a = begin + 1e-5;
      while (gap(a + 1e-5) > 0)
        a += 1e-5;
      double b = a + 1e-5;
      for (unsigned int k = 0; k < 100; ++k)
        (gap(0.5 * (a + b)) > 0 ? a : b) = 0.5 * (a + b);
      return 0.5 * (a + b);
    }
  };
} // namespace

TEST(FunctionBreaks, KinksAndSteps)
{
  const auto places = [](const std::function<double(double)> &f)
  {
    const FunctionBreaks found = find_breaks(f, -0.03, 1, 5e-3);
    EXPECT_TRUE(found.singular.empty());
    EXPECT_FALSE(found.rough);
    return found.places;
  };
  // kinks to rounding, from either side, also where the search divides evenly
  std::vector<double> found = places([](const double x) { return std::abs(std::sin(2 * pi * x / 0.025)); });
  ASSERT_EQ(found.size(), 82u);
  for (unsigned int k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k], 0.0125 * (k - 2.), 1e-15);
  // a step, at the first number behind it
  found = places([](const double x) { return x < 0.3 ? 0. : 5e-3 + std::sin(x); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], 0.3);
  EXPECT_TRUE(places([](const double x) { return std::sin(40 * x) + x * x; }).empty());
  const FunctionBreaks root =
      find_breaks([](const double x) { return std::sqrt(std::abs(x - 0.2)); }, 0, 1, 0.1);
  ASSERT_EQ(root.singular.size(), 1u);
  EXPECT_NEAR(root.singular[0], 0.2, 1e-6);
}

// Valleys between half waves: J = M times the step of the road's rate, in expressions and in tables.
TEST(EventLocated, KinksAreImpacts)
{
  const Mass mass;
  const double amplitude = 1e-6, speed = 0.1, rate = amplitude * 2 * pi / 0.025 * speed;
  const Road road(expression("1e-6*abs(sin(2*pi*s/0.025))", speed), {0.}, {0.}, 1);
  const auto motion = mass.run(road, 1);
  ASSERT_EQ(motion->impacts.size(), 8u);
  EXPECT_TRUE(motion->releases.empty());
  for (unsigned int k = 0; k < 8; ++k)
  {
    EXPECT_NEAR(motion->impacts[k].time, 0.125 * k, 1e-14);
    EXPECT_NEAR(motion->impacts[k].impulse / ((k == 0 ? 1 : 2) * rate), 1, 1e-10);
  }
  // the same over a speed that doubles at once: a kink in time alone, and valleys at other times
  RoadParameters faster = expression("1e-6*abs(sin(2*pi*s/0.025))", 0);
  faster.speed_expression = "if(t<0.3,0.1,0.2)";
  const auto other = mass.run(Road(faster, {0.}, {0.}, 0.5), 0.5);
  // s = 0.0125, 0.025, then from 0.03 at 0.2 m/s, where cos > 0
  ASSERT_EQ(other->impacts.size(), 7u);
  EXPECT_NEAR(other->impacts[3].time, 0.3, 1e-14);
  EXPECT_NEAR(other->impacts[3].impulse / (rate * std::abs(std::cos(2 * pi * 0.03 / 0.025))), 1, 1e-10);
  EXPECT_NEAR(other->impacts[4].time, 0.3 + 0.0075 / 0.2, 1e-13);
  EXPECT_NEAR(other->impacts[4].impulse / (4 * rate), 1, 1e-10);

  const Road lines(table("0,0\n0.05,-1e-6\n0.06,1e-6\n0.2,3e-6\n", "linear", 0.5), {0.}, {0.}, 0.39);
  const auto slopes = mass.run(lines, 0.39);
  // at rest at first: the road leaves the mass, which follows it by its weight
  const auto kink =
      std::find_if(slopes->impacts.begin(), slopes->impacts.end(),
                   [](const ContactEvent &event) { return std::abs(event.time - 0.1) < 1e-13; });
  ASSERT_NE(kink, slopes->impacts.end());
  EXPECT_NEAR(kink->impulse / (0.5 * (2e-4 + 2e-5)), 1, 1e-10);
}

// A crest throws the mass up, a step down drops it: flights in closed form.
TEST(EventLocated, CrestsAndStepsDown)
{
  const Mass mass;
  for (const bool step : {false, true})
  {
    const Road road(step ? expression("if(s<0.1,0,-3e-5)", 1)
                         : table("0,0\n0.1,2e-4\n0.4,-4e-4\n", "linear", 1),
                    {0.}, {0.}, 0.3);
    const double u = step ? 0 : 2e-4, v = step ? 0. : 2e-3;
    const auto motion = mass.run(road, 0.2);
    const auto release = std::find_if(motion->releases.begin(), motion->releases.end(),
                                      [](const ContactEvent &event) { return event.time > 0.0999; });
    ASSERT_NE(release, motion->releases.end()) << step;
    EXPECT_NEAR(release->time, 0.1, 1e-14);
    const double landing = mass.landing(road, 0.1, u, v), rate = mass.flight(u, v, landing - 0.1).second;
    const auto impact = std::find_if(motion->impacts.begin(), motion->impacts.end(),
                                     [](const ContactEvent &event) { return event.time > 0.1; });
    ASSERT_NE(impact, motion->impacts.end()) << step;
    EXPECT_NEAR(impact->time, landing, 1e-11) << step;
    EXPECT_NEAR(impact->impulse / (-v - rate), 1, 1e-10) << step;
  }
}

TEST(EventLocated, StepsUpAreRefusedWhereTheyAreFelt)
{
  const Mass mass;
  EXPECT_THROW(mass.run(Road(expression("if(s<0.1,0,1e-4)", 1), {0.}, {0.}, 0.3), 0.3), InputError);
  // under a mass in flight, which clears it: thrown up by a ramp, over a step while it is high above
  const auto flown =
      mass.run(Road(expression("if(s<0.01,0.5*s,if(s<0.012,-1e-2,-9e-3))", 1), {0.}, {0.}, 0.0125), 0.0125);
  EXPECT_EQ(flown->releases.size(), 1u);
  EXPECT_THROW(mass.run(Road(expression("1e-4*sqrt(abs(s-0.1))", 1), {0.}, {0.}, 0.3), 0.3), InputError);
}

// A cleat of 5 mm.
TEST(Road, TableInterpolations)
{
  const std::string cleat = "0,0\n0.1,0\n0.11,0.005\n0.13,0.005\n0.14,0\n0.3,0\n";
  // between far points a spline would leave the road by 16 mm
  EXPECT_THROW(Road(table(cleat, "natural spline", 1), {0.}, {0.}, 0.3), InputError);
  EXPECT_THROW(Road(table("0,0\n1,0\n1.01,0.01\n2,0.01\n", "natural spline", 1), {0.}, {0.}, 2), InputError);
  EXPECT_NO_THROW(Road(table("0,0.1\n1,0.1\n1.3,0.1\n2,0.1\n", "natural spline", 1), {0.}, {0.}, 2));
  // beyond the way
  EXPECT_NO_THROW(Road(table("0,0\n1,0\n1.01,0.01\n2,0.01\n", "natural spline", 1), {0.}, {0.}, 1e-3));
  std::string every_centimetre;
  for (unsigned int k = 0; k <= 30; ++k)
    every_centimetre += std::to_string(k / 100.) + (k > 10 && k < 14 ? ",0.005\n" : ",0\n");
  const auto range = [&](const std::string &interpolation, const std::string &points)
  {
    const Road road(table(points, interpolation, 1), {0.}, {0.}, 0.3);
    double low = 0, high = 0;
    for (double t = 0; t <= 0.3; t += 1e-5)
    {
      low = std::min(low, road.height(0, t));
      high = std::max(high, road.height(0, t));
    }
    EXPECT_NEAR(road.height(0, 0.12), 0.005, 1e-5);
    return std::make_pair(low, high);
  };
  EXPECT_GT(range("natural spline", every_centimetre).second, 5.4e-3);
  EXPECT_LT(range("natural spline", every_centimetre).first, -2e-4);
  for (const std::string interpolation : {"linear", "monotone"})
  {
    EXPECT_NEAR(range(interpolation, cleat).second, 5e-3, 1e-15) << interpolation;
    EXPECT_NEAR(range(interpolation, cleat).first, 0, 1e-15) << interpolation;
  }
  const Road lines(table(cleat, "linear", 1), {0.}, {0.}, 0.3),
      cubics(table(cleat, "monotone", 1), {0.}, {0.}, 0.3);
  EXPECT_NEAR(lines.height(0, 0.1025), 1.25e-3, 1e-15);
  // Hermite's cubic between zero slopes
  EXPECT_NEAR(cubics.height(0, 0.1025), 5e-3 * (3 * 0.0625 - 2 * 0.015625), 1e-15);
  EXPECT_EQ(lines.next_jump(0.05), 0.1);
  // rising data: the weighted harmonic mean of the slopes 1 and 3, and continuous rates
  const Road rising(table("0,0\n1,1\n2,4\n3,5\n", "monotone", 1), {0.}, {0.}, 3);
  EXPECT_NEAR(rising.at(0, 1).first, 2 / (1 + 1 / 3.), 1e-13);
  EXPECT_NEAR(rising.before(0, 2).first, rising.after(0, 2).first, 1e-13);
  EXPECT_GT(std::abs(rising.before(0, 2).second - rising.after(0, 2).second), 0.1);
}

TEST(StaticLoad, IndentationOfAForce)
{
  // one spring: K (indentation - rest)
  const Mass mass;
  EXPECT_NEAR(indentation_of_load(mass.model, {0.}, 1000), 1000 / mass.parameters.stiffness + mass.rest,
              1e-14);
  // a tyre whose outer points touch later: the load of the indentation, stepped until it rests
  RingParameters ring;
  ring.n_points = 5;
  ring.tread_stiffness = 2e5;
  const BodyInContact model = ring_poles(ring, ring_rows(ring, false));
  std::vector<double> places, shapes;
  for (const double angle : ring.angles())
  {
    places.push_back(ring.radius * angle);
    shapes.push_back(ring.radius * (1 - std::cos(angle)));
  }
  const double indentation = indentation_of_load(model, shapes, 800);
  EXPECT_GT(indentation, shapes[0]);
  RoadParameters flat;
  flat.indentation = indentation;
  flat.loading_time = 0.05;
  const Road road(flat, places, shapes, 1);
  PropagatorSettings settings;
  settings.time_step = 1e-4;
  settings.interpolation = ForceInterpolation::linear;
  const auto propagator = create_propagator("modal recursion", model, state_at_rest(model), settings);
  ContactProblem problem = road_contact_problem(propagator->compliance(), 5, {}, settings.time_step);
  ActiveSetSolver contact;
  ContactSolution solution;
  std::vector<double> height(5);
  for (unsigned int k = 0; k < 10000; ++k)
  {
    road.heights((k + 1) * 1e-4, height.data());
    for (unsigned int i = 0; i < 5; ++i)
      problem.b[i] = propagator->free_displacement()[i] - height[i];
    contact.solve(problem, solution);
    propagator->advance(solution.R.data());
  }
  EXPECT_NEAR(std::accumulate(solution.R.begin(), solution.R.end(), 0.), 800, 1e-6);
}

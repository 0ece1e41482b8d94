// What a modal convolution tells about itself: the error of its steps against finer ones, its energy account, roads between
// the steps, bodies that create energy.
#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/scene/oscillator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  RoadParameters waves(const std::string &expression, const double speed)
  {
    RoadParameters road;
    road.profile = "expression";
    road.expression = expression;
    road.speed = speed;
    return road;
  }

  /// Four modes with a tread.
  BodyInContact treaded(const double tread)
  {
    DenseMatrix trace(1, 4), residual(1, 1);
    std::vector<double> omega, damping;
    for (unsigned int k = 0; k < 4; ++k)
    {
      trace(0, k) = 0.4;
      omega.push_back(600 + 150 * k * k);
      damping.push_back(0.05);
    }
    residual(0, 0) = tread > 0 ? 1 / tread : 0;
    return by_poles({omega, damping, trace, {}, residual, {}});
  }

  ModalConvolutionResult march(const BodyInContact &model, const RoadParameters &parameters,
                               const double step, const std::string &shape, const double end,
                               const std::string &method = "modal recursion")
  {
    ModalConvolutionParameters own;
    own.method = method;
    own.force_shape = shape;
    own.time_step = step;
    own.end_time = end;
    const Road road(parameters, {0.}, {0.}, end);
    ModalConvolution motion(own, {}, model, road);
    while (motion.advance(1000, [](const ModalConvolutionLines &) {}))
      ;
    return motion.result();
  }
} // namespace

// Within a factor of three of the true error, over five step sizes.
TEST(RoadMarchError, EstimateAgainstTheTruth)
{
  RoadParameters road = waves("2e-4*sin(2*pi*s/0.3)+5e-5*sin(2*pi*s/0.11)", 10);
  road.indentation = 1e-3;
  road.loading_time = 0.02;
  const BodyInContact model = treaded(3e5);
  const double end = 0.2;
  const ModalConvolutionResult exact = march(model, road, 1e-6, "linear", end);
  for (const std::string shape : {"linear", "impulse", "constant"})
    for (const double step : {4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5})
    {
      const ModalConvolutionResult result = march(model, road, step, shape, end);
      const double force = std::abs(result.rms_force() / exact.rms_force() - 1);
      EXPECT_NEAR(std::log(result.errors.rms_force / force), 0, std::log(3.)) << shape << " " << step;
      const double impulse = std::abs(result.impulse[0] / exact.impulse[0] - 1);
      EXPECT_GT(result.errors.impulse, impulse / 3) << shape << " " << step;
      EXPECT_LT(result.errors.impulse, std::max(3 * impulse, 1e-6)) << shape << " " << step;
      EXPECT_NEAR(result.errors.time, end, step + 1e-12);
      EXPECT_LT(result.unseen_share(), 1e-3);
    }
  // a convolution that forgets: what it cuts off is an error, too
  ModalConvolutionParameters short_memory;
  short_memory.method = "direct convolution";
  short_memory.force_shape = "linear";
  short_memory.time_step = 2.5e-5;
  short_memory.end_time = end;
  short_memory.memory = 0.02;
  const Road way(road, {0.}, {0.}, end);
  ModalConvolution forgetful(short_memory, {}, model, way);
  while (forgetful.advance(1000, [](const ModalConvolutionLines &) {}))
    ;
  const double impulse = std::abs(forgetful.result().impulse[0] / exact.impulse[0] - 1);
  EXPECT_NEAR(std::log(forgetful.result().errors.impulse / impulse), 0, std::log(3.)) << impulse;
}

TEST(RoadMarchError, LongestStepsAndOddNumbers)
{
  RoadParameters road;
  road.indentation = 1e-3;
  road.loading_time = 0.02;
  const BodyInContact model = treaded(3e5);
  // forces ring in twice this step: the second run has half of it
  const double longest = 2.7 * std::sqrt(1 / 3e5 / initial_derivative(model, 1)(0, 0)),
               end = 41 * 0.7 * longest;
  const ModalConvolutionResult result = march(model, road, 0.7 * longest, "linear", end);
  const double exact = march(model, road, 0.01 * longest, "linear", end).impulse[0],
               error = std::abs(result.impulse[0] / exact - 1);
  EXPECT_NEAR(result.errors.time, end, 1e-12);
  EXPECT_NEAR(std::log(result.errors.impulse / error), 0, std::log(4.));
  EXPECT_NEAR(march(model, road, 1e-4, "linear", 41e-4).errors.time, 40e-4, 1e-12);
}

// The oscillator of the paper: impacts take J^2 / 2 M, and everything else is stored, damped or given back.
TEST(RoadMarchError, EnergyAccount)
{
  OscillatorParameters oscillator;
  BodyInContact model = by_poles(oscillator.between_points(false, 0));
  model.residual.reinit(1, 1);
  const RoadParameters road = waves("5e-3*sin(2*pi*s/0.025)", 0.1);
  const ModalConvolutionResult exact = march(model, road, 1e-3, "impulse", 0.6, "event located");
  const WorkAccount &work = exact.work;
  ASSERT_TRUE(work.has_modes);
  double lost = 0;
  for (const ContactEvent &impact : exact.impacts)
    lost += impact.impulse * impact.impulse / (2 * oscillator.mass);
  EXPECT_NEAR(work.impacts / lost, 1, 1e-10);
  EXPECT_NEAR(work.initial, std::pow(oscillator.mass * oscillator.gravity, 2) / (2 * oscillator.stiffness),
              1e-12);
  EXPECT_GT(work.input, 5);
  EXPECT_LT(std::abs(work.imbalance()), 1e-9 * work.available());
  double open[2];
  for (const unsigned int k : {0u, 1u})
  {
    const ModalConvolutionResult stepped = march(model, road, k == 0 ? 2e-4 : 1e-4, "impulse", 0.6);
    EXPECT_NEAR(stepped.work.input / work.input, 1, 2e-2);
    EXPECT_NEAR(stepped.work.impacts / work.impacts, 1, 5e-2);
    // the rate within a step is a saw, whose damping falls with the square of the step
    EXPECT_NEAR(stepped.work.damping / work.damping, 1, k == 0 ? 0.9 : 0.225);
    EXPECT_NEAR(stepped.rms_force() / exact.rms_force(), 1, 1e-2);
    open[k] = std::abs(stepped.work.imbalance());
  }
  EXPECT_LT(open[0], 1e-2 * work.input);
  EXPECT_LT(open[1], 0.6 * open[0]);
  // with a tread: linear forces lose nothing
  RoadParameters smooth = waves("2e-4*sin(2*pi*s/0.3)", 10);
  smooth.indentation = 1e-3;
  smooth.loading_time = 0.02;
  const WorkAccount linear = march(treaded(3e5), smooth, 1e-4, "linear", 0.2).work;
  EXPECT_LT(std::abs(linear.imbalance()), 1e-3 * linear.input);
  EXPECT_GT(linear.damping, 0);
}

TEST(RoadMarchError, WavesBetweenTheSteps)
{
  const BodyInContact model = treaded(3e5);
  RoadParameters road = waves("5e-4*sin(2*pi*s/0.004)", 20);
  road.indentation = 1e-3;
  road.loading_time = 0.02;
  // 0.2 ms each: as long as the step, and as the second run's half
  EXPECT_GT(march(model, road, 2e-4, "linear", 0.2).unseen_share(), 0.2);
  EXPECT_GT(march(model, road, 1e-4, "linear", 0.2).unseen_share(), 0.2);
  EXPECT_LT(march(model, road, 1e-5, "linear", 0.2).unseen_share(), 1e-2);
}

// A body at rest whose data came early: forces get back more than they gave.
TEST(RoadMarchError, BodiesThatCreateEnergy)
{
  RoadParameters road = waves("9e-4*sin(2*pi*s/0.25)", 10);
  road.indentation = 1e-3;
  road.loading_time = 0.02;
  const BodyInContact good = treaded(3e5);
  EXPECT_GE(march(good, road, 1e-4, "linear", 2).work.least_work, 0);
  BodyInContact early = good;
  for (unsigned int k = 0; k < early.n_poles(); ++k)
    early.left(0, k) *= std::exp(early.poles[k] * 6e-4);
  const WorkAccount work = march(early, road, 1e-4, "linear", 2).work;
  EXPECT_LT(work.least_work, -0.01 * work.input);
}

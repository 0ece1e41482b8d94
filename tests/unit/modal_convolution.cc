// Whole runs: the oscillator and the ring on the road against exact motion, converged runs and published values.
#include <vibrocontact/analyses/modal_convolution/method_comparison.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/scene/oscillator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  BodyInContact paper_oscillator()
  {
    OscillatorParameters oscillator;
    BodyInContact model = by_poles(oscillator.between_points(false, 0));
    model.residual.reinit(1, 1);
    return model;
  }

  RoadParameters sine(const double speed)
  {
    RoadParameters road;
    road.profile = "expression";
    road.expression = "5e-3*sin(2*pi*s/0.025)";
    road.speed = speed;
    return road;
  }

  /// The ring on the deterministic road (doc/theory.md, corrections to the tyre paper).
  struct Tyre
  {
    Tyre(const double tread, const double indentation, const bool rolling, const unsigned int n_points = 3)
    {
      if (n_points > 3)
      {
        ring.n_points = n_points;
        ring.spacing = 0.1 / n_points;
      }
      ring.tread_stiffness = tread;
      ring.residual = tread > 0;
      road.profile = "ISO 8608";
      road.speed = 80 / 3.6;
      road.indentation = indentation;
      road.loading_time = 0.02;
      model = ring_poles(ring, ring_rows(ring, false), rolling ? -road.speed / ring.radius : 0.);
      for (const double angle : ring.angles())
      {
        places.push_back(ring.radius * angle);
        shapes.push_back(ring.radius * (1 - std::cos(angle)));
      }
    }
    RingParameters ring;
    RoadParameters road;
    BodyInContact model;
    std::vector<double> places, shapes;
  };

  struct Outcome
  {
    std::vector<double> impulse, forces;
    double largest = 0, residual = 0;
  };

  Outcome run(const Tyre &tyre, const std::string &method, const std::string &shape, const double step,
              const unsigned int every, const double end = 0.2, const std::string &solver = "automatic")
  {
    ModalConvolutionParameters parameters;
    parameters.method = method;
    parameters.force_shape = shape;
    parameters.time_step = step;
    parameters.end_time = end;
    parameters.contact_solver = solver;
    const Road road(tyre.road, tyre.places, tyre.shapes, end);
    ContactSolverParameters accurate;
    accurate.tolerance = 1e-13;
    ModalConvolution motion(parameters, accurate, tyre.model, road);
    Outcome outcome;
    const auto keep = [&](const ModalConvolutionLines &lines)
    {
      for (unsigned int k = 0; k < lines.n_lines; ++k)
        if ((lines.first_line + k) % every == 0)
          for (unsigned int i = 0; i < lines.n_points; ++i)
            outcome.forces.push_back(lines.force[k * lines.n_points + i]);
    };
    while (motion.advance(1000, keep))
      ;
    outcome.impulse = motion.result().impulse;
    outcome.largest = motion.result().largest_force;
    outcome.residual = motion.result().residual;
    return outcome;
  }
} // namespace

TEST(ModalConvolution, ThreePointsWithTread)
{
  const Tyre tyre(3e5, 1e-3, false);
  const Outcome own = run(tyre, "modal recursion", "linear", 20e-6, 1),
                converged = run(tyre, "modal recursion", "linear", 2.5e-6, 8);
  EXPECT_NEAR(own.impulse[1] / 17.67764, 1, 1e-4);
  EXPECT_NEAR(converged.impulse[1] / 17.67764, 1, 1e-5);
  EXPECT_GT(own.residual, 0);
  EXPECT_LT(own.residual, 1e-12);
  ASSERT_EQ(own.forces.size(), converged.forces.size());
  double error = 0;
  for (std::size_t k = 0; k < own.forces.size(); ++k)
    error = std::max(error, std::abs(own.forces[k] - converged.forces[k]));
  EXPECT_LT(error, 1e-4 * converged.largest);
  // constant forces are of first order
  double errors[2];
  for (const unsigned int k : {1u, 2u})
  {
    const Outcome constant = run(tyre, "modal recursion", "constant", 20e-6 / k, k);
    errors[k - 1] = 0;
    for (std::size_t i = 0; i < constant.forces.size(); ++i)
      errors[k - 1] = std::max(errors[k - 1], std::abs(constant.forces[i] - converged.forces[i]));
  }
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.3);
}

TEST(ModalConvolution, ThreeRigidPointsRestAndRolling)
{
  for (const bool rolling : {false, true})
  {
    const Tyre tyre(0, 0.5e-3, rolling);
    const Outcome exact = run(tyre, "event located", "impulse", 20e-6, 1),
                  coarse = run(tyre, "modal recursion", "impulse", 20e-6, 1),
                  fine = run(tyre, "modal recursion", "impulse", 5e-6, 1);
    EXPECT_NEAR(coarse.impulse[1] / exact.impulse[1], 1, 3e-3);
    EXPECT_NEAR(coarse.impulse[0] / exact.impulse[0], 1, 4e-2);
    EXPECT_LT(std::abs(fine.impulse[0] - exact.impulse[0]),
              std::abs(coarse.impulse[0] - exact.impulse[0]) / 2);
  }
}

// Hundreds of points by FFT and in few shapes: the forces of the matrix.
TEST(ModalConvolution, ProductsGiveTheSameAsTheMatrix)
{
  const Tyre tyre(2e4, 4e-3, true, 200);
  const Outcome by_products = run(tyre, "modal recursion", "linear", 20e-6, 1, 0.05),
                by_matrix = run(tyre, "modal recursion", "linear", 20e-6, 1, 0.05, "active set");
  ASSERT_EQ(by_products.forces.size(), by_matrix.forces.size());
  double error = 0;
  for (std::size_t k = 0; k < by_matrix.forces.size(); ++k)
    error = std::max(error, std::abs(by_products.forces[k] - by_matrix.forces[k]));
  EXPECT_LT(error, 1e-9 * by_matrix.largest);
  // another solver
  EXPECT_GT(error, 0);
  EXPECT_LT(by_products.residual, 1e-10);
}

TEST(ModalConvolution, CommonSolverGivesTheSame)
{
  const Tyre tyre(3e5, 1e-3, true);
  const Outcome fast = run(tyre, "modal recursion", "linear", 20e-6, 1, 0.05),
                common = run(tyre, "modal recursion", "linear", 20e-6, 1, 0.05, "common");
  for (std::size_t k = 0; k < fast.forces.size(); ++k)
    EXPECT_NEAR(fast.forces[k], common.forces[k], 1e-11 * fast.largest);
}

// Second order of displacement and smooth force; what the paper's forms do; the memory of Table 2.
TEST(ModalConvolution, MethodsAgainstTheExactMotion)
{
  const ModalConvolutionParameters parameters;
  const BodyInContact model = paper_oscillator();
  const auto rows = compare_methods({{2e-4, 2000, 1000}, {1e-4, 4000, 1900}, {5e-5, 8000, 4000}}, 1,
                                    parameters, model, sine(0.1), {0.}, {0.});
  const auto find = [&](const std::string &method, const double step)
  {
    for (const ComparedMethod &row : rows)
      if (row.method == method && row.time_step == step)
        return row;
    throw std::runtime_error("no " + method);
  };
  EXPECT_EQ(find("event located", 1e-4).error_displacement, 0);
  for (const std::string method : {"modal recursion", "two Gauss forces, corrected"})
  {
    EXPECT_LT(find(method, 1e-4).error_displacement, 2e-7) << method;
    EXPECT_LT(find(method, 5e-5).error_displacement, 0.4 * find(method, 1e-4).error_displacement) << method;
  }
  for (const double step : {2e-4, 1e-4})
    EXPECT_NEAR(find("modal recursion", step).error_force / find("modal recursion", step / 2).error_force, 4,
                0.5);
  // as printed, half of each correction is applied: a hundred times worse; it costs g 10 % of its memory to cut it
  EXPECT_GT(find("two Gauss forces as printed", 1e-4).error_displacement,
            100 * find("modal recursion", 1e-4).error_displacement);
  EXPECT_GT(find("direct convolution", 1e-4).error_displacement, 1e-5);
  EXPECT_NEAR(find("direct convolution, scalar", 1e-4).error_displacement /
                  find("direct convolution", 1e-4).error_displacement,
              1, 1e-6);
  EXPECT_NEAR(find("growing exponentials as printed", 1e-4).error_displacement /
                  find("modal recursion", 1e-4).error_displacement,
              1, 1e-3);
}

// The ring: all methods agree when nothing is forgotten, against the exact motion (rigid) or a finer one (tread).
TEST(ModalConvolution, MethodsOfTheRing)
{
  for (const bool rigid : {true, false})
  {
    const Tyre tyre(rigid ? 0 : 3e5, rigid ? 0.5e-3 : 1e-3, false);
    ModalConvolutionParameters parameters;
    parameters.force_shape = "linear";
    const auto rows =
        compare_methods({{2e-5, 2000, 2001}}, 1, parameters, tyre.model, tyre.road, tyre.places, tyre.shapes);
    EXPECT_EQ(rows.size(), rigid ? 7u : 6u);
    for (const ComparedMethod &row : rows)
      if (row.method == "event located")
        EXPECT_EQ(row.error_displacement, 0);
      else
      {
        EXPECT_NEAR(row.error_displacement / rows[rigid].error_displacement, 1, 1e-6) << row.method;
        EXPECT_LT(row.error_displacement, rigid ? 1e-4 : 1e-6) << row.method;
        EXPECT_LT(row.error_impulse, rigid ? 2e-2 : 1e-4) << row.method;
      }
  }
}

// Five rigid points: impulses in an eighth of the step are the reference, and it is stable.
TEST(ModalConvolution, MethodsOfManyRigidPoints)
{
  Tyre tyre(0, 0.5e-3, false);
  const RingParameters &ring = tyre.ring;
  tyre.ring.n_points = 5;
  tyre.model = ring_poles(ring, ring_rows(ring, false));
  tyre.places.clear();
  tyre.shapes.clear();
  for (const double angle : ring.angles())
  {
    tyre.places.push_back(ring.radius * angle);
    tyre.shapes.push_back(ring.radius * (1 - std::cos(angle)));
  }
  ModalConvolutionParameters parameters;
  parameters.force_shape = "linear";
  const auto rows =
      compare_methods({{2e-5, 1000, 1001}}, 1, parameters, tyre.model, tyre.road, tyre.places, tyre.shapes);
  EXPECT_EQ(rows.size(), 6u);
  for (const ComparedMethod &row : rows)
  {
    EXPECT_LT(row.error_displacement, 1e-4) << row.method;
    EXPECT_LT(row.error_impulse, 5e-2) << row.method;
  }
}

// A step of the road on the end of a block is seen as any other, whatever rounding makes of its time.
TEST(ModalConvolution, StepsOfTheRoadBetweenBlocks)
{
  const BodyInContact model = paper_oscillator();
  ModalConvolutionParameters parameters;
  parameters.time_step = 1e-4;
  parameters.end_time = 0.02;
  parameters.error_estimate = false;
  for (unsigned int step = 20; step < 60; ++step)
  {
    RoadParameters steps_up;
    steps_up.profile = "expression";
    steps_up.expression = "if(s<" + std::to_string(step) + "*1e-4,0,1e-5)";
    steps_up.speed = 1;
    const Road road(steps_up, {0.}, {0.}, parameters.end_time);
    for (const unsigned int block : {1u, 1000u})
    {
      ModalConvolution motion(parameters, {}, model, road);
      EXPECT_THROW(
          {
            while (motion.advance(block))
              ;
          },
          InputError)
          << step << " " << block;
    }
  }
}

TEST(ModalConvolution, RowsOfTheComparison)
{
  EXPECT_EQ(read_comparison_rows("1e-4:2000:1900, 1e-5:20000:19000 ", "Rows").size(), 2);
  for (const char *wrong : {"1e-4:2000.7:1900", "1e-4:2000:1900junk", "1e-4:2000:1900.5", "1e-4:2000"})
    EXPECT_THROW(read_comparison_rows(wrong, "Rows"), InputError) << wrong;
}

// Forces of rigid points that are constant or linear in a step are refused, those behind a tread up to a step.
TEST(ModalConvolution, RefusesShapesThatRing)
{
  for (const char *shape : {"constant", "linear"})
    EXPECT_THROW(run(Tyre(0, 0.5e-3, false), "modal recursion", shape, 20e-6, 1, 1e-3), InputError);
  EXPECT_THROW(run(Tyre(3e5, 1e-3, false), "modal recursion", "linear", 5e-3, 1, 0.1), InputError);
  EXPECT_NO_THROW(run(Tyre(3e5, 1e-3, false), "modal recursion", "constant", 1e-3, 1, 0.1));
}

// 1,000 s at 0.1 m/s: the last period is the second; 1 m/s, where every touch is an impact and an immediate release.
TEST(ModalConvolution, NothingGrows)
{
  const BodyInContact model = paper_oscillator();
  for (const double speed : {0.1, 1.})
  {
    ModalConvolutionParameters parameters;
    parameters.time_step = 1e-4;
    parameters.end_time = speed < 1 ? 1000 : 100;
    const Road road(sine(speed), {0.}, {0.}, parameters.end_time);
    ModalConvolution motion(parameters, {}, model, road);
    const unsigned int period = 2500;
    std::vector<double> early(period), late(period);
    const unsigned long last = motion.n_steps();
    const auto keep = [&](const ModalConvolutionLines &lines)
    {
      for (unsigned int k = 0; k < lines.n_lines; ++k)
      {
        const unsigned long line = lines.first_line + k;
        EXPECT_LT(std::abs(lines.displacement[k]), 0.1);
        if (line >= period && line < 2 * period)
          early[line - period] = lines.displacement[k];
        if (line + period >= last && line < last)
          late[line + period - last] = lines.displacement[k];
      }
    };
    while (motion.advance(10000, keep))
      ;
    for (unsigned int k = 0; k < period && speed < 1; ++k)
      EXPECT_NEAR(early[k], late[k], 1e-9) << k;
  }
}

// What a march says of its own errors, against events to rounding and against far shorter steps.
TEST(ModalConvolution, ErrorsThatAMarchEstimatesAreThose)
{
  struct March
  {
    double impulse, rms_force;
    RoadMarchErrors errors;
  };
  const auto march = [](const BodyInContact &model, const Road &road, ModalConvolutionParameters parameters,
                        const std::string &method, const double step)
  {
    parameters.method = method;
    parameters.time_step = step;
    ModalConvolution motion(parameters, {}, model, road);
    while (motion.advance(1000, [](const ModalConvolutionLines &) {}))
      ;
    double impulse = 0;
    for (const double value : motion.result().impulse)
      impulse += value;
    return March{impulse, motion.result().rms_force(), motion.result().errors};
  };
  const auto compare = [&](const char *const name, const BodyInContact &model, const Road &road,
                           const ModalConvolutionParameters &parameters, const March &truth,
                           const std::vector<double> &steps, const double within)
  {
    for (const double step : steps)
    {
      const March one = march(model, road, parameters, "modal recursion", step);
      const double impulse = std::abs(one.impulse / truth.impulse - 1),
                   rms_force = std::abs(one.rms_force / truth.rms_force - 1);
      std::printf("| %s | %g | %.1e | %.1e | %.2f | %.1e | %.1e | %.2f |\n", name, step, impulse,
                  one.errors.impulse, one.errors.impulse / impulse, rms_force, one.errors.rms_force,
                  one.errors.rms_force / rms_force);
      EXPECT_LT(std::abs(std::log(one.errors.impulse / impulse)), std::log(within)) << step;
      EXPECT_LT(std::abs(std::log(one.errors.rms_force / rms_force)), std::log(3.)) << step;
    }
  };

  ModalConvolutionParameters parameters;
  parameters.end_time = 1;
  const BodyInContact oscillator = paper_oscillator();
  const Road waves(sine(0.1), {0.}, {0.}, parameters.end_time);
  compare("sine", oscillator, waves, parameters, march(oscillator, waves, parameters, "event located", 1e-4),
          {1.6e-3, 8e-4, 4e-4, 2e-4, 1e-4}, 3);
  // the impulse of three points at once falls faster than steps by chance, from 5e-5 to 3e-7 in four of them
  const Tyre tyre(3e5, 1e-3, false);
  parameters.end_time = 0.2;
  const Road road(tyre.road, tyre.places, tyre.shapes, parameters.end_time);
  parameters.force_shape = "linear";
  compare("tyre, linear", tyre.model, road, parameters,
          march(tyre.model, road, parameters, "modal recursion", 2e-6), {3.2e-4, 1.6e-4, 8e-5, 4e-5, 2e-5},
          10);
}

// A free body of two masses falls 1 mm onto a road and comes to rest on it: what the road gives is its weight over all that
// time, whoever steps.
TEST(ModalConvolution, FreeBodyFallsAndComesToRest)
{
  const double m = 2, M = 3, k = 5e4, zeta = 0.1, g = 9.81, end = 1.5;
  BodyInContact body;
  body.omega = {0., std::sqrt(k * (1 / m + 1 / M))};
  body.damping_ratio = {0., zeta};
  body.trace.reinit(1, 2);
  body.trace(0, 0) = 1 / std::sqrt(m + M);
  body.trace(0, 1) = std::sqrt(M / (m * (m + M)));
  body.modal_load = {-g * std::sqrt(m + M), 0.};
  body.residual.reinit(1, 1);
  const BodyInContact poles = by_poles(body);
  RoadParameters parameters;
  parameters.indentation = -1e-3;
  const Road road(parameters, {0.}, {0.}, end);
  for (const std::string method : {"modal recursion", "theta method", "block convolution", "event located"})
  {
    ModalConvolutionParameters own;
    own.method = method;
    own.time_step = 1e-4;
    own.end_time = end;
    ModalConvolution motion(own, {}, poles, road);
    double touch = 0, last_force = 0, lowest = 0;
    while (motion.advance(1000,
                          [&](const ModalConvolutionLines &lines)
                          {
                            for (unsigned int i = 0; i < lines.n_lines; ++i)
                            {
                              if (touch == 0 && lines.force[i] > 0)
                                touch = (lines.first_line + i) * lines.time_step;
                              last_force = lines.force[i];
                              lowest = std::min(lowest, lines.displacement[i]);
                            }
                          }))
      ;
    EXPECT_NEAR(touch, std::sqrt(2 * 1e-3 / g), 2e-4) << method;
    // the body hops from impulse to impulse: on the way down from the last one when the time is over
    const double carried = own.is_event_located() ? end : end - 0.5 * own.time_step;
    EXPECT_NEAR(motion.result().impulse[0], (m + M) * g * carried, 1e-6 * (m + M) * g * end) << method;
    EXPECT_NEAR(last_force, (m + M) * g, 1e-4 * (m + M) * g) << method;
    EXPECT_NEAR(lowest, -1e-3, 1e-9) << method;
  }
}

// With a tread and theta = 1/2 the theta method is of second order, and of first with more.
TEST(ModalConvolution, OrderOfTheThetaMethodOnARoad)
{
  DenseMatrix trace(1, 2), residual(1, 1);
  trace(0, 0) = trace(0, 1) = 0.5;
  residual(0, 0) = 1e-5;
  const BodyInContact poles = by_poles({{200., 520.}, {0.05, 0.05}, trace, {}, residual, {}});
  RoadParameters parameters;
  parameters.profile = "expression";
  parameters.expression = "2e-4*sin(2*pi*s/0.3)";
  parameters.speed = 10;
  parameters.indentation = 1e-3;
  parameters.loading_time = 0.02;
  const Road road(parameters, {0.}, {0.}, 0.2);
  const auto impulse = [&](const std::string &method, const double step, const double theta)
  {
    ModalConvolutionParameters own;
    own.method = method;
    own.force_shape = "linear";
    own.theta = theta;
    own.time_step = step;
    own.end_time = 0.2;
    own.error_estimate = false;
    ModalConvolution motion(own, {}, poles, road);
    while (motion.advance(1000, [](const ModalConvolutionLines &) {}))
      ;
    return motion.result().rms_force();
  };
  const double exact = impulse("modal recursion", 2.5e-6, 0.5);
  const auto error = [&](const double step, const double theta)
  { return std::abs(impulse("theta method", step, theta) / exact - 1); };
  for (const double theta : {0.5, 0.6})
  {
    const double coarse = error(2e-4, theta), fine = error(5e-5, theta), ratio = theta == 0.5 ? 16 : 4;
    std::printf("theta %.1f: rms force off by %.2e and %.2e at a quarter of the step\n", theta, coarse, fine);
    EXPECT_GT(coarse / fine, 0.75 * ratio);
    EXPECT_LT(coarse / fine, 1.4 * ratio);
  }
}

// A linear spring as the law of a rigid point is the tread of the same stiffness before a rigid law.
TEST(ModalConvolution, SpringLawIsATread)
{
  const double stiffness = 2e5;
  RoadParameters parameters;
  parameters.profile = "expression";
  parameters.expression = "6e-4*sin(2*pi*s/0.3)";
  parameters.speed = 10;
  parameters.indentation = 2e-4;
  const Road road(parameters, {0.}, {0.}, 0.2);
  std::vector<double> input;
  const auto forces = [&](const bool tread, const std::string &shape)
  {
    DenseMatrix trace(1, 2), residual(1, 1);
    trace(0, 0) = trace(0, 1) = 0.5;
    residual(0, 0) = tread ? 1 / stiffness : 0.;
    const BodyInContact poles = by_poles({{200., 520.}, {0.05, 0.05}, trace, {}, residual, {}});
    RoadLaws laws;
    if (!tread)
      laws.normal = create_normal_law("linear spring", {stiffness / 100, 100});
    ModalConvolutionParameters own;
    own.force_shape = shape;
    own.time_step = 1e-4;
    own.end_time = 0.2;
    own.error_estimate = false;
    ContactSolverParameters accurate;
    accurate.tolerance = 1e-13;
    ModalConvolution motion(own, accurate, poles, road, laws);
    std::vector<double> result;
    while (motion.advance(1000, [&](const ModalConvolutionLines &lines)
                          { result.insert(result.end(), lines.force, lines.force + lines.n_lines); }))
      ;
    EXPECT_GT(motion.result().impacts.size(), 2u) << "it does not lift off";
    input.push_back(motion.result().work.input);
    return result;
  };
  for (const std::string shape : {"constant", "linear"})
  {
    const std::vector<double> spring = forces(false, shape), tread = forces(true, shape);
    ASSERT_EQ(spring.size(), tread.size());
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < tread.size(); ++k)
    {
      worst = std::max(worst, std::abs(spring[k] - tread[k]));
      largest = std::max(largest, tread[k]);
    }
    EXPECT_LT(worst, 1e-9 * largest) << shape;
    // but for the steps in which they touch and release
    EXPECT_NEAR(input[input.size() - 2], input.back(), 0.02 * input.back()) << "power of the road";
  }
  RoadLaws penalty;
  penalty.normal = create_normal_law("exponential penalty", {1e3, 200});
  ModalConvolutionParameters own;
  own.force_shape = "linear";
  DenseMatrix trace(1, 1);
  trace(0, 0) = 0.5;
  const BodyInContact rigid = by_poles({{200.}, {0.05}, trace, {}, DenseMatrix(1, 1), {}});
  EXPECT_THROW(ModalConvolution(own, {}, rigid, road, penalty), InputError);
  own.method = "event located";
  own.force_shape = "impulse";
  EXPECT_THROW(ModalConvolution(own, {}, rigid, road, penalty), InputError);
}

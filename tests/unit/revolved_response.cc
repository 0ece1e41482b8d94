// Frequency response of a body of revolution: modes and Ritz vectors against direct solutions wave by wave, reciprocity, the
// static answer, and the same point seen from elsewhere around the axle. Of one that turns: the same at rest, reciprocity
// with the sign of the rotation, peaks where the poles of the free body are, and the poles' sum.
#include "small_disc.h"

#include <vibrocontact/analyses/frequency_response/revolved_response.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/reduction_parts.h>
#include <vibrocontact/reduction/revolved_reduction.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  using Points = std::vector<RevolvedPoint>;

  /// A disc held at its bore, of a material with loss.
  RevolvedSection disc()
  {
    run_log().set_screen(false);
    return small_disc(0.01);
  }

  /// On the rim: over a patch of the tread (along z, x, y), then at a node of the side.
  Points points(const RevolvedSection &section, const double angle)
  {
    Points result(4);
    for (unsigned int k = 0; k < 4; ++k)
    {
      result[k].component = k % 3;
      result[k].angle = angle;
      if (k == 3)
      {
        result[k].rows = section.node({0.02, 0.15}, "a point");
        result[k].component = 2;
        continue;
      }
      result[k].half_angle = 0.1;
      for (const auto c : {RevolvedSection::axial, RevolvedSection::radial, RevolvedSection::circumferential})
        result[k].rows[c] = section.mean_over(3, -0.01, 0.01, c);
    }
    return result;
  }

  ModeParameters modes()
  {
    ModeParameters parameters;
    parameters.upper_frequency = 6000;
    parameters.damping_0 = 0.004;
    parameters.damping_1 = 0.01;
    parameters.damping_2 = 0.002;
    return parameters;
  }

  constexpr unsigned int n_waves = 12;
} // namespace

TEST(RevolvedResponse, ModesAndDirectSolutions)
{
  const RevolvedSection section = disc();
  const Points at = points(section, 0.3);
  RevolvedResponse response(section, at, modes(), n_waves, MPI_COMM_SELF);
  const std::vector<double> frequency = {0.1, 700, 1500, 3100};
  const auto direct = response.direct(frequency), modal = response.modal(true, 0, frequency);
  const unsigned int m = at.size();
  double worst = 0;
  for (unsigned int k = 0; k < frequency.size(); ++k)
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
      {
        const double size = std::sqrt(std::abs(direct[k][i * m + i]) * std::abs(direct[k][j * m + j]));
        EXPECT_LT(std::abs(direct[k][i * m + j] - direct[k][j * m + i]), 1e-10 * size) << "reciprocity";
        worst = std::max(worst, std::abs(modal[k][i * m + j] - direct[k][i * m + j]) / size);
      }
  EXPECT_LT(worst, 2e-3);
  EXPECT_GT(response.n_modes(0), 10u);
  RecordProperty("largest difference of modes", std::to_string(worst));
  // a mode fewer is seen
  const auto fewer = response.modal(true, 1000, {3100});
  EXPECT_GT(std::abs(fewer[0][0] - direct[3][0]), 1e-3 * std::abs(direct[3][0]));
}

// Forces along x and z at an angle are those at the contact, turned.
TEST(RevolvedResponse, TurnsAroundTheAxle)
{
  const RevolvedSection section = disc();
  const double angle = 1.1, c = std::cos(angle), s = std::sin(angle);
  const Points here = points(section, 0), there = points(section, angle);
  const auto a = RevolvedResponse(section, here, modes(), n_waves, MPI_COMM_SELF).direct({900})[0],
             b = RevolvedResponse(section, there, modes(), n_waves, MPI_COMM_SELF).direct({900})[0];
  // rows z, x, y, y: the normal there is (-sin, cos) in x and z, the tangent (cos, sin)
  const double turn[4][4] = {{c, s, 0, 0}, {-s, c, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int j = 0; j < 4; ++j)
    {
      std::complex<double> expected = 0;
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int l = 0; l < 4; ++l)
          expected += turn[i][k] * a[k * 4 + l] * turn[j][l];
      EXPECT_LT(std::abs(b[i * 4 + j] - expected), 1e-9 * std::abs(a[0])) << i << ", " << j;
    }
}

namespace
{
  /// Largest difference, over the geometric mean of both driving points.
  double difference(const std::vector<Receptance> &one, const std::vector<Receptance> &other,
                    const bool transposed = false)
  {
    double result = 0;
    for (unsigned int k = 0; k < one.size(); ++k)
    {
      const unsigned int m = std::lround(std::sqrt(double(one[k].size())));
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < m; ++j)
        {
          const double size = std::sqrt(std::abs(one[k][i * m + i]) * std::abs(one[k][j * m + j]));
          result = std::max(
              result, std::abs(one[k][i * m + j] - other[k][transposed ? j * m + i : i * m + j]) / size);
        }
    }
    return result;
  }

  constexpr double Omega = 60;
} // namespace

// Turning hardly at all is standing still, by modes, directly, and with the damping of a run in time.
TEST(RevolvedResponse, HardlyTurning)
{
  const RevolvedSection section = disc();
  const Points at = points(section, 0.3);
  const std::vector<double> frequency = {0.1, 700, 1500, 3100};
  RevolvedResponse still(section, at, modes(), n_waves, MPI_COMM_SELF),
      turning(section, at, modes(), n_waves, MPI_COMM_SELF, 1e-9);
  EXPECT_FALSE(still.turns());
  EXPECT_TRUE(turning.turns());
  EXPECT_EQ(still.n_modes(0), turning.n_modes(0));
  EXPECT_LT(difference(still.direct(frequency), turning.direct(frequency)), 1e-10);
  for (const bool hysteretic : {false, true})
    EXPECT_LT(difference(still.modal(hysteretic, 0, frequency), turning.modal(hysteretic, 0, frequency)),
              1e-10);
}

// Modes of the disc at rest against direct solutions, both turning; turned the other way it answers in the other direction.
TEST(RevolvedResponse, ModesAndDirectSolutionsOfATurningBody)
{
  const RevolvedSection section = disc();
  const Points at = points(section, 0.3);
  const std::vector<double> frequency = {0.1, 40, 700, 1500, 3100};
  RevolvedResponse forward(section, at, modes(), n_waves, MPI_COMM_SELF, Omega),
      backward(section, at, modes(), n_waves, MPI_COMM_SELF, -Omega);
  const auto direct = forward.direct(frequency), modal = forward.modal(true, 0, frequency);
  EXPECT_LT(difference(direct, modal), 2e-3);
  RecordProperty("largest difference of modes", std::to_string(difference(direct, modal)));
  EXPECT_LT(difference(direct, backward.direct(frequency), true), 1e-9);
  EXPECT_LT(difference(modal, backward.modal(true, 0, frequency), true), 1e-9);
  EXPECT_LT(difference(forward.modal(false, 0, frequency), backward.modal(false, 0, frequency), true), 1e-9);
  EXPECT_GT(difference(direct, direct, true), 1e-2) << "reciprocity is lost";
  // far beyond any wheel a wave stands still
  EXPECT_THROW(RevolvedResponse(section, at, modes(), n_waves, MPI_COMM_SELF, 1e4).direct({700}), InputError);
}

// The poles of the free body that turns (bodies/rolling_modes.h), of modes far above, are where a response with little loss has
// its peaks.
TEST(RevolvedResponse, PeaksAreThePolesOfTheTurningBody)
{
  const RevolvedSection section = small_disc(1e-6);
  const Points at = {points(section, 0.3).back()};
  ModeParameters wanted;
  wanted.upper_frequency = 40000;
  wanted.damping_0 = wanted.damping_1 = wanted.damping_2 = 0;
  RevolvedResponse response(section, at, wanted, 3, MPI_COMM_SELF, Omega);

  const RevolvedReduction reduction(
      std::unique_ptr<const RevolvedSection>(new RevolvedSection(small_disc(0))), "disc", 0.25, 0., {},
      MPI_COMM_SELF);
  SurfaceShapes shapes;
  RevolvedShapes on_section;
  FlowReduction flow;
  const ModalReduction found = reduction.modes(wanted, {0.25, 0.2}, shapes, on_section, &flow);
  BodyInContact free_body;
  free_body.omega = found.omega;
  free_body.damping_ratio.assign(found.omega.size(), 0.);
  free_body.trace.reinit(0, found.omega.size());
  const BodyInContact turning = rolling_modes(free_body, flow, Omega);

  double apart = 0;
  for (const std::string label : {"axial(0,2) backward", "axial(0,2) forward", "axial(0,3) backward",
                                  "axial(0,3) forward", "axial(0,0)"})
  {
    const auto pole = std::find(turning.labels.begin(), turning.labels.end(), label);
    ASSERT_TRUE(pole != turning.labels.end()) << label;
    const double f = turning.poles[pole - turning.labels.begin()].imag() / (2 * dealii::numbers::PI);
    // a simple pole: 1 / H is a straight line in the square of the frequency
    const double step = 1e-6 * f;
    const auto H = response.direct({f - step, f + step});
    const std::complex<double> low = 1. / H[0][0], high = 1. / H[1][0];
    const std::complex<double> root = (f - step) - low * 2. * step / (high - low);
    EXPECT_NEAR(root.real(), f, 1e-4) << label;
    EXPECT_NEAR(root.imag(), 0.5e-6 * f, 0.1e-6 * f) << label;
    RecordProperty(label, std::to_string(root.real() - f));
    if (label.find("(0,2)") != std::string::npos)
      apart = f - apart;
  }
  EXPECT_NEAR(apart, 2 * 2 * Omega / (2 * dealii::numbers::PI), 0.02 * apart);
}

// With the damping of a run in time it is the sum over the poles that a contact gets (bodies/rolling_modes.h).
TEST(RevolvedResponse, DampingInTimeIsTheSumOverPoles)
{
  const RevolvedSection section = disc();
  Points at = points(section, 0);
  at.pop_back();
  RevolvedReduction::Contact contact;
  ContactGrid &grid = contact.grid;
  grid.n_x = grid.n_y = 1;
  grid.x_first = grid.y_first = 0;
  grid.spacing_x = grid.spacing_y = 0.02;
  for (RevolvedPoint &point : at)
    point.half_angle = std::asin(0.5 * grid.spacing_x / 0.25);
  contact.tread = 3;
  contact.material = {ElasticMaterial().young_modulus, ElasticMaterial().poisson_ratio};
  contact.n_harmonics = n_waves;
  contact.surface_height = {0.};
  const RevolvedReduction reduction(std::unique_ptr<const RevolvedSection>(new RevolvedSection(disc())),
                                    "disc", 0.25, 0., contact, MPI_COMM_SELF);
  SurfaceShapes shapes;
  RevolvedShapes on_section;
  FlowReduction flow;
  const ModalReduction found = reduction.modes(modes(), {0.25, 0.2}, shapes, on_section, &flow);
  ReducedBody body = combine(reduction.statics(), &found);
  // what the material itself loses, equal in all of it
  for (double &ratio : body.damping_ratio)
    ratio += 0.005;
  const BodyInContact turning = rolling_modes(body, flow, Omega);
  const std::vector<double> frequency = {40, 700, 1500, 3100};
  const auto response = [&](const double rotation)
  {
    return RevolvedResponse(section, at, modes(), n_waves, MPI_COMM_SELF, rotation)
        .modal(false, 0, frequency);
  };
  const auto moved = response(Omega), still = response(0);
  for (unsigned int k = 0; k < frequency.size(); ++k)
  {
    const std::complex<double> s(0, 2 * dealii::numbers::PI * frequency[k]);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
      {
        std::complex<double> expected = 0;
        for (unsigned int pole = 0; pole < turning.n_poles(); ++pole)
        {
          const std::complex<double> residue = turning.right(i, pole) * turning.left(j, pole);
          expected +=
              residue / (s - turning.poles[pole]) + std::conj(residue) / (s - std::conj(turning.poles[pole]));
        }
        for (unsigned int mode = 0; mode < body.omega.size(); ++mode)
          expected -= body.trace(i, mode) * body.trace(j, mode) /
                      (s * s + 2. * body.damping_ratio[mode] * body.omega[mode] * s +
                       body.omega[mode] * body.omega[mode]);
        const std::complex<double> difference = moved[k][i * 3 + j] - still[k][i * 3 + j];
        EXPECT_LT(std::abs(difference - expected), 1e-9 * std::abs(moved[k][i * 3 + i])) << i << ", " << j;
      }
  }
}

// Dampers of a wheel in its frequency response: Den Hartog's fixed points, nothing without mass or spring, absorbers in number
// against a ring, direct solutions against modes and against the modes of a damped wheel, layers against a loss factor.
#include "small_disc.h"

#include <vibrocontact/analyses/frequency_response/revolved_response.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace vibrocontact;

namespace
{
  constexpr unsigned int n_few_waves = 7;

  RevolvedSection disc_of(const double loss_factor)
  {
    run_log().set_screen(false);
    return small_disc(loss_factor);
  }

  /// On the rim along z, and at a node of the side along y elsewhere.
  std::vector<RevolvedPoint> two_points(const RevolvedSection &section)
  {
    std::vector<RevolvedPoint> result(2);
    result[0].half_angle = 0.1;
    for (const auto c : {RevolvedSection::axial, RevolvedSection::radial, RevolvedSection::circumferential})
      result[0].rows[c] = section.mean_over(3, -0.01, 0.01, c);
    result[1].rows = section.node({0.02, 0.15}, "a point");
    result[1].angle = 0.7;
    result[1].component = 2;
    return result;
  }

  WheelDamper damper(const std::string &kind, const double mass, const double frequency, const double loss)
  {
    WheelDamper result;
    result.name = kind;
    result.kind = kind;
    result.mass = mass;
    result.frequency = frequency;
    result.loss_factor = loss;
    result.axial = 0.02;
    result.radius = 0.2;
    return result;
  }

  ModeParameters undamped(const double upper_frequency)
  {
    ModeParameters modes;
    modes.upper_frequency = upper_frequency;
    modes.damping_0 = modes.damping_1 = modes.damping_2 = 0;
    return modes;
  }

  RevolvedResponse response(const RevolvedSection &section, const std::vector<WheelDamper> &dampers,
                            const double upper_frequency = 20000)
  {
    return RevolvedResponse(section, two_points(section), undamped(upper_frequency), n_few_waves,
                            MPI_COMM_SELF, 0., wheel_attachments(section, dampers, "wheel/Wheel/Damper"));
  }

  /// Over the geometric mean of both driving points.
  double apart(const std::vector<Receptance> &one, const std::vector<Receptance> &other)
  {
    double result = 0;
    for (unsigned int k = 0; k < one.size(); ++k)
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          result = std::max(result, std::abs(one[k][i * 2 + j] - other[k][i * 2 + j]) /
                                        std::sqrt(std::abs(one[k][3 * i]) * std::abs(one[k][3 * j])));
    return result;
  }

  const std::vector<double> at = {50, 610, 900, 1500, 2400};
} // namespace

// At two frequencies what a mass on its spring answers does not depend on the absorber's loss; tuned to 1 / (1 + mu) both
// answers are sqrt(1 + 2 / mu) of the static one (Den Hartog 1956, ch. 3.3).
TEST(WheelAttachments, FixedPointsOfDenHartog)
{
  const double w = 100, mass = 50, mu = 0.05, height = std::sqrt(1 + 2 / mu);
  for (const double eta : {0., 0.1, 0.4, 2.})
    for (const double sign : {-1., 1.})
    {
      const double omega = w * std::sqrt((1 + sign * std::sqrt(mu / (2 + mu))) / (1 + mu));
      Receptance H = {1 / (mass * (w * w - omega * omega))};
      attach({{{mu * mass, w / (1 + mu), eta}, 0}}, 1., omega, H);
      EXPECT_NEAR(std::abs(H[0]) * mass * w * w, height, 1e-9 * height) << "eta " << eta;
    }
  // at the absorber's own frequency the body stands still
  Receptance H = {1 / (mass * (w * w - 80 * 80))};
  attach({{{1., 80., 0.}, 0}}, 1., 80., H);
  EXPECT_LT(std::abs(H[0]), 1e-15);
}

TEST(WheelAttachments, NoMassAndNoSpring)
{
  const RevolvedSection section = disc_of(0.01);
  RevolvedResponse bare = response(section, {});
  WheelDamper few = damper("absorber", 0., 900, 0.1), loose = damper("absorber", 5., 1e-7, 0.1);
  few.number = loose.number = 3;
  // along the other two directions masses ride with the wheel
  WheelAttachments springs = wheel_attachments(section, {loose, damper("ring", 5, 1e-7, 0.)}, "");
  for (auto *const all : {&springs.absorbers, &springs.rings})
    for (Attachment &one : *all)
      one.mass = one.omega > 0 ? one.mass : 0.;
  RevolvedResponse massless = response(section, {few, damper("ring", 0, 700, 0.3)}),
                   springless(section, two_points(section), undamped(6000), n_few_waves, MPI_COMM_SELF, 0.,
                              springs);
  const auto expected = bare.direct(at);
  EXPECT_LT(apart(expected, massless.direct(at)), 1e-12);
  EXPECT_LT(apart(expected, springless.direct(at)), 1e-12);
  // by modes their places bring more Ritz vectors
  EXPECT_LT(apart(bare.modal(true, 0, at), massless.modal(true, 0, at)), 1e-5);
  RevolvedResponse heavy = response(section, {damper("absorber", 5, 900, 0.1)});
  EXPECT_GT(apart(expected, heavy.direct(at)), 0.1);
}

// n waves and n' feel 16 absorbers as a ring unless n +- n' is a multiple of 16.
TEST(WheelAttachments, ManyAbsorbersAreARing)
{
  const RevolvedSection section = disc_of(0.01);
  for (const double frequency : {0., 900.})
    for (const char *direction : {"axial", "radial", "circumferential"})
    {
      WheelDamper many = damper("absorber", 8. / 16, frequency, 0.2), one = damper("ring", 8, frequency, 0.2);
      many.number = 16;
      many.first_angle = 11;
      many.direction = one.direction = direction;
      RevolvedResponse absorbers = response(section, {many}, 6000), ring = response(section, {one}, 6000);
      EXPECT_LT(apart(ring.direct(at), absorbers.direct(at)), 1e-9) << direction;
      EXPECT_LT(apart(ring.modal(true, 0, at), absorbers.modal(true, 0, at)), 1e-9) << direction;
      EXPECT_LT(apart(ring.modal(false, 0, at), absorbers.modal(false, 0, at)), 1e-7) << direction;
    }
}

// The reduced modes with masses attached to them, as a run in time has them (reduction/damped_wheel.h), against forces of the
// same masses on the elements: without any loss both say the same as far as modes follow a mass at one point.
TEST(WheelAttachments, ModesOfTheDampedWheel)
{
  WheelDamper few = damper("absorber", 2, 900, 0.);
  few.number = 3;
  const std::vector<WheelDamper> both = {few, damper("ring", 4, 1300, 0.)};
  const RevolvedSection section = disc_of(0);
  std::vector<double> errors;
  for (const double upper_frequency : {10e3, 180e3})
  {
    RevolvedResponse damped = response(section, both, upper_frequency);
    errors.push_back(apart(damped.direct(at), damped.modal(false, 0, at)));
    RecordProperty("modes of the damped wheel to " + std::to_string(upper_frequency),
                   std::to_string(errors.back()));
  }
  EXPECT_LT(errors[0], 0.1);
  EXPECT_LT(errors[1], 0.01);
  EXPECT_LT(errors[1], 0.2 * errors[0]);

  WheelDamper lossy = few;
  lossy.loss_factor = 0.3;
  const RevolvedSection with_loss = disc_of(0.01);
  RevolvedResponse other = response(with_loss, {lossy, damper("ring", 4, 1300, 0.2)}, 12000);
  const auto exact = other.direct(at), by_modes = other.modal(true, 0, at);
  EXPECT_LT(apart(exact, by_modes), 2e-3);
  RecordProperty("modes and Ritz vectors", std::to_string(apart(exact, by_modes)));
  for (const Receptance &H : exact)
    EXPECT_LT(std::abs(H[1] - H[2]), 1e-10 * std::sqrt(std::abs(H[0]) * std::abs(H[3]))) << "reciprocity";
}

// A layer all over the disc is the loss factor of its material, also while it turns.
TEST(WheelAttachments, LayerEverywhere)
{
  const RevolvedSection lossy = disc_of(0.03), lossless = disc_of(0);
  const auto section_response = [](const RevolvedSection &section, const std::vector<WheelDamper> &dampers)
  {
    ModeParameters modes;
    modes.upper_frequency = 6000;
    return RevolvedResponse(section, two_points(section), modes, n_few_waves, MPI_COMM_SELF, 50.,
                            wheel_attachments(section, dampers, "wheel/Wheel/Damper"));
  };
  RevolvedResponse material = section_response(lossy, {}),
                   layer = section_response(lossless, {damper("layer", 0, 0, 0.03)});
  EXPECT_LT(apart(material.direct(at), layer.direct(at)), 1e-12);
  for (const bool hysteretic : {true, false})
    EXPECT_LT(apart(material.modal(hysteretic, 0, at), layer.modal(hysteretic, 0, at)), 1e-9);
  WheelDamper nowhere = damper("layer", 0, 0, 0.03), off = damper("absorber", 1, 900, 0);
  nowhere.inner_radius = 0.3;
  off.radius = 0.4;
  EXPECT_THROW(section_response(lossless, {nowhere}), InputError);
  EXPECT_THROW(wheel_attachments(lossless, {off}, "wheel/Wheel/Damper"), InputError);
}

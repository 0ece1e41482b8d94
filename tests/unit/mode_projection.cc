// The amplitudes of the contact's modes in a run in time: each grows by the rate of its own root, whatever else moves.

#include "flutter.h"

#include <vibrocontact/analyses/transient/mode_recorder.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  /// The modes of the flutter pair from the push on, m/s across, to the end [s].
  nlohmann::ordered_json followed(const double push, const double end, const double from)
  {
    const ContactPair pair = Flutter::pair(5e-4);
    TransientParameters parameters;
    parameters.time_step = 4e-6;
    parameters.end_time = end;
    ContactParameters contact;
    contact.friction = Flutter::friction;
    DynamicState state = initial_state(parameters, contact, {}, pair, Flutter::drive(0));
    RollingEquilibrium equilibrium;
    equilibrium.contact = state.contact;
    equilibrium.friction.assign(Flutter::n_points, Flutter::friction);
    equilibrium.speed = Flutter::speed;
    ModeRecorder recorder(ModeProjection(pair, creep_schemes().front(), equilibrium, state, 6), ".");
    for (const double amplitude :
         ModeProjection(pair, creep_schemes().front(), equilibrium, state, 6).amplitudes(state))
      EXPECT_EQ(amplitude, 0);
    for (unsigned int k = 0; k < 2; ++k)
      state.v[k] += pair.trace(Flutter::lateral, k) * push;
    recorder.add(state);
    transient(parameters, contact, {}, pair, Flutter::drive, state,
              [&](const DynamicState &now, const TransientResult &)
              {
                recorder.add(now);
                return true;
              });
    return recorder.json(from, end);
  }
} // namespace

TEST(ModeProjection, EachModeGrowsByItsRoot)
{
  const auto modes = followed(1e-4, 0.02, 0.002);
  ASSERT_EQ(modes.size(), 2u);
  for (const auto &mode : modes)
  {
    std::printf("%s\n", mode.dump().c_str());
    ASSERT_TRUE(mode["growth_1_s"].is_number());
    EXPECT_NEAR(mode["growth_1_s"].get<double>() / mode["root_growth_1_s"].get<double>(), 1, 5e-3);
  }
  EXPECT_GT(modes[0]["root_growth_1_s"].get<double>(), 10);
  EXPECT_LT(modes[1]["root_growth_1_s"].get<double>(), -10);
}

// The amplitude grows out of 0.03 m/s and stays where sticking bounds it: no number of growth over both.
TEST(ModeProjection, NoGrowthOfWhatSaturates)
{
  const auto modes = followed(0.03, 0.2, 0);
  std::printf("%s\n", modes[0].dump().c_str());
  EXPECT_TRUE(modes[0]["growth_1_s"].is_null());
  EXPECT_GT(modes[0]["residual"].get<double>(), 0.05);
}

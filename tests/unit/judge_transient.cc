// What the steps of a transient did to it: motions that are too fast for them are no result.
// A march that ends early, as at the edge of the contact grid: the answer says it last, and an energy account that does not close
// blames no step.
#include <vibrocontact/analyses/transient/judge_transient.h>
#include <vibrocontact/analyses/transient/transient_output.h>

#include "pi.h"

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  Results judged(const bool converged)
  {
    TransientResult result;
    result.converged = converged;
    result.time = 0.5;
    result.energy.initial = result.energy.available = 1; // and nothing of it is left
    Results results;
    judge_transient(result, {}, false, nullptr, false, results);
    return results;
  }
} // namespace

TEST(JudgeTransient, MotionsTooFastForTheSteps)
{
  const std::vector<double> omega = {0, 2 * pi * 10, 2 * pi * 900, 2 * pi * 1200};
  // of each mode mean kinetic energies [J] and how much larger the other energy is
  const auto failures = [&](const std::vector<double> &kinetic, const double ratio = 1)
  {
    TransientResult result;
    result.time = 1;
    result.steps = 1000;
    result.energy.available = 100;
    for (unsigned int k = 0; k < omega.size(); ++k)
      result.modal_motions.push_back(
          {0.5, 0.5 * 3, 0.5 * (9 + (k > 0 ? 2 * ratio * kinetic[k] / (omega[k] * omega[k]) : 0)),
           kinetic[k]});
    Results results;
    judge_transient(result, omega, false, nullptr, false, results);
    return results.failures;
  };
  // 1.1 and 0.8 steps in a period, 100 of the slow one
  EXPECT_TRUE(failures({0, 0, 0, 0}).empty());
  EXPECT_TRUE(failures({3, 5, 4, 3}).empty());
  const auto fast = failures({0, 4, 5, 1});
  ASSERT_EQ(fast.size(), 1u);
  EXPECT_NE(fast[0].message.find("60 % of the kinetic energy"), std::string::npos) << fast[0].message;
  EXPECT_NE(fast[0].message.find("900 Hz, has 1.11111. Take a Transient/Time step of 0.000138889 s"),
            std::string::npos)
      << fast[0].message;
  // rounding at rest, and what follows a slow load
  EXPECT_TRUE(failures({0, 4e-30, 5e-30, 1e-30}).empty());
  EXPECT_TRUE(failures({0, 0, 5, 1}, 50).empty());
}

TEST(JudgeTransient, AVariationThatAnotherStepChanges)
{
  TransientResult result;
  result.time = 2;
  result.steps = 100;
  // 1000 N but for +-10 N
  result.impulse = 2000;
  result.force_square = 2 * (1e6 + 50);
  EXPECT_NEAR(result.rms_variation(), std::sqrt(50.), 1e-6);
  StepErrors errors;
  errors.time = 2;
  errors.rms_variation = 0.3;
  Results results;
  judge_transient(result, {}, false, &errors, false, results);
  ASSERT_EQ(results.failures.size(), 1u);
  EXPECT_NE(results.failures[0].message.find("30 % of the rms variation of the normal force"),
            std::string::npos);
  EXPECT_EQ(results.analyses["transient"]["estimated_error_rms_variation"], 0.3);
}

TEST(EndedEarly, TheStepIsNotBlamed)
{
  const Results whole = judged(true), early = judged(false);
  ASSERT_EQ(whole.failures.size(), 1u);
  EXPECT_NE(whole.failures[0].message.find("time step is too long"), std::string::npos);
  EXPECT_TRUE(early.failures.empty());
  ASSERT_EQ(early.warnings.size(), 1u);
  EXPECT_EQ(early.warnings[0].message.find("time step"), std::string::npos) << early.warnings[0].message;
  EXPECT_NE(early.warnings[0].message.find("ended early"), std::string::npos) << early.warnings[0].message;
}

TEST(EndedEarly, TheAnswerSaysItLast)
{
  nlohmann::ordered_json transient = {{"time_s", 0.5}, {"impulse_Ns", 1.}, {"rms_normal_force_N", 2.}};
  EXPECT_EQ(transient_answer(transient).back().find("EARLY"), std::string::npos);
  transient["ended_early"] = "the contact reaches the side.";
  EXPECT_EQ(transient_answer(transient).back(), "ENDED EARLY, at 0.5 s: the contact reaches the side.");
}

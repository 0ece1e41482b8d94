// A march that ends early, as at the edge of the contact grid: the answer says it last, and an energy account that does not close
// blames no step.
#include <vibrocontact/analyses/transient/judge_transient.h>
#include <vibrocontact/analyses/transient/transient_output.h>

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
    judge_transient(result, nullptr, false, results);
    return results;
  }
} // namespace

TEST(EndedEarly, TheStepIsNotBlamed)
{
  const Results whole = judged(true), early = judged(false);
  ASSERT_EQ(whole.failures.size(), 1u);
  EXPECT_NE(whole.failures[0].message.find("time step is too long"), std::string::npos);
  EXPECT_TRUE(early.failures.empty());
  ASSERT_EQ(early.warnings.size(), 1u);
  EXPECT_EQ(early.warnings[0].find("time step"), std::string::npos) << early.warnings[0];
  EXPECT_NE(early.warnings[0].find("ended early"), std::string::npos) << early.warnings[0];
}

TEST(EndedEarly, TheAnswerSaysItLast)
{
  nlohmann::ordered_json transient = {{"time_s", 0.5}, {"impulse_Ns", 1.}, {"rms_normal_force_N", 2.}};
  EXPECT_EQ(transient_answer(transient).back().find("EARLY"), std::string::npos);
  transient["ended_early"] = "the contact reaches the side.";
  EXPECT_EQ(transient_answer(transient).back(), "ENDED EARLY, at 0.5 s: the contact reaches the side.");
}

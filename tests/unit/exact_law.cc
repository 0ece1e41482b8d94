// The exact unilateral law on the axial bar with a massless contact node: distance of every basis to shooting, penalties that tend
// to it.

#include "axial_bar.h"

#include <vibrocontact/analyses/periodic/periodic_error.h>
#include <vibrocontact/contact/laws/normal_laws.h>

#include <gtest/gtest.h>

#include <map>

using namespace vibrocontact;

TEST(ExactLaw, EveryBasisFindsItAndHaarIsNotTheBest)
{
  const auto law = create_normal_law("signorini");
  for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
  {
    const ForcedBody body = axial_bar(c, true);
    const PeriodicReference reference = periodic_reference(body, law, c.excitation(), 4096);
    std::map<std::string, double> errors;
    for (const auto &[trial, weighting] :
         std::vector<std::pair<std::string, std::string>>{{"fourier", "fourier"},
                                                          {"bspline", "bspline"},
                                                          {"daubechies6", "daubechies6"},
                                                          {"daubechies6", "fourier"},
                                                          {"haar", "fourier"},
                                                          {"haar", "bspline"}})
    {
      BalanceSettings settings;
      settings.trial = trial;
      settings.weighting = weighting;
      settings.n_functions = 63;
      PeriodicBalance balance(body, law, settings);
      balance.set_force(c.excitation());
      const PeriodicSolution solution = balance.solve();
      const std::string name = trial + ":" + weighting;
      ASSERT_TRUE(solution.converged) << name << " " << c.frequency;
      const PeriodicMotion motion = sample_motion(balance, solution, 4096);
      const PeriodicErrors e = errors_of(balance, solution, motion, reference);
      std::printf(
          "%4.0f Hz %-24s tip %.2e, force %.2e, mid-points %.2e, impulse %.1e, penetration %.1e of the "
          "gap\n",
          c.frequency, name.c_str(), e.displacement, e.contact_force, e.midpoints, e.impulse,
          motion.penetration / c.gap);
      errors[name] = e.displacement;
      if (name == "fourier:fourier")
      {
        EXPECT_LT(e.displacement, 4e-3);
        EXPECT_LT(e.impulse, 5e-3);
        EXPECT_LT(motion.penetration, 2e-2 * c.gap);
      }
    }
    for (const auto &[name, error] : errors)
      if (name.substr(0, 4) != "haar")
        EXPECT_LT(error, 0.6 * std::min(errors["haar:fourier"], errors["haar:bspline"])) << name;
  }
}

TEST(ExactLaw, StiffPenaltiesTendToIt)
{
  for (const AxialBarCase &c : {axial_bar_150(), axial_bar_1275()})
  {
    const ForcedBody body = axial_bar(c, true);
    const PeriodicReference rigid =
        periodic_reference(body, create_normal_law("signorini"), c.excitation(), 1024);
    double before = 0;
    for (const double amplitude : {1e10, 1e11, 1e12})
    {
      const PeriodicReference stiff = periodic_reference(
          body, create_normal_law("exponential penalty", {amplitude, c.exponent}), c.excitation(), 1024);
      const double distance = relative_error(stiff.displacement, rigid.displacement);
      std::printf("%4.0f Hz, %.0e N: tip %.3e, force %.3e\n", c.frequency, amplitude, distance,
                  relative_error(stiff.contact_force, rigid.contact_force));
      if (before > 0)
        EXPECT_NEAR(before / distance, 10, 0.2);
      before = distance;
    }
    EXPECT_LT(before, 2e-5);
  }
}

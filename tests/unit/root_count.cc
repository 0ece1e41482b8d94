// The count of unstable roots against eigenvalues; the order of roots of equal frequency.

#include "random_structure.h"

#include <vibrocontact/analyses/stability/root_count.h>
#include <vibrocontact/base/exceptions.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

TEST(RootCount, IsThatOfTheEigenvalues)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = reduce(s, 30, 1e-3);
  const CreepScheme &scheme = creep_schemes().front();
  int most = 0;
  for (const bool force_given : {false, true})
    for (const double mu : {0., 0.2, 0.6})
    {
      RollingEquilibrium equilibrium = sliding(s.n_points, mu, 100, 0.5);
      equilibrium.force_given = force_given;
      const std::vector<StabilityRoot> roots =
          stability_roots(pair, linearised_contact(pair, scheme, equilibrium, {}));
      int unstable = 0;
      for (const StabilityRoot &root : roots)
        unstable += root.growth > 0 ? (root.frequency > 0 ? 2 : 1) : 0;
      const RootCount count = count_unstable_roots(pair, scheme, equilibrium, roots);
      EXPECT_EQ(count.unstable, unstable) << "friction " << mu;
      EXPECT_LT(std::abs(count.remainder), 1e-2);
      most = std::max(most, unstable);
    }
  EXPECT_GT(most, 0);
}

TEST(RootCount, StuckPointsAtRestAreRefused)
{
  // without rolling nothing resists a stuck point at 0 Hz: its rows are empty there
  const Structure s = structure(90, 4);
  RollingEquilibrium equilibrium = sliding(s.n_points, 0.4, 100, 0);
  equilibrium.contact.status.assign(s.n_points, ContactStatus::stick);
  equilibrium.speed = 0;
  EXPECT_THROW(count_unstable_roots(reduce(s, 30, 1e-3), creep_schemes().front(), equilibrium, {}),
               ConvergenceError);
}

TEST(StabilityRoots, OfEqualFrequencyTheFasterGrowingIsFirst)
{
  std::vector<StabilityRoot> roots;
  for (const double growth : {1., 2., 3., -1.})
    for (const double frequency : {200., 100. * (1 + 1e-12 * growth), 0.})
    {
      StabilityRoot root;
      root.frequency = frequency;
      root.growth = growth;
      roots.push_back(root);
    }
  sort_roots(roots);
  std::vector<double> growth;
  for (unsigned int k = 0; k < 8; ++k)
    growth.push_back(roots[k].growth);
  EXPECT_EQ(growth, (std::vector<double>{3, 2, 1, -1, 3, 2, 1, -1}));
  EXPECT_NEAR(roots[0].frequency, 100, 1e-6);
  EXPECT_EQ(roots[11].frequency, 0);
}

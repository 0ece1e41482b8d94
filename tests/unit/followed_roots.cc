// Roots that are followed from case to case, and their derivatives by left and right vectors: closed form, differences of complete
// solutions, a neighbour that is refused.

#include "held_bar.h"
#include "random_structure.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/body_roots.h>
#include <vibrocontact/coupled_bodies/followed_root.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;

  const CreepScheme &scheme()
  {
    return find_creep_scheme("first-order upwind");
  }

  std::vector<Complex> all_of(const ContactPair &pair, const RollingEquilibrium &about)
  {
    std::vector<Complex> result;
    for (const StabilityRoot &root : stability_roots(pair, linearised_contact(pair, scheme(), about, {})))
      if (root.frequency > 0)
        result.emplace_back(root.growth, 2 * M_PI * root.frequency);
    return result;
  }

  Complex nearest(const std::vector<Complex> &all, const Complex &s)
  {
    return *std::min_element(all.begin(), all.end(),
                             [&](const Complex &a, const Complex &b)
                             { return std::abs(a - s) < std::abs(b - s); });
  }

  double largest(const ComplexMatrix &matrix)
  {
    double result = 0;
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int i = 0; i < matrix.m(); ++i)
        result = std::max(result, std::abs(matrix(i, j)));
    return result;
  }

  RollingEquilibrium rolling(const double mu)
  {
    RollingEquilibrium about = sliding(4, mu, 100, 0.5);
    about.speed = 0.02;
    return about;
  }
} // namespace

TEST(FollowedRoots, TwoModesThatFrictionCouplesHaveTheDerivativeOfTheirQuadratic)
{
  // s^2 + K(mu) of a point that slides along y, K_ab = (psi_n - mu psi_y)_a psi_n_b / W
  ContactPair pair = held_bar(2, 0.);
  pair.omega = {3., 3.1};
  const double normal[] = {1., 0.8}, along[] = {-1.2, 3.}, W = 4., mu = 0.5, h = 1e-3;
  for (unsigned int k = 0; k < 2; ++k)
  {
    pair.trace(0, k) = normal[k];
    pair.trace(2, k) = along[k];
  }
  pair.residual(0, 0) = pair.residual(1, 1) = W;
  pair.residual(2, 2) = 0;
  double K[2][2], dK[2][2];
  for (unsigned int a = 0; a < 2; ++a)
    for (unsigned int b = 0; b < 2; ++b)
    {
      K[a][b] = (a == b ? pair.omega[a] * pair.omega[a] : 0.) + (normal[a] - mu * along[a]) * normal[b] / W;
      dK[a][b] = -along[a] * normal[b] / W;
    }
  const double trace = K[0][0] + K[1][1], d_trace = dK[0][0] + dK[1][1],
               d_determinant =
                   dK[0][0] * K[1][1] + K[0][0] * dK[1][1] - dK[0][1] * K[1][0] - K[0][1] * dK[1][0];
  const ContactReceptance F(pair, scheme(), sliding(1, mu, 10, 1)),
      more(pair, scheme(), sliding(1, mu + h, 10, 1)), less(pair, scheme(), sliding(1, mu - h, 10, 1));
  const std::vector<Complex> roots = all_of(pair, sliding(1, mu, 10, 1));
  ASSERT_EQ(roots.size(), 2u);
  for (const Complex &start : roots)
  {
    const ContactRoot root = contact_root(F, start, {}, true);
    const Complex L = root.s * root.s; // L^2 + trace L + determinant = 0
    const Complex expected = -(d_trace * L + d_determinant) / (2. * L + trace) / (2. * root.s);
    const Complex derivative = -(change_of_root(F, root, more) - change_of_root(F, root, less)) / (2 * h);
    EXPECT_LT(std::abs(derivative - expected), 1e-10 * std::abs(expected));
  }
}

TEST(FollowedRoots, DerivativesAreTheDifferencesOfCompleteSolutions)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = reduce(s, 30, 2e-3);
  const double mu = 0.3, h = 1e-4;
  ContactPair damped = pair, lively = pair;
  for (unsigned int k = 0; k < pair.n_modes(); ++k)
  {
    damped.damping_ratio[k] *= 1 + h;
    lively.damping_ratio[k] *= 1 - h;
  }
  const ContactReceptance F(pair, scheme(), rolling(mu)), more(pair, scheme(), rolling(mu + h)),
      less(pair, scheme(), rolling(mu - h)), more_damped(damped, scheme(), rolling(mu)),
      less_damped(lively, scheme(), rolling(mu));
  const auto expect = [&](const ContactRoot &root, const ContactReceptance &up, const ContactReceptance &down,
                          const std::vector<Complex> &ups, const std::vector<Complex> &downs)
  {
    const Complex derivative = -(change_of_root(F, root, up) - change_of_root(F, root, down)) / (2 * h),
                  difference = (nearest(ups, root.s) - nearest(downs, root.s)) / (2 * h);
    // beside the round-off of eigenvalues
    EXPECT_LT(std::abs(derivative - difference), 1e-5 * std::abs(difference) + 2e-10 * std::abs(root.s) / h)
        << root.s;
  };
  unsigned int n = 0;
  for (const Complex &start : all_of(pair, rolling(mu)))
  {
    const ContactRoot root = contact_root(F, start, {}, true);
    expect(root, more, less, all_of(pair, rolling(mu + h)), all_of(pair, rolling(mu - h)));
    expect(root, more_damped, less_damped, all_of(damped, rolling(mu)), all_of(lively, rolling(mu)));
    ++n;
  }
  EXPECT_GT(n, 20u);
}

TEST(FollowedRoots, FollowingEndsAtTheRootsOfTheCompleteSolution)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = reduce(s, 30, 2e-3);
  const std::vector<PatchReceptance> receptances = patch_receptances(pair, nullptr);
  const auto at = [&](const double mu)
  { return ContactReceptance(pair, scheme(), rolling(mu), receptances, nullptr); };
  const ContactReceptance first = at(0.1);
  std::vector<FollowedRoot> roots;
  std::vector<Complex> before;
  for (const Complex &s : all_of(pair, rolling(0.1)))
  {
    roots.push_back(followed_root(first, contact_root(first, s)));
    before.push_back(s);
  }
  double farthest = 0;
  for (unsigned int step = 1; step <= 100; ++step)
  {
    const double mu = 0.1 + 0.004 * step;
    const ContactReceptance F = at(mu);
    std::vector<Complex> starts;
    for (unsigned int i = 0; i < roots.size(); ++i)
      starts.push_back(step == 1 ? roots[i].s : 2. * roots[i].s - before[i]);
    const std::vector<double> reach = reaches(starts);
    for (unsigned int i = 0; i < roots.size(); ++i)
    {
      before[i] = roots[i].s;
      roots[i] = followed_root(F, next_root(roots[i], F, starts[i], reach[i]));
      EXPECT_LT(roots[i].residual, 1e-11);
    }
    const std::vector<Complex> all = all_of(pair, rolling(mu));
    ASSERT_EQ(all.size(), roots.size());
    for (const FollowedRoot &root : roots)
      farthest = std::max(farthest, std::abs(nearest(all, root.s) - root.s) / std::abs(root.s));
  }
  EXPECT_LT(farthest, 1e-9);
  // each its own
  for (unsigned int i = 0; i < roots.size(); ++i)
    for (unsigned int j = 0; j < i; ++j)
      EXPECT_GT(std::abs(roots[i].s - roots[j].s), 1e-6 * std::abs(roots[i].s));
}

TEST(FollowedRoots, ANeighbourIsRefused)
{
  const Structure s = structure(90, 4);
  const ContactPair pair = reduce(s, 30, 2e-3);
  const ContactReceptance F(pair, scheme(), rolling(0.3));
  const std::vector<Complex> all = all_of(pair, rolling(0.3));
  const FollowedRoot root = followed_root(F, contact_root(F, all[0]));
  EXPECT_LT(std::abs(next_root(root, F, 1.01 * all[0], 0.02 * std::abs(all[0])).s - all[0]),
            1e-8 * std::abs(all[0]));
  EXPECT_THROW(next_root(root, F, 1.01 * all[0], 0.005 * std::abs(all[0])), ConvergenceError);
}

TEST(FollowedRoots, TheListedRootAndThoseNearestToGrowing)
{
  std::vector<StabilityRoot> all(7);
  const double frequency[] = {10, 20, 0, 30, 40, 50, 60},
               divergence[] = {-1e-2, 1e-3, 1, -1e-4, -3e-2, 2e-3, -2e-2};
  for (unsigned int i = 0; i < 7; ++i)
  {
    all[i].frequency = frequency[i];
    all[i].divergence_rate = divergence[i];
    all[i].growth = divergence[i] * 2 * M_PI * frequency[i];
  }
  // all that grow, three beside them, none without oscillation
  EXPECT_EQ(growing_and_nearest(all), (std::vector<unsigned int>{5, 1, 3, 0, 6}));
  EXPECT_TRUE(is_at(value_of(all[1]) * (1 + 1e-7), all[1]));
  EXPECT_FALSE(is_at(value_of(all[1]) * (1 + 1e-5), all[1]));
}

// Two bodies: what the second and the contact answer to the first.
TEST(FollowedRoots, TheAnswerOfTheRestHoldsFarFromTheAxisToo)
{
  const Structure s = structure(90, 4);
  ContactPair pair = reduce(s, 30, 1e-2);
  for (unsigned int k = 0; k < pair.n_modes(); k += 2)
    pair.body[k] = 2;
  const auto equations = std::make_shared<const ContactReceptance>(pair, scheme(), rolling(0.3));
  AnswerOfRest rest(equations);
  const double w = pair.omega[10];
  for (const double divergence : {0., 1e-4, -5e-3, -0.05, 0.05, -0.3})
    for (const double factor : {0.93, 1., 1.01})
    {
      const Complex at = w * factor * Complex(divergence, 1);
      ComplexMatrix error = rest.at(at);
      const ComplexMatrix exact = equations->seen_by_first(at);
      error.add(-1., exact);
      EXPECT_LT(largest(error), 3e-5 * largest(exact)) << divergence << " " << factor;
    }
  EXPECT_THROW(rest.at(Complex(-1, 0)), ConvergenceError);
  EXPECT_THROW(rest.at(Complex(0, NAN)), ConvergenceError);
}

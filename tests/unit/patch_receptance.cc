// What poles answer in the contact's own equations: as the modes that they stand for, and in shapes of motion, force and gradient
// that differ, as of a body that turns, by the eigenvalues of the linearised contact.

#include "matrix_difference.h"
#include "random_structure.h"

#include <vibrocontact/coupled_bodies/contact_root.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;

  const CreepScheme &first_order()
  {
    return find_creep_scheme("first-order upwind");
  }

  ContactPair damped_pair(const Structure &s)
  {
    ContactPair pair = reduce(s, 30, 0);
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      pair.damping_ratio[k] = 0.002 + 0.001 * (k % 3);
    return pair;
  }

  ContactPair in_poles(const ContactPair &modes)
  {
    ContactPair pair = modes;
    static_cast<BodyInContact &>(pair) = by_poles(modes);
    pair.body.clear();
    pair.trace.reinit(modes.trace.m(), 0);
    pair.body_of_pole.assign(pair.n_poles(), 1);
    pair.labels.resize(pair.n_poles(), "pole");
    return pair;
  }

  HystereticLoss without_loss(const ContactPair &pair)
  {
    HystereticLoss loss;
    loss.modal.reinit(pair.n_modes(), pair.n_modes());
    loss.residual = entries_as<Complex>(pair.residual);
    return loss;
  }

  RollingEquilibrium rolling(const Structure &s)
  {
    RollingEquilibrium about = sliding(s.n_points, 0.4, 100, 0.005);
    about.speed = 0.2;
    return about;
  }
} // namespace

TEST(PatchReceptance, PolesAnswerAsTheModesThatTheyStandFor)
{
  const Structure s = structure(90, 4);
  const ContactPair modes = damped_pair(s), poles = in_poles(modes);
  ASSERT_EQ(poles.n_poles(), modes.n_modes());
  const ContactReceptance F(modes, first_order(), rolling(s)), G(poles, upwind(), rolling(s));
  for (const Complex &s_k : {Complex(0.01, 0.7), Complex(-0.02, 2.), Complex(0.3, 5.)})
  {
    EXPECT_LT(difference(F.value(s_k), G.value(s_k)), 1e-9);
    EXPECT_LT(difference(F.derivative(s_k), G.derivative(s_k)), 1e-9);
  }
}

TEST(PatchReceptance, RootsOfABodyThatTurnsMakeTheContactsEquationsSingular)
{
  const Structure s = structure(90, 4);
  ContactPair pair = in_poles(damped_pair(s));
  std::mt19937 random(5);
  std::normal_distribution<double> number;
  const auto changed = [&](ComplexMatrix &shapes, const double size, const double factor = 1)
  {
    for (unsigned int k = 0; k < shapes.n(); ++k)
      for (unsigned int i = 0; i < shapes.m(); ++i)
        shapes(i, k) *= factor * Complex(1 + size * number(random), size * number(random));
  };
  changed(pair.right, 0.05);
  changed(pair.left, 0.05);
  const unsigned int n = pair.n_points();
  const RollingEquilibrium about = rolling(s);
  std::vector<Complex> before;
  for (const bool flows : {false, true})
  {
    if (flows)
    {
      // over the distance of the points
      pair.gradient = pair.right;
      changed(pair.gradient, 1, 1e3);
      pair.residual_gradient = pair.residual;
      for (unsigned int j = 0; j < 3 * n; ++j)
        for (unsigned int i = 0; i < 3 * n; ++i)
          pair.residual_gradient(i, j) *= i < n ? 0. : 1e3 * number(random);
    }
    const HystereticLoss loss = without_loss(pair);
    const ContactReceptance F(pair, first_order(), about, &loss);
    unsigned int n_roots = 0;
    double farthest = 0;
    std::vector<Complex> roots;
    for (const StabilityRoot &root : hysteretic_roots(pair, loss, first_order(), about, {}))
      if (root.frequency > 0)
      {
        const Complex value(root.growth, 2 * M_PI * root.frequency);
        roots.push_back(contact_root(F, value).s);
        farthest = std::max(farthest, std::abs(roots.back() - value) / std::abs(value));
        ++n_roots;
      }
    EXPECT_GE(n_roots, 25u);
    EXPECT_LT(farthest, 1e-8);
    // the gradient is felt
    double change = 0;
    for (unsigned int k = 0; k < std::min(before.size(), roots.size()); ++k)
      change = std::max(change, std::abs(roots[k] - before[k]) / std::abs(roots[k]));
    if (flows)
      EXPECT_GT(change, 1e-4);
    before = roots;
  }
}

// Roots that are hard to tell: double and defective ones, growth near zero, bodies that nothing holds, no damping at all.

#include "../unit/random_structure.h"
#include "report.h"

#include <vibrocontact/analyses/stability/root_count.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  /// A point that slides along y: two modes with K = (a c; c b) along the normal and y, kc = 1 / W on the contact. Its own equation
  /// is q'' + (a + kc, c; c - mu kc, b) q = 0.
  struct TwoModes
  {
    double a = 4e7, b = 6e7, c = 2e5, W = 5e-8, mu = 0, damping = 0;
    /// residual along the contact [m/N]
    double across = 0;
    /// of a third mode that nothing touches [rad/s]
    std::vector<double> apart;

    ContactPair pair() const
    {
      ContactPair pair;
      ContactGrid &grid = pair.interface.contacts.only();
      grid.n_x = grid.n_y = 1;
      grid.spacing_x = grid.spacing_y = 1e-3;
      pair.interface.gap = {0.};
      const double angle = 0.5 * std::atan2(2 * c, a - b), cosine = std::cos(angle), sine = std::sin(angle);
      const double lambda[2] = {a * cosine * cosine + 2 * c * sine * cosine + b * sine * sine,
                                a * sine * sine - 2 * c * sine * cosine + b * cosine * cosine};
      pair.trace.reinit(3, 2 + apart.size());
      for (unsigned int k = 0; k < 2 + apart.size(); ++k)
      {
        pair.omega.push_back(k < 2 ? std::sqrt(lambda[k]) : apart[k - 2]);
        pair.damping_ratio.push_back(damping);
        pair.labels.push_back("body:" + std::to_string(k));
        pair.body.push_back(1);
        pair.modal_load.push_back(0);
      }
      pair.trace(0, 0) = cosine;
      pair.trace(0, 1) = -sine;
      pair.trace(2, 0) = sine;
      pair.trace(2, 1) = cosine;
      pair.residual.reinit(3, 3);
      pair.residual(0, 0) = W;
      pair.residual(1, 1) = pair.residual(2, 2) = across;
      return pair;
    }
    RollingEquilibrium about() const { return sliding(1, mu, 100, 10); }
    std::vector<StabilityRoot> roots() const
    {
      LinearisationOptions options;
      options.lateral_damping = false;
      return stability_roots(pair(), linearised_contact(pair(), creep_schemes().front(), about(), options));
    }
    /// of both modes: w^2 = mean -+ root, the growing one if they flutter
    double growth() const
    {
      const double kc = 1 / W, mean = 0.5 * (a + kc + b), half = 0.5 * (a + kc - b);
      const std::complex<double> root = std::sqrt(std::complex<double>(half * half + c * (c - mu * kc)));
      return std::max(std::abs(std::sqrt(mean + root).imag()), std::abs(std::sqrt(mean - root).imag()));
    }
  };

  double largest_growth(const std::vector<StabilityRoot> &roots)
  {
    double growth = -1e300;
    for (const StabilityRoot &root : roots)
      growth = std::max(growth, root.growth);
    return growth;
  }
} // namespace

// Flutter begins at mu = c / kc where both frequencies are one and the same (a + kc = b): beyond it the growth rate is
// c sqrt(delta) / 2 w, here down to 2e-7 of w; before it there is none.
TEST(HardRoots, OnsetOfFlutter)
{
  for (const double delta : {1e-2, 1e-6, 1e-8, -1e-8, -1e-6})
  {
    TwoModes two;
    two.mu = two.c * two.W * (1 + delta);
    const double growth = largest_growth(two.roots()), truth = two.growth();
    if (delta > 0)
    {
      EXPECT_NEAR(growth / truth, 1, 1e-6 + 1e-11 / delta);
      report("growth", growth / truth - 1);
    }
    else
      EXPECT_LE(growth, 1e-6);
  }
}

// At the onset itself the double root has one eigenvector only: rounding parts it by sqrt(1e-16) of what couples.
TEST(HardRoots, DefectiveDoubleRoot)
{
  TwoModes two;
  two.mu = two.c * two.W;
  const std::vector<StabilityRoot> roots = two.roots();
  ASSERT_EQ(roots.size(), 2u);
  for (const StabilityRoot &root : roots)
  {
    EXPECT_NEAR(root.frequency * 2 * M_PI / std::sqrt(two.b), 1, 1e-8);
    EXPECT_LE(std::abs(root.growth), 1e-8 * std::sqrt(two.b));
    report("growth over w", root.growth / std::sqrt(two.b));
  }
}

// Ten modes of one frequency that nothing couples: ten roots, each that of its mode.
TEST(HardRoots, TenfoldRoot)
{
  TwoModes many;
  many.damping = 1e-3;
  many.apart.assign(10, 5000.);
  const std::vector<StabilityRoot> roots = many.roots();
  unsigned int found = 0;
  double worst = 0;
  for (const StabilityRoot &root : roots)
    if (std::abs(root.frequency * 2 * M_PI / (5000 * std::sqrt(1 - 1e-6)) - 1) < 1e-6)
    {
      ++found;
      worst = std::max(worst, std::abs(root.growth / -5 - 1));
    }
  EXPECT_EQ(found, 10u);
  EXPECT_EQ(roots.size(), 12u);
  EXPECT_LE(worst, 1e-9);
  report("growth", worst);
}

// Modes with damping ratios from 1e-4 to 1e-12: the growth rate is -zeta w, to rounding of w.
TEST(HardRoots, NeutralToATenThousandthAndLess)
{
  for (const double zeta : {1e-4, 1e-8, 1e-12, -1e-4, -1e-8, 0.})
  {
    TwoModes one;
    one.c = 0;
    one.W = 1e3; // hardly any contact
    one.damping = zeta;
    for (const StabilityRoot &root : one.roots())
    {
      const double w = 2 * M_PI * root.frequency / std::sqrt(1 - zeta * zeta);
      EXPECT_NEAR(root.growth, -zeta * w, 1e-14 * w) << zeta;
      report("growth over w", (root.growth + zeta * w) / w);
    }
  }
}

// A body that nothing holds (frequency 0) on its contact: sqrt(kc / m), and no root of the motion along the contact.
TEST(HardRoots, FreeBodyOnItsContact)
{
  TwoModes free;
  free.a = free.b = free.c = 0;
  free.mu = 0.3;
  const std::vector<StabilityRoot> roots = free.roots();
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_NEAR(2 * M_PI * roots[0].frequency / std::sqrt(1 / free.W), 1, 1e-12);
  EXPECT_LE(std::abs(roots[0].growth), 1e-10 * std::sqrt(1 / free.W));
  report("growth over w", roots[0].growth * std::sqrt(free.W));
}

// Poles on the axis stand on the contour of the count: refused in a sentence; with damping of 1e-9 they are counted, on both
// sides of the onset.
TEST(HardRoots, CountBesideTheAxis)
{
  TwoModes two;
  two.mu = two.c * two.W * 1.5;
  two.across = two.W;
  EXPECT_THROW(count_unstable_roots(two.pair(), creep_schemes().front(), two.about(), {}), InputError);
  two.damping = 1e-9;
  for (const double factor : {0.5, 1.5})
  {
    two.mu = two.c * two.W * factor;
    LinearisationOptions options;
    const std::vector<StabilityRoot> roots = stability_roots(
        two.pair(), linearised_contact(two.pair(), creep_schemes().front(), two.about(), options));
    int unstable = 0;
    for (const StabilityRoot &root : roots)
      unstable += root.growth > 0 ? 2 : 0;
    const RootCount count = count_unstable_roots(two.pair(), creep_schemes().front(), two.about(), roots);
    EXPECT_EQ(count.unstable, unstable);
    EXPECT_EQ(unstable, factor > 1 ? 2 : 0);
    EXPECT_LE(std::abs(count.remainder), 1e-2);
  }
}

// A matrix of two equal eigenvalues with one eigenvector has no V^-1: refused; with two near ones the product comes back.
TEST(HardRoots, MatrixWithoutItsEigenvectors)
{
  using Complex = std::complex<double>;
  for (const double apart : {1e-3, 1e-8, 0.})
  {
    dealii::LAPACKFullMatrix<Complex> A(2, 2);
    A(0, 0) = Complex(-1, 10);
    A(1, 1) = Complex(-1 + apart, 10);
    A(0, 1) = 1;
    if (apart == 0)
    {
      EXPECT_THROW(complex_eigenvectors(A, "eigenvalues"), ConvergenceError);
      for (const Complex &value : complex_eigenvalues(A, "eigenvalues"))
        EXPECT_LE(std::abs(value - A(0, 0)), 1e-7);
      continue;
    }
    const ComplexEigenvectors found = complex_eigenvectors(A, "eigenvalues");
    double worst = 0;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
      {
        Complex sum = 0;
        for (unsigned int k = 0; k < 2; ++k)
          sum += Complex(found.right(i, k)) * found.values[k] * Complex(found.left(k, j));
        worst = std::max(worst, std::abs(sum - Complex(A(i, j))));
      }
    EXPECT_LE(worst, 1e-7) << apart;
    report("product", worst);
  }
}

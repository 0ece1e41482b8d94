/// Laws as projections: their graphs, tangents against finite differences, and the limit of a stiff penalty.

#include "contact_cases.h"

#include <vibrocontact/base/exceptions.h>

#include <gtest/gtest.h>

#include <random>

using namespace contact_cases;

namespace
{
  std::vector<std::shared_ptr<const NormalLaw>> all_normal_laws()
  {
    std::vector<std::shared_ptr<const NormalLaw>> laws;
    for (const NormalLawEntry &entry : normal_laws())
      laws.push_back(create_normal_law(entry.name, 50., 3e5));
    return laws;
  }
} // namespace

TEST(ContactLaws, EveryMemberOfEveryFamilyIsCreatedAndUnknownOnesAreRefused)
{
  for (const NormalLawEntry &entry : normal_laws())
  {
    const NormalLaw::Description d = create_normal_law(entry.name, 2., 3.)->description();
    EXPECT_EQ(d.name, entry.name);
    EXPECT_FALSE(entry.help.empty());
  }
  for (const ContactSolverEntry &entry : contact_solvers())
  {
    ContactSolverParameters parameters;
    parameters.method = entry.name;
    EXPECT_NE(create_contact_solver(parameters), nullptr);
    EXPECT_FALSE(entry.help.empty());
  }
  for (const CreepScheme &scheme : creep_schemes())
  {
    EXPECT_EQ(find_creep_scheme(scheme.name).name, scheme.name);
    double sum = 0, first = 0;
    for (unsigned int k = 0; k < scheme.coefficients.size(); ++k)
    {
      sum += scheme.coefficients[k];
      first -= k * scheme.coefficients[k];
    }
    EXPECT_NEAR(sum, 0, 1e-15); // exact for constant and for linear displacements
    EXPECT_NEAR(first, 1, 1e-15);
  }
  EXPECT_THROW(create_normal_law("glue", 1., 1.), InputError);
  EXPECT_THROW(create_normal_law("exponential penalty", -1., 1.), InputError);
  EXPECT_THROW(find_creep_scheme("central"), InputError);
  ContactSolverParameters wrong;
  wrong.method = "guess";
  EXPECT_THROW(create_contact_solver(wrong), InputError);
}

TEST(ContactLaws, NormalTangentsEqualFiniteDifferences)
{
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double rho = 1e8;
  for (const auto &law : all_normal_laws())
    for (unsigned int k = 0; k < 200; ++k)
    {
      const double force = 200 * uniform(generator), gap = 2e-6 * uniform(generator),
                   trial = force - rho * gap;
      if (std::abs(trial) < 1e-2)
        continue; // the kink of the graph
      const NormalLaw::Projection p = law->project(force, gap, rho);
      const double dN = 1e-4, dg = 1e-12;
      EXPECT_NEAR((law->project(force + dN, gap, rho).force - law->project(force - dN, gap, rho).force) /
                      (2 * dN),
                  p.by_force, 1e-6);
      EXPECT_NEAR((law->project(force, gap + dg, rho).force - law->project(force, gap - dg, rho).force) /
                      (2 * dg * rho),
                  p.by_gap / rho, 1e-6);
    }
}

TEST(ContactLaws, PenaltyTangentAndForceComeFromItsPotential)
{
  const ExponentialPenaltyLaw law(50., 3e5);
  for (const double gap : {-1e-6, -5e-6, -6.6e-6, -7e-6, -2e-5, 1e-6})
  {
    const double d = 1e-11;
    EXPECT_NEAR(-(law.potential(gap + d) - law.potential(gap - d)) / (2 * d), law.force(gap),
                1e-6 * law.force(gap) + 1e-9);
    EXPECT_NEAR(-(law.force(gap + d) - law.force(gap - d)) / (2 * d), law.stiffness(gap),
                1e-5 * law.stiffness(gap));
  }
  // a point of the graph is its own projection, whatever rho
  for (const double rho : {1e5, 1e8, 1e11})
    for (const double gap : {-1e-7, -4e-6, -3e-5, 1e-6})
      EXPECT_NEAR(law.project(law.force(gap), gap, rho).force, law.force(gap), 1e-12 * law.force(gap));
}

TEST(ContactLaws, CoulombTangentEqualsFiniteDifferencesAndItsGraphIsADisc)
{
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned int k = 0; k < 300; ++k)
  {
    const CoulombLaw::Vector2 trial = {{2 * uniform(generator), 2 * uniform(generator)}};
    const double radius = 1 + uniform(generator), norm = std::hypot(trial[0], trial[1]), d = 1e-6;
    if (std::abs(norm - radius) < 1e-4 || radius < 1e-3)
      continue;
    const CoulombLaw::Projection p = CoulombLaw::project(trial, radius);
    EXPECT_LE(std::hypot(p.force[0], p.force[1]), radius * (1 + 1e-15));
    EXPECT_EQ(p.sticks, norm < radius);
    for (unsigned int c = 0; c < 2; ++c)
    {
      CoulombLaw::Vector2 more = trial, less = trial;
      more[c] += d;
      less[c] -= d;
      const auto up = CoulombLaw::project(more, radius).force, down = CoulombLaw::project(less, radius).force;
      const auto wide = CoulombLaw::project(trial, radius + d).force,
                 tight = CoulombLaw::project(trial, radius - d).force;
      for (unsigned int r = 0; r < 2; ++r)
        EXPECT_NEAR((up[r] - down[r]) / (2 * d), p.by_trial[r][c], 1e-6);
      EXPECT_NEAR((wide[c] - tight[c]) / (2 * d), p.by_radius[c], 1e-6);
    }
  }
  const CoulombLaw::Projection open = CoulombLaw::project({{3., 4.}}, 0.);
  EXPECT_EQ(std::hypot(open.force[0], open.force[1]), 0.);
}

TEST(ContactLaws, StiffPenaltyTendsToSignoriniInTheFirstOrder)
{
  // wheel on crown, 66 kN, creepage 0.2 %: forces against Signorini's, error ~ 1 / (a alpha)
  Case one;
  one.rolling.creepage.lateral = 0.002;
  const ContactSolution exact = one.run().front().solution;
  one.contact.normal_law = "exponential penalty";
  one.contact.penalty_exponent = 1e3;
  double previous = 0;
  for (const double stiffness : {1e10, 4e10, 16e10, 64e10})
  {
    one.contact.penalty_amplitude = stiffness / one.contact.penalty_exponent;
    const ContactSolution s = one.run().front().solution;
    ASSERT_TRUE(s.converged);
    double error = 0;
    for (unsigned int i = 0; i < s.R.size(); ++i)
      error += std::pow(s.R[i] - exact.R[i], 2);
    error = std::sqrt(error) / exact.R.l2_norm();
    std::cout << "a alpha = " << stiffness << " N/m: error " << error;
    if (previous > 0)
    {
      std::cout << ", order " << std::log(previous / error) / std::log(4.);
      EXPECT_NEAR(std::log(previous / error) / std::log(4.), 1, 0.15);
    }
    std::cout << "\n";
    previous = error;
  }
  EXPECT_LE(previous, 1e-3);
}

/// Laws as projections: their graphs, tangents against finite differences, and the limit of a stiff penalty.

#include "contact_cases.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/friction_of_speed.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <random>

using namespace contact_cases;

namespace
{
  /// of a normal law with at most two numbers, or a curve
  std::vector<double> numbers_of(const std::vector<LawParameter> &parameters, const double a, const double b)
  {
    if (!parameters.empty() && parameters[0].is_curve())
      return {0, 0, -1e-7, 2, -3e-7, 7, -1e-6, 80, -2e-6, 120};
    return parameters.empty() ? std::vector<double>() : std::vector<double>{a, b};
  }

  std::vector<std::shared_ptr<const NormalLaw>> all_normal_laws()
  {
    std::vector<std::shared_ptr<const NormalLaw>> laws;
    for (const NormalLawEntry &entry : normal_laws())
      laws.push_back(entry.make(numbers_of(entry.parameters, 50., 3e5)));
    return laws;
  }

  std::vector<std::shared_ptr<const FrictionLaw>> all_friction_laws()
  {
    std::vector<std::shared_ptr<const FrictionLaw>> laws;
    for (const FrictionLawEntry &entry : friction_laws())
    {
      std::vector<double> numbers = {0.3, 1.4, 0.2};
      numbers.resize(entry.parameters.size());
      if (entry.parameters[0].is_curve())
        numbers = {0, 0.4, 0, 0.35, 0.1, 0.32, 0.3, 0.3, 1, 0.31};
      laws.push_back(entry.make(numbers));
    }
    return laws;
  }
} // namespace

TEST(ContactLaws, OfManyContactsAreEachItsOwn)
{
  constexpr unsigned int n = 300;
  std::vector<std::pair<std::shared_ptr<const FrictionLaw>, unsigned int>> of_contacts;
  for (unsigned int k = 0; k < n; ++k)
    of_contacts.emplace_back(create_friction_law("coulomb", {k / 1e3}), 2);
  const PointLaws<FrictionLaw> laws = PointLaws<FrictionLaw>::of_contacts(of_contacts);
  for (unsigned int k = 0; k < n; ++k)
    EXPECT_EQ(laws[2 * k + 1].at_rest(), k / 1e3);
}

TEST(ContactLaws, EveryMemberOfEveryFamilyIsCreatedAndUnknownOnesAreRefused)
{
  for (const NormalLawEntry &entry : normal_laws())
  {
    const LawDescription d = entry.make(numbers_of(entry.parameters, 2., 3.))->description();
    EXPECT_EQ(d.name, entry.name);
    EXPECT_EQ(d.numbers, numbers_of(entry.parameters, 2., 3.));
    EXPECT_EQ(create_normal_law(d.name, d.numbers)->description().numbers, d.numbers);
    EXPECT_FALSE(entry.help.empty());
  }
  for (const auto &law : all_friction_laws())
  {
    const LawDescription d = law->description();
    EXPECT_EQ(create_friction_law(d.name, d.numbers)->description().numbers, d.numbers);
    EXPECT_FALSE(find_friction_law(d.name, friction_laws()).help.empty());
  }
  EXPECT_EQ(all_friction_laws().size(), friction_laws().size());
  EXPECT_THROW(create_friction_law("soap", {0.1}), InputError);
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
  EXPECT_THROW(create_normal_law("glue"), InputError);
  EXPECT_THROW(create_normal_law("exponential penalty", {-1., 1.}), InputError);
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
  const auto law = create_normal_law("exponential penalty", {50., 3e5});
  const auto force = [&](const double gap) { return gap < 0 ? law->graph(-gap).force : 0.; };
  for (const double gap : {-1e-6, -5e-6, -6.6e-6, -7e-6, -2e-5, 1e-6})
  {
    const double d = 1e-11;
    EXPECT_NEAR(-(law->potential(gap + d) - law->potential(gap - d)) / (2 * d), force(gap),
                1e-6 * force(gap) + 1e-9);
    const double stiffness = gap < 0 ? law->graph(-gap).force_slope : 0.;
    EXPECT_NEAR(-(force(gap + d) - force(gap - d)) / (2 * d), stiffness, 1e-5 * stiffness);
  }
  // a point of the graph is its own projection, whatever rho
  for (const double rho : {1e5, 1e8, 1e11})
    for (const double gap : {-1e-7, -4e-6, -3e-5, 1e-6})
      EXPECT_NEAR(law->project(force(gap), gap, rho).force, force(gap), 1e-12 * force(gap));
}

TEST(ContactLaws, PotentialsAreThoseOfClosedForms)
{
  const double a = 50, alpha = 3e5;
  const auto penalty = create_normal_law("exponential penalty", {a, alpha});
  for (const double d : {1e-7, 1e-6, 6e-6})
    EXPECT_NEAR(penalty->potential(-d) / (a * (std::expm1(alpha * d) / alpha - d)), 1, 1e-11) << d;
  // beyond alpha d = 2 a straight line
  const double end = 2 / alpha, further = 5e-6, slope = a * alpha * std::exp(2.);
  EXPECT_NEAR(
      penalty->potential(-end - further) /
          (a * (std::expm1(2.) / alpha - end) + a * std::expm1(2.) * further + slope * further * further / 2),
      1, 1e-12);
  EXPECT_NEAR(create_normal_law("linear spring", {a, alpha})->potential(-2e-6), 0.5 * a * alpha * 4e-12,
              1e-18);
  EXPECT_EQ(create_normal_law("signorini")->potential(-1e-9), 0);
  // what a member writes by hand is the integral of its force
  for (const auto &law : all_normal_laws())
    for (const double d : {1e-8, 2e-7, 7e-7, 1.5e-6, 4e-6, 1e-5})
      EXPECT_NEAR(law->potential(-d), law->integrated_force(-d), 1e-11 * law->potential(-d))
          << law->description().name << " " << d;
}

// Derivatives of graphs, resolvents and coefficients against central differences at random states; about a corner the
// difference lies between the slopes of both sides.
TEST(ContactLaws, TangentsOfAllLawsEqualCentralDifferences)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const auto &law : all_normal_laws())
  {
    const std::string name = law->description().name;
    const double size = law->is_rigid() ? 100. : 2.5e-6;
    for (unsigned int k = 0; k < 1000; ++k)
    {
      const double s = size * (uniform(generator) - 0.1), d = 1e-5 * size;
      const NormalLaw::GraphPoint at = law->graph(s), up = law->graph(s + d), down = law->graph(s - d);
      const double slope = (up.force - down.force) / (2 * d);
      EXPECT_GE(slope, std::min({up.force_slope, at.force_slope, down.force_slope}) * (1 - 1e-7))
          << name << s;
      EXPECT_LE(slope, std::max({up.force_slope, at.force_slope, down.force_slope}) * (1 + 1e-7))
          << name << s;
      EXPECT_NEAR((up.penetration - down.penetration) / (2 * d), at.penetration_slope, 1e-8) << name;

      const double rho = std::pow(10., 5 + 6 * uniform(generator)), force = 100 * uniform(generator),
                   gap = 4e-6 * (uniform(generator) - 0.75), trial = force - rho * gap;
      const NormalLaw::Projection p = law->resolvent(force, gap, rho);
      if (trial <= 0)
      {
        EXPECT_EQ(p.force, 0);
        continue;
      }
      // on the graph, and its tangent
      EXPECT_NEAR((p.force + rho * law->compression(p.force).depth) / trial, 1, 1e-9) << name;
      const double step = 1e-6 * trial;
      const NormalLaw::Projection more = law->resolvent(force + step, gap, rho),
                                  less = law->resolvent(force - step, gap, rho);
      const double difference = (more.force - less.force) / (2 * step);
      EXPECT_GE(difference, std::min({p.by_force, more.by_force, less.by_force}) * (1 - 1e-6) - 1e-9) << name;
      EXPECT_LE(difference, std::max({p.by_force, more.by_force, less.by_force}) * (1 + 1e-6) + 1e-9) << name;
      EXPECT_NEAR(p.by_gap, -rho * p.by_force, 1e-12 * rho);
      // what a member writes by hand is the same
      const NormalLaw::Projection own = law->project(force, gap, rho);
      EXPECT_NEAR(own.force, p.force, 1e-12 * trial);
      EXPECT_NEAR(own.by_force, p.by_force, 1e-12);
      EXPECT_NEAR(own.by_gap, p.by_gap, 1e-12 * rho);
    }
    // the corner itself: open
    EXPECT_EQ(law->resolvent(1e6, 1, 1e6).force, 0);
    EXPECT_EQ(law->project(1e6, 1, 1e6).by_force, 0);
  }
  for (const auto &law : all_friction_laws())
    for (unsigned int k = 0; k < 1000; ++k)
    {
      const double v = 1e-6 + 1.2 * uniform(generator), d = 1e-7,
                   difference = (law->coefficient(v + d).value - law->coefficient(v - d).value) / (2 * d),
                   here = law->coefficient(v).slope, more = law->coefficient(v + d).slope,
                   less = law->coefficient(v - d).slope;
      EXPECT_GE(difference, std::min({here, more, less}) - 1e-7) << law->description().name << " at " << v;
      EXPECT_LE(difference, std::max({here, more, less}) + 1e-7) << law->description().name << " at " << v;
    }
}

TEST(ContactLaws, CompressionsAreInversesOfForces)
{
  for (const auto &law : all_normal_laws())
    for (const double force : {-20., -1e-3, 1e-9, 1e-3, 3., 50., 100., 1e4})
    {
      const NormalLaw::Compression c = law->compression(force);
      if (law->is_rigid())
      {
        EXPECT_EQ(c.depth, 0);
        EXPECT_EQ(c.compliance, 0);
        continue;
      }
      const NormalLaw::GraphPoint at = law->graph(c.depth);
      // of a curve the rounding of its largest forces, 1e-16 of 100 N
      EXPECT_NEAR(at.force, force, 1e-9 * std::abs(force) + 1e-14) << law->description().name;
      EXPECT_NEAR(c.compliance * at.force_slope, 1, 1e-12);
    }
}

TEST(ContactLaws, CurvesAreMonotoneWhereTheirPointsAre)
{
  const auto spring = create_normal_law("spring curve", {-2e-6, 120, 0, 0, -1e-7, 2, -1e-6, 80, -3e-7, 7});
  double before = -1;
  for (unsigned int k = 0; k <= 3000; ++k)
  {
    const double force = spring->graph(1e-9 * k).force;
    EXPECT_GT(force, before);
    before = force;
  }
  EXPECT_NEAR(spring->graph(3e-7).force, 7, 1e-12);
  // points on a line are the linear spring, also beyond the last
  const auto line = create_normal_law("spring curve", {0, 0, -1e-6, 10, -3e-6, 30});
  const auto linear = create_normal_law("linear spring", {1e4, 1e3});
  for (const double gap : {1e-7, -2e-7, -2e-6, -7e-6})
    for (const double force : {0., 3., 50.})
      EXPECT_NEAR(line->project(force, gap, 3e6).force, linear->project(force, gap, 3e6).force, 1e-11);
  const auto friction = create_friction_law("friction curve", {0, 0.5, 0, 0.4, 0.1, 0.3, 0.5, 0.3, 1, 0.35});
  for (unsigned int k = 0; k <= 120; ++k)
  {
    const double v = 0.01 * k, slope = friction->coefficient(v).slope;
    EXPECT_TRUE(v <= 0.1 ? slope <= 0 : slope >= 0) << v;
  }
  EXPECT_EQ(friction->at_rest(), 0.5);
  EXPECT_EQ(friction->coefficient(0).value, 0.4);
  EXPECT_EQ(friction->coefficient(7).value, 0.35);
  // between a lower value at rest and that of sliding the point rests as well
  EXPECT_EQ(create_friction_law("friction curve", {0, 0.2, 0, 0.4, 1, 0.3})->at_rest(), 0.4);
  for (const std::vector<double> &wrong : std::vector<std::vector<double>>{
           {}, {0, 0}, {0, 0, -1e-6, -1}, {0, 1, -1e-6, 2}, {0, 0, 1e-6, 1}, {0, 0, -1e-6, 2, -2e-6, 2}})
    EXPECT_THROW(create_normal_law("spring curve", wrong), InputError);
  for (const std::vector<double> &wrong : std::vector<std::vector<double>>{{},
                                                                           {0, 0.3},
                                                                           {0.1, 0.3, 0.2, 0.2},
                                                                           {0, 0.3, 0, 0.2},
                                                                           {0, 0.3, 1, 0},
                                                                           {0, 0.3, 0, 0.3, 0, 0.3, 1, 0.2},
                                                                           {0, 0.3, 2, 0.2, 1, 0.2}})
    EXPECT_THROW(create_friction_law("friction curve", wrong), InputError);
}

TEST(ContactLaws, CurvesComeFromFiles)
{
  const auto write = [](const std::string &name, const std::string &text) { std::ofstream(name) << text; };
  write("law_spring.csv", "# measured\ngap_m, force_N\n0, 0\n-1e-6, 10\n-3e-6, 30\n");
  write("law_friction.csv", "slip_speed_m_s, friction\n0, 0.4\n0.1, 0.3\n");
  ContactParameters contact;
  contact.normal_law = "spring curve";
  EXPECT_THROW(contact.law(), InputError); // no file
  contact.law_values.set("Spring curve", "law_spring.csv");
  contact.friction_law = "friction curve";
  contact.law_values.set("Friction curve", "law_friction.csv");
  contact.read_curves("");
  EXPECT_NEAR(contact.law()->graph(2e-6).force, 20, 1e-12);
  EXPECT_EQ(contact.law_of_friction()->coefficient(0).value, 0.4);
  EXPECT_EQ(contact.friction, 0.3); // at high speed
  EXPECT_FALSE(contact.takes_coefficient());
  for (const std::string text :
       {"gap, force\n0, 0\n", "gap_m, force_N\n0, 0\n", "gap_m, force_N\n0, 0\n-1e-6\n"})
  {
    write("law_spring.csv", text);
    EXPECT_THROW(contact.read_curves(""), InputError) << text;
  }
  for (const std::string name : {"law_spring.csv", "law_friction.csv"})
    std::remove(name.c_str());
}

// Points that lie on the falling law give its forces.
TEST(ContactLaws, ACurveOnTheFallingLawGivesItsRolling)
{
  Case one;
  one.rolling.creepage.speed = 20;
  one.rolling.creepage.lateral = 0.004;
  one.contact.law_values.set("Static friction ratio", 1.3);
  one.contact.law_values.set("Stribeck velocity", 0.05);
  const RollingResult exact = one.run().front();
  ASSERT_TRUE(exact.solution.converged);
  const auto law = one.contact.law_of_friction();
  std::vector<double> points;
  for (unsigned int k = 0; k <= 400; ++k)
  {
    const double v = 1.5 * std::pow(k / 400., 2);
    points.insert(points.end(), {v, law->coefficient(v).value});
  }
  const auto curve = create_friction_law("friction curve", points);
  for (const double v : {0., 0.01, 0.037, 0.2, 0.9})
    EXPECT_NEAR(curve->coefficient(v).value, law->coefficient(v).value, 2e-7) << v;

  const CreepScheme &scheme = find_creep_scheme(one.contact.creep_scheme);
  const ContactInterface interface = one.interface();
  ContactProblem problem = rolling_problem(rolling_operator(interface.contacts.only(), one.pair, scheme, 20.),
                                           interface, scheme, exact.rolling_case.creepage, one.contact);
  problem.normal_force = exact.rolling_case.normal_force;
  problem.friction_law = curve;
  ContactSolution s;
  solve_with_friction_of_speed(problem, *create_contact_solver(one.solver), s);
  ASSERT_TRUE(s.converged);
  double tangential = 0;
  for (unsigned int i = 0; i < problem.n_points(); ++i)
    tangential += s.R[2 * problem.n_points() + i];
  EXPECT_NEAR(tangential / exact.tangential_force[1], 1, 1e-6);
}

TEST(ContactLaws, CoulombTangentEqualsFiniteDifferencesAndItsGraphIsADisc)
{
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned int k = 0; k < 300; ++k)
  {
    const Vector2 trial = {{2 * uniform(generator), 2 * uniform(generator)}};
    const double radius = 1 + uniform(generator), norm = std::hypot(trial[0], trial[1]), d = 1e-6;
    if (std::abs(norm - radius) < 1e-4 || radius < 1e-3)
      continue;
    const DiscProjection p = project_on_disc(trial, radius);
    EXPECT_LE(std::hypot(p.force[0], p.force[1]), radius * (1 + 1e-15));
    EXPECT_EQ(p.sticks, norm < radius);
    for (unsigned int c = 0; c < 2; ++c)
    {
      Vector2 more = trial, less = trial;
      more[c] += d;
      less[c] -= d;
      const auto up = project_on_disc(more, radius).force, down = project_on_disc(less, radius).force;
      const auto wide = project_on_disc(trial, radius + d).force,
                 tight = project_on_disc(trial, radius - d).force;
      for (unsigned int r = 0; r < 2; ++r)
        EXPECT_NEAR((up[r] - down[r]) / (2 * d), p.by_trial[r][c], 1e-6);
      EXPECT_NEAR((wide[c] - tight[c]) / (2 * d), p.by_radius[c], 1e-6);
    }
  }
  const DiscProjection open = project_on_disc({{3., 4.}}, 0.);
  EXPECT_EQ(std::hypot(open.force[0], open.force[1]), 0.);
}

TEST(ContactLaws, StiffPenaltyTendsToSignoriniInTheFirstOrder)
{
  // wheel on crown, 66 kN, creepage 0.2 %: forces against Signorini's, error ~ 1 / (a alpha)
  Case one;
  one.rolling.creepage.lateral = 0.002;
  const ContactSolution exact = one.run().front().solution;
  one.contact.normal_law = "exponential penalty";
  const double exponent = 1e3;
  one.contact.law_values.set("Penalty exponent", exponent);
  double previous = 0;
  for (const double stiffness : {1e10, 4e10, 16e10, 64e10})
  {
    one.contact.law_values.set("Penalty amplitude", stiffness / exponent);
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

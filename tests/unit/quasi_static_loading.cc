/// Quasi-static loading: Cattaneo and Mindlin's contact, Masing's rule, what loads are read, and what answers to them.

#include <vibrocontact/analyses/loading/loading_output.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/quasi_static_loading.h>
#include <vibrocontact/coupled_bodies/sprung_operator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace vibrocontact;

namespace
{
  constexpr double balls_young = 210e9, balls_radius = 0.1, balls_force = 1000, balls_friction = 0.3;

  /// Cattaneo (1938), Mindlin (1949) and Mindlin and Deresiewicz (1953) of two equal balls; Johnson 1985, ch. 7.
  struct MindlinsBalls
  {
    double a, shift;

    explicit MindlinsBalls(const double nu)
    {
      const double G = balls_young / (2 * (1 + nu)), E = balls_young / (2 * (1 - nu * nu));
      a = std::cbrt(3 * balls_force * (balls_radius / 2) / (4 * E));
      shift = 3 * balls_friction * balls_force / (16 * a) * 2 * (2 - nu) / G;
    }
    double approach() const { return a * a / (balls_radius / 2); }
    /// @param q tangential force over what friction bears
    double displacement(const double q) const { return shift * (1 - std::pow(1 - q, 2. / 3)); }
    double stick_radius(const double q) const { return a * std::cbrt(1 - q); }
    /// of a cycle between -q and q, by Masing's rule from the work along the backbone
    double dissipated(const double q) const
    {
      const double work = balls_friction * balls_force * shift *
                          (0.6 - std::pow(1 - q, 2. / 3) + 0.4 * std::pow(1 - q, 5. / 3));
      return 8 * work - 4 * q * balls_friction * balls_force * displacement(q);
    }
  };

  /// Two balls on a grid with so many cells across their contact.
  struct LoadedBalls
  {
    ContactParameters contact;
    ContactSolverParameters solver;
    LoadingGrid grid;

    explicit LoadedBalls(const unsigned int cells, const double nu = 0,
                         const double young_below = balls_young)
    {
      contact.friction = balls_friction;
      contact.spacing = 2 * MindlinsBalls(nu).a / cells;
      contact.half_length = contact.half_width = 1.15 * MindlinsBalls(nu).a;
      const ContactGrid points = contact.grid();
      grid.interface.contacts.only() = points;
      for (unsigned int i = 0; i < points.n_points(); ++i)
        grid.interface.gap.push_back((std::pow(points.x(i), 2) + std::pow(points.y(i), 2)) / balls_radius);
      grid.compliance = std::make_shared<const HalfSpaceOperator>(
          points, HalfSpacePair({balls_young, nu}, {young_below, nu}), std::vector<double>{1.});
    }
    LoadedContact loaded(const std::array<bool, 3> &force_given = {{true, true, true}}) const
    {
      return LoadedContact(grid, contact, solver, force_given);
    }
    double stick_radius(const LoadedState &state) const
    {
      const auto &status = state.solution.status;
      return contact.spacing *
             std::sqrt(std::count(status.begin(), status.end(), ContactStatus::stick) / M_PI);
    }
  };

  void expect_relatively_near(const double value, const double truth, const double tolerance)
  {
    EXPECT_NEAR(value, truth, tolerance * std::abs(truth));
  }

  constexpr double balls_bound = balls_friction * balls_force;
} // namespace

// nu = 0: friction then acts along x alone, as Cattaneo and Mindlin have it.
TEST(QuasiStaticLoading, CattaneoAndMindlin)
{
  const MindlinsBalls truth(0);
  const LoadedBalls balls(40);
  LoadedContact contact = balls.loaded();
  ASSERT_TRUE(contact.load({{0, 0, balls_force}})) << contact.failure();
  expect_relatively_near(contact.state().displacement[2], truth.approach(), 0.005);
  for (const double q : {0.5, 0.7, 0.8, 0.9, 0.95})
  {
    ASSERT_TRUE(contact.load({{q * balls_bound, 0, balls_force}})) << contact.failure();
    const LoadedState &state = contact.state();
    expect_relatively_near(state.force[0], q * balls_bound, 1e-9);
    expect_relatively_near(state.displacement[0], truth.displacement(q), 0.02);
    // of the contact's radius
    EXPECT_NEAR(balls.stick_radius(state), truth.stick_radius(q), 0.02 * truth.a);
  }
  const double before = contact.state().dissipated_sum;
  for (const double q : {-0.95, 0.95})
    ASSERT_TRUE(contact.load({{q * balls_bound, 0, balls_force}})) << contact.failure();
  expect_relatively_near(contact.state().dissipated_sum - before, truth.dissipated(0.95), 0.02);
}

// Twice the half force moves back by twice the way of the backbone.
TEST(QuasiStaticLoading, MasingsRule)
{
  const LoadedBalls balls(12);
  LoadedContact contact = balls.loaded();
  contact.load({{0, 0, balls_force}});
  std::vector<double> backbone = {0};
  for (unsigned int k = 1; k <= 6; ++k)
  {
    ASSERT_TRUE(contact.load({{0.15 * k * balls_bound, 0, balls_force}})) << contact.failure();
    backbone.push_back(contact.state().displacement[0]);
  }
  for (const int sign : {-1, 1})
  {
    const double from = contact.state().displacement[0];
    for (unsigned int k = 1; k <= 6; ++k)
    {
      ASSERT_TRUE(contact.load({{sign * (0.3 * k - 0.9) * balls_bound, 0, balls_force}}))
          << contact.failure();
      EXPECT_NEAR(contact.state().displacement[0], from + sign * 2 * backbone[k], 1e-6 * backbone[6]);
    }
  }
  // as the loop is closed, so is the account of its energy
  expect_relatively_near(contact.state().displacement[0], backbone[6], 1e-6);
}

TEST(QuasiStaticLoading, NormalLoadAloneKnowsNoPath)
{
  const LoadedBalls balls(12, 0.3);
  LoadedContact at_once = balls.loaded(), back_and_forth = balls.loaded();
  ASSERT_TRUE(at_once.load({{0, 0, balls_force}}));
  for (const double part : {0.2, 0.7, 0.4, 1.3, 1.})
    ASSERT_TRUE(back_and_forth.load({{0, 0, part * balls_force}}));
  DenseVector difference = at_once.state().solution.R;
  difference -= back_and_forth.state().solution.R;
  EXPECT_LT(difference.linfty_norm(), 1e-9 * balls_force);
  EXPECT_NEAR(back_and_forth.state().dissipated_sum, 0, 1e-12 * back_and_forth.state().stored);
  // the work of pressing is stored
  const LoadedState &state = at_once.state();
  expect_relatively_near(state.displacement[2], MindlinsBalls(0.3).approach(), 0.02);
}

TEST(QuasiStaticLoading, AlongYAsAlongX)
{
  const LoadedBalls balls(12, 0.3);
  LoadedContact along_x = balls.loaded(), along_y = balls.loaded();
  for (const double q : {0., 0.6, -0.4, 0.9})
  {
    ASSERT_TRUE(along_x.load({{q * balls_bound, 0, balls_force}}));
    ASSERT_TRUE(along_y.load({{0, q * balls_bound, balls_force}}));
    EXPECT_NEAR(along_x.state().displacement[0], along_y.state().displacement[1], 1e-16);
    EXPECT_NEAR(along_x.state().dissipated, along_y.state().dissipated, 1e-10 * along_x.state().stored);
  }
}

// What is found under forces is found again under the displacements that they made.
TEST(QuasiStaticLoading, DisplacementsThatForcesMake)
{
  const LoadedBalls balls(12, 0.3);
  LoadedContact by_force = balls.loaded(), by_displacement = balls.loaded({{false, false, false}});
  for (const std::array<double, 3> &load :
       {std::array<double, 3>{{0, 0, 1}}, {{0.5, 0.1, 1.2}}, {{0.8, -0.2, 1}}, {{-0.6, 0.3, 0.9}}})
  {
    ASSERT_TRUE(by_force.load({{load[0] * balls_bound, load[1] * balls_bound, load[2] * balls_force}}))
        << by_force.failure();
    ASSERT_TRUE(by_displacement.load(by_force.state().displacement)) << by_displacement.failure();
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(by_displacement.state().force[d], by_force.state().force[d], 1e-7 * balls_bound);
    EXPECT_NEAR(by_displacement.state().dissipated_sum, by_force.state().dissipated_sum,
                1e-8 * by_force.state().stored);
  }
}

// Of other materials pressing alone makes slip; what the driving forces do is stored or taken by friction.
TEST(QuasiStaticLoading, EnergyIsBalanced)
{
  std::vector<double> imbalance;
  for (const unsigned int n_steps : {5, 20})
  {
    const LoadedBalls balls(12, 0.25, balls_young / 4);
    LoadedContact contact = balls.loaded();
    for (unsigned int k = 1; k <= n_steps; ++k)
      ASSERT_TRUE(contact.load({{0.8 * balls_bound * k / n_steps, 0, balls_force * k / n_steps}}));
    const LoadedState &state = contact.state();
    EXPECT_GT(state.dissipated_sum, 0);
    imbalance.push_back(std::abs(state.work_sum - state.stored - state.dissipated_sum) / state.work_sum);
  }
  EXPECT_LT(imbalance[1], 0.02);
  EXPECT_LT(imbalance[1], 0.5 * imbalance[0]);
}

// What has to be closed before the first point touches is no work.
TEST(QuasiStaticLoading, WorkBeginsWhereTheFirstPointTouches)
{
  LoadedBalls near(8), far(8);
  for (double &gap : far.grid.interface.gap)
    gap += 1e-3;
  LoadedContact from_near = near.loaded(), from_far = far.loaded();
  for (const double part : {0.5, 1.})
  {
    ASSERT_TRUE(from_near.load({{0, 0, part * balls_force}}));
    ASSERT_TRUE(from_far.load({{0, 0, part * balls_force}}));
  }
  EXPECT_NEAR(from_far.state().displacement[2], from_near.state().displacement[2] + 1e-3, 1e-12);
  expect_relatively_near(from_far.state().work_sum, from_near.state().work_sum, 1e-6);
}

TEST(QuasiStaticLoading, ErrorsAreWithinThoseStated)
{
  const MindlinsBalls truth(0);
  const LoadedBalls fine(20), coarse(10);
  LoadHistory history;
  history.force_given = {{true, true, true}};
  for (const double q : {0., 0.5, 0.9, -0.9, 0.9})
    history.steps.push_back({{{q * balls_bound, 0, balls_force}}, 1, false});
  double cycle = 0, displacement = 0;
  const LoadingResult result =
      quasi_static_loading(history, fine.contact, fine.solver, {fine.grid, coarse.grid},
                           [&](const unsigned int k, const LoadedContact &contact)
                           {
                             if (k > 2)
                               cycle += contact.state().dissipated;
                             if (k == 2)
                               displacement = contact.state().displacement[0];
                           });
  ASSERT_TRUE(result.failure.empty()) << result.failure;
  EXPECT_EQ(result.steps_done, 5u);
  EXPECT_LT(std::abs(displacement / truth.displacement(0.9) - 1), result.errors[0]);
  EXPECT_LT(std::abs(cycle / truth.dissipated(0.9) - 1), result.dissipated_error);
  EXPECT_LT(result.errors[0], 0.05);
  EXPECT_LT(result.dissipated_error, 0.2);
}

TEST(QuasiStaticLoading, MoreThanFrictionBearsIsSaid)
{
  const LoadedBalls balls(8);
  LoadedContact contact = balls.loaded();
  ASSERT_TRUE(contact.load({{0, 0, balls_force}}));
  EXPECT_FALSE(contact.load({{1.2 * balls_bound, 0, balls_force}}));
  EXPECT_NE(contact.failure().find("all points slip"), std::string::npos) << contact.failure();
  // the state before stands
  EXPECT_NEAR(contact.state().force[0], 0, 1e-6);
  EXPECT_TRUE(contact.load({{0.5 * balls_bound, 0, balls_force}}));
}

TEST(QuasiStaticLoading, HistoriesOfLists)
{
  LoadingParameters loading;
  loading.force[2] = {100};
  loading.force[0] = {0, 20, -20};
  loading.steps = {1, 2, 4};
  loading.check();
  const LoadHistory history = loading.history();
  ASSERT_EQ(history.steps.size(), 7u);
  EXPECT_TRUE(history.force_given[0] && !history.force_given[1] && history.force_given[2]);
  const double x[] = {0, 10, 20, 10, 0, -10, -20};
  for (unsigned int k = 0; k < 7; ++k)
  {
    EXPECT_DOUBLE_EQ(history.steps[k].load[0], x[k]);
    EXPECT_DOUBLE_EQ(history.steps[k].load[2], 100);
    EXPECT_EQ(history.steps[k].ends_part, k == 0 || k == 2 || k == 6);
  }
  loading.steps = {1, 2};
  EXPECT_THROW(loading.check(), InputError);
  loading.steps = {1};
  loading.force[1] = {1, 2};
  EXPECT_THROW(loading.check(), InputError);
}

TEST(QuasiStaticLoading, HistoriesThatAreNone)
{
  const auto refusal_of = [](const std::function<void(LoadingParameters &)> &change) -> std::string
  {
    LoadingParameters loading;
    loading.force[2] = {100};
    loading.force[0] = {0, 20};
    change(loading);
    try
    {
      loading.check();
      loading.history();
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  };
  using Change = std::function<void(LoadingParameters &)>;
  const auto by_table = [](const std::string &name) -> Change
  {
    return [name](LoadingParameters &loading)
    {
      loading = LoadingParameters();
      loading.table = std::string(TESTS_DIRECTORY) + "/errors/" + name;
    };
  };
  EXPECT_EQ(refusal_of([](LoadingParameters &) {}), "");
  const std::vector<std::pair<Change, std::string>> changes = {
      {[](LoadingParameters &one) { one.displacement[0] = {1e-6}; },
       "Loading/Force x and Loading/Displacement x are both given"},
      {[](LoadingParameters &one) {
         one.displacement[1] = {0, 0, 1e-6};
       },
       "Loading/Force x lists 2 values, but another direction 3"},
      {[](LoadingParameters &one) {
         one.steps = {1, 2, 3};
       },
       "Loading/Steps lists 3 numbers for 2 parts"},
      {[](LoadingParameters &one) { one.steps = {100000}; }, "Loading/Steps asks for 200000 steps"},
      {[](LoadingParameters &one) { one.force[2] = {-5}; },
       "Loading/Normal force is -5 N: a force that presses is positive"},
      {[](LoadingParameters &one) { one.force[2].clear(); }, "so that nothing presses the bodies together"},
      {[](LoadingParameters &one)
       {
         one.force[2].clear();
         one.table = "loads.csv";
       },
       "Loading/Table and Loading/Force x are both given"},
      {by_table("loading_one_direction.csv"), "has no column normal_force_N or hub_displacement_m"},
      {by_table("loading_unknown_column.csv"), "has a column tangential_force_N"},
      {by_table("loading_pulls.csv"), "line 4, normal_force_N is 0 N"}};
  for (const auto &[change, message] : changes)
  {
    const std::string refusal = refusal_of(change);
    EXPECT_NE(refusal.find(message), std::string::npos) << message << "\n" << refusal;
  }
}

TEST(SprungOperator, IsTheStoredMatrix)
{
  const LoadedBalls balls(4, 0.3, balls_young / 3);
  const unsigned int n = balls.grid.interface.contacts.n_points();
  std::vector<unsigned int> all(n);
  for (unsigned int i = 0; i < n; ++i)
    all[i] = i;
  DenseVector h(3 * n), R(3 * n), y, product(3 * n);
  for (unsigned int i = 0; i < n; ++i)
    h[n + i] = 1 + 0.1 * i;
  for (unsigned int row = 0; row < 3 * n; ++row)
    R[row] = std::sin(row);
  const SprungOperator sprung(balls.grid.compliance, {{h, 1e-8}});
  DenseMatrix matrix;
  sprung.extract(all, matrix);
  matrix.vmult(product, R);
  sprung.vmult(y, R, all);
  y -= product;
  EXPECT_LT(y.linfty_norm(), 1e-12 * product.linfty_norm());
  sprung.vmult_among(y, R, all);
  y -= product;
  EXPECT_LT(y.linfty_norm(), 1e-12 * product.linfty_norm());
}

// Roots keep their names where their frequencies cross; a window of a band has the rows of the band; values of a sweep.

#include <vibrocontact/analyses/stability/root_paths.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/window.h>
#include <vibrocontact/run/parameter_sweep.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

TEST(RootPaths, NamesFollowShapesThroughACrossing)
{
  // one root falls, the other rises; in the crossing their shapes hold a tenth of each other
  const std::vector<double> omega = {2 * dealii::numbers::PI * 100, 2 * dealii::numbers::PI * 110};
  const std::vector<std::string> labels = {"a:one", "a:two"};
  RootPaths paths;
  for (int step = 0; step <= 10; ++step)
  {
    const double p = step / 10., mixed = 0.1 * std::sin(dealii::numbers::PI * p);
    StabilityRoot rising, falling;
    rising.frequency = 100 + 10 * p;
    rising.shape = {{1, 0}, {0, mixed}};
    rising.label = p < 0.5 ? "a:one" : "a:two";
    falling.frequency = 110 - 10 * p + 1e-3;
    falling.shape = {{-mixed, 0}, {0.6, 0.8}};
    falling.label = p < 0.5 ? "a:two" : "a:one";
    std::vector<StabilityRoot> roots = {rising, falling};
    if (falling.frequency < rising.frequency)
      std::swap(roots[0], roots[1]);
    paths.follow(labels, omega, roots);
    for (const StabilityRoot &root : roots)
      EXPECT_EQ(root.path, std::abs(root.shape[0]) > 0.5 ? "a:one" : "a:two") << "step " << step;
  }
}

TEST(RootPaths, RootsWithoutOscillationAndNewModes)
{
  const std::vector<double> omega = {600};
  StabilityRoot root, still;
  root.frequency = 95;
  root.shape = still.shape = {{1, 0}};
  root.label = still.label = "a:one";
  still.growth = 3;
  RootPaths paths;
  for (const char *label : {"a:one", "b:one"})
  {
    const std::vector<std::string> labels = {label};
    root.label = label;
    std::vector<StabilityRoot> roots = {root, still};
    paths.follow(labels, omega, roots);
    EXPECT_EQ(roots[0].path, label);
    EXPECT_EQ(roots[1].path, "no oscillation");
  }
}

namespace
{
  ContactGrid small_grid()
  {
    ContactGrid grid;
    grid.n_x = 3;
    grid.n_y = 5;
    grid.spacing_x = grid.spacing_y = 2e-3;
    grid.x_first = -2e-3;
    grid.y_first = -4e-3;
    return grid;
  }
} // namespace

TEST(Window, HasTheRowsOfItsPlaceInTheBand)
{
  const ContactGrid grid = small_grid();
  ReducedBody body;
  body.grid = band(grid, -6e-3, 4e-3);
  EXPECT_EQ(body.grid.n_y, 10u);
  EXPECT_NEAR(body.grid.y_first, -10e-3, 1e-15);
  const unsigned int n = body.grid.n_points();
  body.omega = {1., 2.};
  body.trace.reinit(3 * n, 2);
  body.residual.reinit(3 * n, 3 * n);
  // each number says where it stands
  const auto place = [&](const unsigned int row)
  { return 1e4 * (row / n) + 1e3 * body.grid.x(row % n) + 1e5 * body.grid.y(row % n); };
  for (unsigned int r = 0; r < 3 * n; ++r)
  {
    body.trace(r, 1) = place(r);
    for (unsigned int s = 0; s < 3 * n; ++s)
      body.residual(r, s) = place(r) + 1e7 * place(s);
    body.lifting.push_back(place(r));
    body.residual_load.push_back(place(r));
    if (r < n)
      body.surface_height.push_back(place(r));
  }
  const double lateral = 2e-3, height = 0.5;
  const ReducedBody part = window(body, grid, lateral, height);
  const unsigned int m = grid.n_points();
  for (unsigned int r = 0; r < 3 * m; ++r)
  {
    const double here = 1e4 * (r / m) + 1e3 * grid.x(r % m) + 1e5 * (grid.y(r % m) + lateral);
    EXPECT_NEAR(part.trace(r, 1), here, 1e-8);
    EXPECT_NEAR(part.lifting[r], here, 1e-8);
    for (unsigned int s = 0; s < 3 * m; ++s)
      EXPECT_NEAR(part.residual(r, s),
                  here + 1e7 * (1e4 * (s / m) + 1e3 * grid.x(s % m) + 1e5 * (grid.y(s % m) + lateral)), 1e-1);
    if (r < m)
      EXPECT_NEAR(part.surface_height[r], here - height, 1e-8);
  }
  EXPECT_THROW(band(grid, 0, 1e-3), InputError);
  EXPECT_ANY_THROW(window(body, grid, 8e-3));
}

TEST(Window, RowsBeyondTheSurfaceAreClipped)
{
  const ContactGrid grid = clipped(small_grid(), -3e-3, 1e-2);
  EXPECT_EQ(grid.n_y, 4u);
  EXPECT_NEAR(grid.y_first, -2e-3, 1e-15);
  EXPECT_EQ(clipped(small_grid(), 1., 2.).n_y, 0u);
}

TEST(ParameterSweep, ValuesOfARangeReachItsEnds)
{
  ParameterSweep::Axis axis;
  axis.range = {-25e-3, 30e-3, 1e-3};
  const std::vector<std::string> values = axis.values();
  ASSERT_EQ(values.size(), 56u);
  EXPECT_EQ(values.front(), "-0.025");
  EXPECT_EQ(values[25], "0");
  EXPECT_EQ(values.back(), "0.03");
  axis.range.clear();
  axis.list = "mid-span, support";
  EXPECT_EQ(axis.values(), (std::vector<std::string>{"mid-span", "support"}));
}

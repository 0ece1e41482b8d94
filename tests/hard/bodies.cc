// Bodies that are hard to solve: cells like slivers, a Poisson ratio of 0.4999, free bodies that hardly resist bending, many
// equal frequencies.

#include "../unit/reduction_bodies.h"
#include "report.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/reduction/modes.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;
using namespace reduction_test;

namespace
{
  struct Bar
  {
    double length = 1, width = 0.05, height = 0.05, nu = 0;
    unsigned int cells_along = 10, cells_across = 1;
    bool free = false;

    BlockParameters parameters() const
    {
      BlockParameters p;
      p.length = length;
      p.width = width;
      p.height = height;
      p.divisions_x = cells_along;
      p.divisions_y = p.divisions_z = cells_across;
      p.held.clear();
      if (!free)
        p.held = {"left"};
      return p;
    }
    ElasticModel<3> model() const
    {
      ElasticModel<3> m;
      m.material.poisson_ratio = nu;
      return m;
    }
    double young_modulus() const { return model().material.young_modulus; }
    double area() const { return width * height; }

    /// Displacement of the end face under a unit force on it, along x or along z.
    double compliance(const unsigned int direction) const
    {
      ElasticModel<3> m = model();
      SurfaceTraction<3> traction;
      traction.boundary = make_block<3>(parameters(), "bar", MPI_COMM_SELF).boundary_id("right");
      traction.traction[direction] = 1 / area();
      m.tractions.push_back(traction);
      const Body body = make_body(parameters(), m, MPI_COMM_SELF, 0);
      Flexibility flexibility(*body.system);
      dealii::PETScWrappers::MPI::Vector u(body.system->load);
      flexibility.vmult(u, body.system->load);
      return u * body.system->load;
    }
    Modes modes(const unsigned int count) const
    {
      const Body body = make_body(parameters(), model(), MPI_COMM_SELF, 0);
      Flexibility flexibility(*body.system);
      ModeParameters p;
      p.count = count;
      return compute_modes(*body.system, flexibility, p);
    }
  };
} // namespace

// Cells ten to a thousand times as long as thick: L / E A along, L^3 / 3 E I + 6 L / 5 G A across (Timoshenko). A bar 1e4 times as
// long as thick has no digits left for its bending: refused.
TEST(HardBodies, CellsLikeSlivers)
{
  for (const double thickness : {1e-2, 1e-3, 1e-4})
  {
    Bar bar;
    bar.width = bar.height = thickness;
    if (thickness < 1e-3)
    {
      EXPECT_THROW(bar.compliance(2), InputError);
      continue;
    }
    const double E = bar.young_modulus(), A = bar.area(), I = A * A / 12;
    const double along = bar.compliance(0) * E * A - 1,
                 across = bar.compliance(2) / (1 / (3 * E * I) + 6 / (5 * 0.5 * E * A)) - 1;
    EXPECT_NEAR(along, 0, 1e-9);
    // ten quadratic cells, as at any thickness
    EXPECT_NEAR(across, -0.0023, 2e-4);
    report("along", along);
    report("across", across);
  }
}

// A clamped beam of nu 0.4999 in bending: quadratic cells lock in part, 10, 5 and 2.6 % with 1, 2 and 4 cells across; in the limit
// it is as right as that of nu 0.3.
TEST(HardBodies, NearlyIncompressibleBeam)
{
  double limit[2], finest[2];
  unsigned int k = 0;
  for (const double nu : {0.3, 0.4999})
  {
    double values[3];
    unsigned int level = 0;
    for (const unsigned int n : {1u, 2u, 4u})
    {
      Bar bar;
      bar.nu = nu;
      bar.cells_along = 10 * n;
      bar.cells_across = n;
      const double E = bar.young_modulus(), I = bar.area() * bar.area() / 12,
                   beam = 1 / (3 * E * I) + 6 * 2 * (1 + nu) / (5 * E * bar.area());
      values[level++] = bar.compliance(2) / beam - 1;
    }
    for (level = 1; level < 3; ++level)
      EXPECT_LT(std::abs(values[level]), 0.8 * std::abs(values[level - 1])) << nu;
    finest[k] = values[2];
    limit[k++] = 2 * values[2] - values[1];
  }
  for (k = 0; k < 2; ++k)
  {
    EXPECT_NEAR(limit[k], 0, 0.01);
    report(k == 0 ? "four cells across, nu 0.3" : "nu 0.4999", finest[k]);
    report("in the limit", limit[k]);
  }
}

// A free bar of 10 m: six rigid motions, the first bending pair, 5 Hz at 0.1 m, is none of them. At 1 cm and 1 mm, 1000 and 10,000
// times as long as thick, rounding is more than it resists: refused.
TEST(HardBodies, FreeWireHasSixRigidMotions)
{
  for (const double thickness : {0.1, 1e-2, 1e-3})
  {
    Bar wire;
    wire.free = true;
    wire.length = 10;
    wire.width = wire.height = thickness;
    wire.cells_along = 20;
    if (thickness < 0.1)
    {
      EXPECT_THROW(wire.modes(10), ConvergenceError);
      continue;
    }
    const Modes modes = wire.modes(10);
    const double c = std::sqrt(wire.young_modulus() / wire.model().material.density);
    const double truth = std::pow(4.7300407 / wire.length, 2) * c * thickness / std::sqrt(12.);
    EXPECT_EQ(modes.n_rigid_modes, 6u) << thickness;
    EXPECT_NEAR(modes.omega[6] / truth, 1, 2e-3) << thickness;
    EXPECT_NEAR(modes.omega[7] / modes.omega[6], 1, 1e-6) << thickness;
    report("first bending", modes.omega[6] / truth - 1);
  }
}

// A free cube: every frequency once, twice or three times, by its symmetry; none is left out or told apart.
TEST(HardBodies, FrequenciesOfACube)
{
  Bar cube;
  cube.free = true;
  cube.length = cube.width = cube.height = 0.1;
  cube.nu = 0.3;
  cube.cells_along = cube.cells_across = 2;
  const Modes modes = cube.modes(30);
  EXPECT_EQ(modes.n_rigid_modes, 6u);
  double worst = 0;
  unsigned int multiple = 0;
  for (unsigned int k = 6; k < modes.omega.size();)
  {
    unsigned int m = 1;
    while (k + m < modes.omega.size() && modes.omega[k + m] / modes.omega[k] - 1 < 1e-6)
    {
      worst = std::max(worst, modes.omega[k + m] / modes.omega[k] - 1);
      ++m;
    }
    if (k + m < modes.omega.size())
      EXPECT_LE(m, 3u);
    multiple += m > 1;
    k += m;
  }
  EXPECT_GE(multiple, 4u);
  EXPECT_LE(worst, 1e-9);
  EXPECT_LE(modes.orthonormality_error, 1e-9);
  report("equal frequencies", worst);
}

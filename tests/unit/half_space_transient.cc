// Two half-spaces in time: by kernels over the distance between points as by matrices of all points, and on a grid whose
// matrices would not fit.

#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/scene/half_space_body.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  BodyParameters half_space(const double young, const double nu, const double radius)
  {
    auto own = std::make_shared<HalfSpaceParameters>();
    own->radius_x = own->radius_y = radius;
    BodyParameters body;
    body.type = "half-space";
    body.material.young_modulus = young;
    body.material.poisson_ratio = nu;
    body.description = own;
    return body;
  }

  const BodyParameters sphere = half_space(206e9, 0.3, 0.4), soft_plane = half_space(70e9, 0.2, 0);

  ContactGrid square(const unsigned int n)
  {
    ContactGrid grid;
    grid.n_x = grid.n_y = n;
    grid.spacing_x = grid.spacing_y = 1e-3;
    grid.x_first = grid.y_first = -0.5e-3 * (n - 1);
    return grid;
  }

  ContactPair pair_on(const ContactGrid &grid, const ContactParameters &contact)
  {
    return contact_pair({&sphere, nullptr}, {&soft_plane, nullptr}, contact, grid);
  }

  /// The same with matrices of all points.
  ContactPair by_matrices(ContactPair pair)
  {
    pair.residual = residual_flexibility(pair);
    pair.half_spaces = nullptr;
    return pair;
  }

  /// Rolls into a lateral creepage beside a load that swings, and back.
  DynamicState rolled(const ContactPair &pair, const ContactParameters &contact, const double end,
                      TransientResult &result)
  {
    TransientParameters p;
    p.time_step = 2e-5;
    p.end_time = end;
    p.lateral_creepage = "0.003*sin(2*pi*t/1e-3)";
    p.normal_force = "4e3*(1+0.5*sin(2*pi*t/6e-4))";
    RollingCase constant;
    constant.creepage = {10, 0.001, 0, 0.3};
    constant.normal_force = 4e3;
    const ContactSolverParameters solver;
    const DriveFunction drive = drive_function(p, constant, pair.interface.contacts.only());
    DynamicState state = initial_state(p, contact, solver, pair, drive(0));
    result = transient(p, contact, solver, pair, drive, state,
                       [](const DynamicState &, const TransientResult &) { return true; });
    return state;
  }
} // namespace

TEST(HalfSpaceTransient, KernelsAreTheMatrices)
{
  const ContactParameters contact;
  const ContactPair kernels = pair_on(square(13), contact), matrices = by_matrices(kernels);
  TransientResult by_kernels, by_columns;
  const DynamicState a = rolled(kernels, contact, 1e-3, by_kernels),
                     b = rolled(matrices, contact, 1e-3, by_columns);
  ASSERT_TRUE(by_kernels.converged && by_columns.converged);
  double difference = 0;
  for (unsigned int i = 0; i < a.R.size(); ++i)
    difference = std::max(difference, std::abs(a.R[i] - b.R[i]));
  EXPECT_LT(difference, 1e-8 * a.R.linfty_norm());
  EXPECT_NEAR(by_kernels.energy.friction, by_columns.energy.friction, 1e-8 * by_columns.energy.friction);
  EXPECT_GT(by_columns.energy.friction, 0);
  std::printf("forces differ by %.1e of the largest\n", difference / a.R.linfty_norm());
}

TEST(HalfSpaceTransient, MemoryFollowsThePointsInContact)
{
  // a matrix of these 40,401 points would take 118 GB; beyond the contact, points change nothing
  const ContactParameters contact;
  const ContactPair wide = pair_on(square(201), contact), narrow = pair_on(square(13), contact);
  EXPECT_EQ(wide.residual.m(), 0u);
  TransientResult of_wide, of_narrow;
  const DynamicState a = rolled(wide, contact, 2e-4, of_wide), b = rolled(narrow, contact, 2e-4, of_narrow);
  ASSERT_TRUE(of_wide.converged && of_narrow.converged);
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int j = 0; j < 13; ++j)
      for (unsigned int i = 0; i < 13; ++i)
        EXPECT_NEAR(a.R[c * 40401 + (j + 94) * 201 + i + 94], b.R[c * 169 + j * 13 + i],
                    1e-8 * b.R.linfty_norm());
}

// Which points enter a time step: none of the others closes unnoticed.

#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/marching/contact_stepper.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/step_levels.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace vibrocontact;

namespace
{
  constexpr unsigned int n_points = 41;
  constexpr double friction = 0.3;

  /// A body of 1 kg that moves up and down, turns and slides to and fro on springs, over two bumps; what else yields does so far
  /// beyond the loaded points.
  ContactPair body_over_two_bumps()
  {
    ContactPair pair;
    ContactGrid &grid = pair.interface.contacts.only();
    grid.n_x = n_points;
    grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = 1e-3;
    const auto place = [](const unsigned int i) { return (double(i) - (n_points - 1) / 2.) * 1e-3; };
    pair.omega = {6e3, 4e3, 5e3};
    pair.trace.reinit(3 * n_points, 3);
    pair.participation.reinit(3, 3);
    for (unsigned int k = 0; k < 3; ++k)
    {
      pair.damping_ratio.push_back(1e-3);
      pair.labels.push_back("body:" + std::to_string(k));
      pair.body.push_back(1);
      pair.modal_load.push_back(0);
    }
    pair.residual.reinit(3 * n_points, 3 * n_points);
    for (unsigned int i = 0; i < n_points; ++i)
    {
      const double left = place(i) + 0.012, right = place(i) - 0.012;
      pair.interface.gap.push_back(std::min(left * left / 0.6, 9e-6 + right * right / 0.6));
      pair.trace(i, 0) = 1;
      pair.trace(i, 1) = place(i) / 0.01;
      pair.trace(n_points + i, 2) = 1;
      for (unsigned int j = 0; j < n_points; ++j)
      {
        const double decay = std::exp(-std::abs(place(i) - place(j)) / 0.02);
        for (unsigned int c = 0; c < 3; ++c)
          pair.residual(c * n_points + i, c * n_points + j) = 2e-8 * decay;
        pair.residual(i, n_points + j) = pair.residual(n_points + i, j) = 8e-9 * decay;
      }
    }
    return pair;
  }

  /// gap of all points at the end of a step
  DenseVector gaps_of(const ContactPair &pair, const DynamicState &state)
  {
    DenseVector displacement(3 * n_points), moved(3 * n_points), q(state.q.size());
    pair.residual.vmult(displacement, state.R);
    std::copy(state.q.begin(), state.q.end(), q.begin());
    pair.trace.vmult(moved, q);
    DenseVector gaps(n_points);
    for (unsigned int i = 0; i < n_points; ++i)
      gaps[i] = pair.interface.gap[i] + displacement[i] + moved[i] - state.contact.approach;
    return gaps;
  }
} // namespace

TEST(Proximity, NoPointClosesUnnoticed)
{
  const ContactPair pair = body_over_two_bumps();
  TransientParameters transient;
  ContactSections contact;
  contact.first().friction = friction;
  const ContactSolverParameters solver;
  Drive drive;
  drive.creepage.speed = 0.01;
  drive.creepage.lateral = 10;
  drive.approach = 3e-6;
  const double h = 5e-6;
  DynamicState state = initial_state(transient, contact, solver, pair, drive);
  state.v[0] = 0.01;
  state.v[1] = 0.05;
  state.v[2] = 0.05;
  ContactStepper stepper(pair, creep_schemes().front(), contact, modal_steps(transient, pair, h), h,
                         drive.creepage.speed);
  const auto contact_solver = create_contact_solver(solver);
  std::set<std::vector<unsigned int>> sets;
  unsigned int n_both = 0, n_left = 0;
  for (unsigned int step = 0; step < 1500; ++step)
  {
    ASSERT_TRUE(stepper.advance(state, drive, *contact_solver).converged) << step;
    const DenseVector gaps = gaps_of(pair, state);
    sets.insert(state.nearby);
    bool left = false, right = false;
    for (unsigned int i = 0; i < n_points; ++i)
    {
      const double tolerance = 1e-13;
      EXPECT_GT(gaps[i], -tolerance) << step << ", " << i;
      if (!std::binary_search(state.nearby.begin(), state.nearby.end(), i))
        EXPECT_LE(std::abs(gaps[i] - state.contact.y[i]), state.moved_since_look + tolerance)
            << step << ", " << i;
      (i < n_points / 2 ? left : right) |= state.R[i] > 0;
    }
    n_both += left && right;
    n_left += left && !right;
  }
  std::printf("%zu sets of nearby points; the second bump touches in %u steps, not in %u\n", sets.size(),
              n_both, n_left);
  EXPECT_GT(sets.size(), 3u);
  EXPECT_GT(n_both, 50u);
  EXPECT_GT(n_left, 50u);
}

// W~ of forces and of their last two changes by one pass over W~ is what a pass for each gives.
TEST(Proximity, DisplacementsAndTheirChangesAreThoseOfTheirOwnForces)
{
  ContactPair pair = body_over_two_bumps();
  RelaxingRest rest;
  rest.body = 1;
  rest.flexibility = pair.residual;
  rest.flexibility *= 0.1;
  rest.relaxation = 1e-4;
  pair.relaxing = {rest};
  DynamicState state;
  const unsigned int n_rows = 3 * n_points;
  for (DenseVector *const x : {&state.R, &state.force_change, &state.force_change_before})
    x->reinit(n_rows);
  state.relaxed = {DenseVector(n_rows)};
  for (unsigned int row = 0; row < n_rows; row += 2)
  {
    state.R[row] = 10 + row;
    state.force_change[row] = std::cos(1. * row);
    state.force_change_before[row] = std::sin(1. * row);
    state.relaxed[0][row] = 5;
  }
  DynamicState expected = state;
  set_residual_displacement(pair, expected);
  for (auto [forces, displacement] :
       {std::pair(&state.force_change, &expected.residual_change),
        std::pair(&state.force_change_before, &expected.residual_change_before)})
  {
    displacement->reinit(n_rows);
    pair.residual.vmult(*displacement, *forces);
  }
  set_residual_displacement_and_changes(pair, state);
  for (unsigned int row = 0; row < n_rows; ++row)
  {
    EXPECT_EQ(state.residual_displacement[row], expected.residual_displacement[row]) << row;
    EXPECT_NEAR(state.residual_change[row], expected.residual_change[row],
                1e-14 * expected.residual_change.linfty_norm());
    EXPECT_NEAR(state.residual_change_before[row], expected.residual_change_before[row],
                1e-14 * expected.residual_change_before.linfty_norm());
  }
  EXPECT_GT(expected.residual_change.linfty_norm(), 0.);
  EXPECT_NE(expected.residual_change[0], expected.residual_change_before[0]);
}

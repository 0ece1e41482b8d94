// Modes: rigid ones counted, closed forms, pairs kept and turned, one rank as two.

#include "reduction_bodies.h"

#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/modes.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <gtest/gtest.h>

using namespace vibrocontact;
using namespace reduction_test;

namespace
{
  BlockParameters bar(const double length, const double width, const double height, const unsigned int n)
  {
    BlockParameters parameters;
    parameters.length = length;
    parameters.width = width;
    parameters.height = height;
    parameters.divisions_x = parameters.divisions_y = parameters.divisions_z = n;
    return parameters;
  }

  Modes modes_of(const Body &body, const unsigned int count, const double upper_frequency = 0)
  {
    Flexibility flexibility(*body.system);
    ModeParameters parameters;
    parameters.count = count;
    parameters.upper_frequency = upper_frequency;
    return compute_modes(*body.system, flexibility, parameters);
  }
} // namespace

TEST(ModesMpi, FreeBlockHasSixRigidModes)
{
  BlockParameters parameters = bar(0.1, 0.08, 0.06, 3);
  parameters.held.clear();
  const Body body = make_body(parameters, ElasticModel<3>(), MPI_COMM_WORLD, 4);
  const Modes modes = modes_of(body, 8);
  EXPECT_EQ(modes.n_rigid_modes, 6u);
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_EQ(modes.omega[i], 0.);
  EXPECT_GT(modes.omega[6], 1e4);
  EXPECT_LT(modes.orthonormality_error, 1e-10);
  EXPECT_LT(modes.residual, 1e-6);
}

// Anasazi mixes up which value belongs to which vector where rounding makes complex pairs, once in some hundred to a thousand rings: shapes
// in any order and of any size have to find their frequencies.
TEST(ModesMpi, ShapesTellTheirFrequencies)
{
  BlockParameters parameters = bar(0.1, 0.08, 0.06, 3);
  parameters.held.clear();
  const Body body = make_body(parameters, ElasticModel<3>(), MPI_COMM_WORLD, 4);
  const Modes modes = modes_of(body, 20);
  Modes mixed = modes;
  std::reverse(mixed.shapes.begin() + 6, mixed.shapes.end());
  for (unsigned int k = 6; k < mixed.shapes.size(); ++k)
    mixed.shapes[k] *= k;
  take_frequencies_of_shapes(*body.system, 6, mixed);
  ASSERT_EQ(mixed.omega.size(), modes.omega.size());
  for (unsigned int k = 0; k < modes.omega.size(); ++k)
  {
    EXPECT_NEAR(mixed.omega[k], modes.omega[k], 1e-9 * modes.omega.back()) << k;
    dealii::PETScWrappers::MPI::Vector inertia(modes.shapes[k]);
    body.system->mass.vmult(inertia, modes.shapes[k]);
    const double expected = k < 6 ? 1 : modes.omega.size() + 5 - k;
    EXPECT_NEAR(mixed.shapes[k] * inertia, expected, 1e-9 * expected) << k;
  }
}

TEST(Modes, CantileverAgainstClosedForms)
{
  // Without Poisson effect the axial modes of a bar held at one end are those of the rod, f = c / (4 L).
  BlockParameters parameters = bar(1., 0.04, 0.05, 1);
  parameters.divisions_x = 24;
  parameters.held = {"left"};
  ElasticModel<3> model;
  model.material.poisson_ratio = 0;
  const Body body = make_body(parameters, model, MPI_COMM_SELF, 0);
  const Modes modes = modes_of(body, 0, 1500.);
  const double c = std::sqrt(model.material.young_modulus / model.material.density), pi = dealii::numbers::PI;
  std::vector<double> frequencies;
  for (const double omega : modes.omega)
    frequencies.push_back(omega / (2 * pi));
  const auto error_at = [&](const double exact)
  {
    double best = 1;
    for (const double f : frequencies)
      best = std::min(best, std::abs(f / exact - 1));
    return best;
  };
  EXPECT_LT(error_at(c / 4), 1e-6);
  // Euler-Bernoulli, slenderness 25 and 20: shear takes off less than 0.5 % of the first, 3 % of the second
  // bending mode.
  const auto bending = [&](const double beta, const double h)
  { return beta * beta / (2 * pi) * c * h / std::sqrt(12.); };
  EXPECT_LT(error_at(bending(1.8751041, 0.04)), 5e-3);
  EXPECT_LT(error_at(bending(1.8751041, 0.05)), 5e-3);
  EXPECT_LT(error_at(bending(4.6940911, 0.04)), 3e-2);
  EXPECT_LT(modes.orthonormality_error, 1e-10);
}

TEST(ModesMpi, PairIsNotSplitAndTurned)
{
  // A square column: bending along x (antisymmetric to x = 0) and along y (symmetric) at the same frequency.
  BlockParameters parameters = bar(0.05, 0.05, 0.5, 2);
  parameters.divisions_z = 10;
  const Body body = make_body(parameters, ElasticModel<3>(), MPI_COMM_WORLD, 4);
  const Modes modes = modes_of(body, 1);
  ASSERT_EQ(modes.omega.size(), 2u);
  EXPECT_NEAR(modes.omega[1] / modes.omega[0], 1., 1e-9);
  // x and y displacements of the top
  const auto a = contact_trace(body.system->trace, modes.shapes[0]),
             b = contact_trace(body.system->trace, modes.shapes[1]);
  EXPECT_LT(std::abs(a[4]), 1e-5 * std::abs(a[8]));
  EXPECT_LT(std::abs(b[8]), 1e-5 * std::abs(b[4]));
}

TEST(ModesMpi, OneRankAsTwo)
{
  BlockParameters parameters = bar(0.1, 0.08, 0.06, 3);
  parameters.offset_x = 0.013;
  const Body together = make_body(parameters, ElasticModel<3>(), MPI_COMM_WORLD, 4),
             alone = make_body(parameters, ElasticModel<3>(), MPI_COMM_SELF, 4);
  const Modes a = modes_of(together, 10), b = modes_of(alone, 10);
  ASSERT_EQ(a.omega.size(), b.omega.size());
  for (unsigned int i = 0; i < a.omega.size(); ++i)
  {
    EXPECT_NEAR(a.omega[i] / b.omega[i], 1., 1e-10);
    const auto u = contact_trace(together.system->trace, a.shapes[i]),
               v = contact_trace(alone.system->trace, b.shapes[i]);
    double difference = 0, scale = 0;
    for (unsigned int k = 0; k < u.size(); ++k)
    {
      difference = std::max(difference, std::abs(u[k] - v[k]));
      scale = std::max(scale, std::abs(u[k]));
    }
    EXPECT_LT(difference, 1e-8 * scale) << "mode " << i;
  }
}

TEST(Modes, DoubleFrequenciesAreAllFound)
{
  // A block with square faces has exactly double frequencies; LAPACK on the full matrices is the reference.
  for (const bool free : {false, true})
  {
    BlockParameters parameters = bar(0.1, 0.1, 0.06, 2);
    if (free)
      parameters.held.clear();
    const Body body = make_body(parameters, ElasticModel<3>(), MPI_COMM_SELF, 4);
    Flexibility flexibility(*body.system);
    ModeParameters mode_parameters;
    mode_parameters.count = 15;
    const Modes modes = compute_modes(*body.system, flexibility, mode_parameters);
    EXPECT_LT(modes.orthonormality_error, 1e-9);

    std::vector<unsigned int> unknowns; // held dofs have no mass
    for (unsigned int i = 0; i < body.system->mass.m(); ++i)
      if (body.system->mass.diag_element(i) != 0)
        unknowns.push_back(i);
    dealii::LAPACKFullMatrix<double> K(unknowns.size()), M(unknowns.size());
    for (unsigned int i = 0; i < unknowns.size(); ++i)
      for (unsigned int j = 0; j < unknowns.size(); ++j)
      {
        K(i, j) = body.system->stiffness.el(unknowns[i], unknowns[j]);
        M(i, j) = body.system->mass.el(unknowns[i], unknowns[j]);
      }
    std::vector<dealii::Vector<double>> vectors;
    K.compute_generalized_eigenvalues_symmetric(M, vectors);
    for (unsigned int i = modes.n_rigid_modes; i < modes.omega.size(); ++i)
      EXPECT_NEAR(modes.omega[i] / std::sqrt(K.eigenvalue(i).real()), 1., 1e-8) << "mode " << i;
  }
}

namespace
{
  /// Equal chains of equal masses [1 kg] and springs [1 N/m], each held at its first spring.
  void equal_chains(const unsigned int n_chains, const unsigned int n_links, SecondOrderSystem &system)
  {
    system.body = "chains";
    system.communicator = MPI_COMM_SELF;
    const unsigned int n = n_chains * n_links;
    system.locally_owned = dealii::complete_index_set(n);
    dealii::DynamicSparsityPattern pattern(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i == 0 ? 0 : i - 1; j <= std::min(n - 1, i + 1); ++j)
        pattern.add(i, j);
    for (auto *const matrix : {&system.mass, &system.stiffness})
      matrix->reinit(system.locally_owned, system.locally_owned, pattern, MPI_COMM_SELF);
    for (unsigned int i = 0; i < n; ++i)
    {
      const bool is_last = (i + 1) % n_links == 0;
      system.mass.set(i, i, 1.);
      system.stiffness.set(i, i, is_last ? 1. : 2.);
      if (!is_last)
      {
        system.stiffness.set(i, i + 1, -1.);
        system.stiffness.set(i + 1, i, -1.);
      }
      system.dof_position.emplace_back(i % n_links, i / n_links, 0);
      system.dof_direction.push_back(0);
    }
    for (auto *const matrix : {&system.mass, &system.stiffness})
      matrix->compress(dealii::VectorOperation::insert);
  }
} // namespace

TEST(Modes, FrequenciesOfMoreCopiesThanABlockHasColumns)
{
  // By a second Krylov sequence beside the first, and by LAPACK beside it where few dofs are left; the frequencies
  // 2 sin((2 k - 1) pi / (4 n + 2)) of a chain of n links are known.
  struct Case
  {
    unsigned int n_chains, n_links, count;
  };
  for (const Case &c : {Case{12, 40, 24}, Case{24, 3, 12}})
  {
    SecondOrderSystem system;
    equal_chains(c.n_chains, c.n_links, system);
    Flexibility flexibility(system);
    ModeParameters parameters;
    parameters.count = c.count;
    const Modes modes = compute_modes(system, flexibility, parameters);
    ASSERT_GE(modes.omega.size(), c.count);
    EXPECT_LT(modes.orthonormality_error, 1e-9);
    for (unsigned int i = 0; i < modes.omega.size(); ++i)
    {
      const unsigned int k = i / c.n_chains;
      EXPECT_NEAR(modes.omega[i], 2 * std::sin((2 * k + 1) * dealii::numbers::PI / (4 * c.n_links + 2)), 1e-9)
          << "mode " << i;
    }
  }
}

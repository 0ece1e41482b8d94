// Harmonic response with hysteretic loss: direct solution against a closed form and against dense LAPACK, modal
// response against the direct one; on any number of ranks.

#include "pi.h"

#include <vibrocontact/analyses/frequency_response/frequency_response.h>
#include <vibrocontact/analyses/frequency_response/modal_response.h>
#include <vibrocontact/fe/bar_elements.h>
#include <vibrocontact/fe/beam_elements.h>
#include <vibrocontact/numerics/frequency_refinement.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace vibrocontact;
using Complex = std::complex<double>;

namespace
{
  double error(const Complex &got, const Complex &exact)
  {
    return std::abs(got - exact) / std::abs(exact);
  }

  /// A short beam rail of steel on its pads.
  std::unique_ptr<SecondOrderSystem> short_rail(const double length, BeamRailParameters &rail)
  {
    rail.length = length;
    ElasticMaterial material;
    material.young_modulus = 205e9;
    material.poisson_ratio = 0.3;
    material.loss_factor = 0.02;
    return assemble_beam_rail(rail, material, "rail", nullptr, MPI_COMM_WORLD);
  }
} // namespace

TEST(FrequencyResponseMpi, lossy_bar_in_closed_form)
{
  // receptance of the free end: tan(k L) / (E* S k), k^2 = w^2 rho / E*, E* = E (1 + i eta)
  ElasticMaterial material;
  material.young_modulus = 900;
  material.poisson_ratio = 0;
  material.density = 1;
  material.loss_factor = 0.1;
  BarParameters bar;
  bar.length = 10;
  bar.section = 2;
  bar.divisions = 40;
  bar.degree = 4;
  ContactGrid grid;
  grid.n_x = grid.n_y = 1;
  grid.spacing_x = grid.spacing_y = 1;
  const auto system = assemble_bar(bar, material, "bar", true, &grid, MPI_COMM_WORLD);
  const std::vector<TraceRow> points = {system->trace.rows[0]};
  HarmonicSolver solver(*system);
  Flexibility flexibility(*system);
  ModeParameters parameters;
  parameters.count = 40;
  const Modes modes = compute_modes(*system, flexibility, parameters);
  const auto body =
      reduce_response(*system, flexibility, modes, strain_energy_damping(*system, modes), false, points);
  const std::vector<double> frequency = {0.1, 0.7, 2.3, 5.1};
  const auto modal = hysteretic_response(body, modes.omega.size(), frequency);
  for (unsigned int i = 0; i < frequency.size(); ++i)
  {
    const double omega = two_pi * frequency[i];
    const Complex E = 900. * Complex(1, 0.1), k = omega / std::sqrt(E);
    const Complex exact = std::tan(k * 10.) / (E * 2. * k);
    EXPECT_LT(error(solver.receptance(omega, points)[0], exact), 1e-9) << frequency[i];
    EXPECT_LT(error(modal[i][0], exact), 2e-4) << frequency[i]; // 40 modes to 59 Hz
  }
}

TEST(FrequencyResponseMpi, direct_solution_against_dense_lapack)
{
  BeamRailParameters rail;
  rail.element_length = 0.6;
  rail.degree = 2;
  rail.anechoic_lengths = {0.3, 0.3};
  const auto system = short_rail(2.4, rail);
  const auto points = beam_rail_rows(rail, "rail", 0.1, 0.01, 0.08);
  const unsigned int n = system->stiffness.m();
  const double omega = two_pi * 800;
  // all rows on every rank
  std::vector<double> flat(3 * n * n, 0.);
  for (const auto row : system->locally_owned)
    for (unsigned int m = 0; m < 3; ++m)
    {
      const auto &matrix = m == 0 ? system->stiffness : m == 1 ? system->loss_stiffness : system->mass;
      for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
        flat[(m * n + row) * n + entry->column()] = entry->value();
    }
  MPI_Allreduce(MPI_IN_PLACE, flat.data(), flat.size(), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  dealii::LAPACKFullMatrix<Complex> A(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      A(i, j) = Complex(flat[i * n + j] - omega * omega * flat[(2 * n + i) * n + j], flat[(n + i) * n + j]);
  A.compute_lu_factorization();
  const auto receptance = HarmonicSolver(*system).receptance(omega, points);
  for (unsigned int force = 0; force < 3; ++force)
  {
    dealii::Vector<Complex> u(n);
    for (const auto &[dof, weight] : points[force])
      u(dof) = weight;
    A.solve(u);
    for (unsigned int i = 0; i < 3; ++i)
    {
      Complex expected = 0;
      for (const auto &[dof, weight] : points[i])
        expected += weight * u(dof);
      EXPECT_LT(std::abs(receptance[3 * i + force] - expected), 1e-9 * std::abs(receptance[4 * force]));
      EXPECT_LT(std::abs(receptance[3 * i + force] - receptance[3 * force + i]),
                1e-9 * std::abs(receptance[0]));
    }
  }
}

TEST(FrequencyResponseMpi, modal_response_converges_to_the_direct_one)
{
  // Loss couples the modes strongly here: pads have a loss factor of 1, the rail of 0.02.
  BeamRailParameters rail;
  const auto system = short_rail(4.8, rail);
  std::vector<TraceRow> points = {beam_rail_rows(rail, "rail", 0., 0., 0.08)[0],
                                  beam_rail_rows(rail, "rail", 0.3, 0., 0.08)[0],
                                  beam_rail_rows(rail, "rail", 0., 0., 0.08)[2]};
  Flexibility flexibility(*system);
  ModeParameters parameters;
  parameters.upper_frequency = 12000;
  const Modes modes = compute_modes(*system, flexibility, parameters);
  const auto body =
      reduce_response(*system, flexibility, modes, strain_energy_damping(*system, modes), false, points);
  const std::vector<double> frequency = {0.01, 100, 334, 918, 1058, 1670, 3417};
  unsigned int n_advance = 0;
  const DirectResponse direct = solve_directly(*system, points, frequency, [&] { ++n_advance; });
  EXPECT_EQ(n_advance, frequency.size());
  // ranks that share the frequencies, each with all of the matrices, and all ranks together
  HarmonicSolver together(*system);
  for (unsigned int k = 0; k < frequency.size(); ++k)
  {
    const auto receptance = together.receptance(two_pi * frequency[k], points);
    for (unsigned int i = 0; i < 9; ++i)
      EXPECT_LT(std::abs(receptance[i] - Complex(direct.real(k, i), direct.imaginary(k, i))),
                1e-9 * std::abs(receptance[0]));
  }
  double last = 1e300, diagonal = 0;
  for (const double cut : {5000., 12000.})
  {
    const unsigned int n =
        std::lower_bound(modes.omega.begin(), modes.omega.end(), two_pi * cut) - modes.omega.begin();
    const auto modal = hysteretic_response(body, n, frequency),
               in_time = time_domain_response(body, n, frequency);
    double worst = 0;
    for (unsigned int k = 0; k < frequency.size(); ++k)
      for (unsigned int i = 0; i < 3; ++i)
      {
        const Complex exact(direct.real(k, 4 * i), direct.imaginary(k, 4 * i));
        worst = std::max(worst, error(modal[k][4 * i], exact));
        diagonal = std::max(diagonal, k > 0 ? error(in_time[k][4 * i], exact) : 0.);
        EXPECT_LT(exact.imag(), 0);
      }
    std::cout << n << " modes to " << cut << " Hz: coupled loss off by at most " << worst
              << ", modal damping by " << diagonal << std::endl;
    EXPECT_LT(worst, last / 3);
    last = worst;
  }
  EXPECT_LT(last, 1e-3);
  EXPECT_GT(diagonal, 10 * last);

  // A run in time with modes to 5 kHz has the imaginary part at the squeal frequencies, one with modes to 2 kHz has
  // lost it at 3417 Hz.
  for (const double cut : {5000., 2000.})
  {
    const unsigned int n =
        std::lower_bound(modes.omega.begin(), modes.omega.end(), two_pi * cut) - modes.omega.begin();
    const double imaginary = time_domain_response(body, n, {3417.})[0][0].imag(),
                 exact = direct.imaginary(6, 0);
    std::cout << "cut at " << cut << " Hz: imaginary receptance at 3417 Hz off by " << imaginary / exact - 1
              << std::endl;
    if (cut == 2000)
    {
      EXPECT_LT(imaginary / exact, 0.2);
    }
    else
    {
      EXPECT_NEAR(imaginary / exact, 1, 0.1);
    }
  }
}

TEST(FrequencyResponse, points_and_frequencies)
{
  FrequencyResponseParameters parameters;
  parameters.points = "midspan: 0, 0.01, z; rim: 0, -0.02, 0.9, y";
  const auto points = parameters.parsed_points();
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].component, 0u);
  EXPECT_FALSE(points[0].z);
  EXPECT_EQ(points[1].component, 2u);
  EXPECT_EQ(*points[1].z, 0.9);
  parameters.count = 3;
  EXPECT_NEAR(parameters.frequencies()[1], 500, 1e-9);
  parameters.list = {10, 20};
  EXPECT_EQ(parameters.frequencies().size(), 2u);
}

// Four resonances of 1 % loss: the mean error of the curve drawn through 100 frequencies, 20 of them given.
TEST(FrequencyResponse, refined_frequencies_follow_the_resonances)
{
  const auto level = [](const double f)
  {
    Complex sum = 0;
    for (const double own : {180., 415., 1230., 3300.})
      sum += 1. / (own * own * Complex(1, 0.01) - f * f);
    return std::log(std::abs(sum));
  };
  const auto spaced = [](const unsigned int n)
  {
    FrequencyResponseParameters parameters;
    parameters.count = n;
    return parameters.frequencies();
  };
  const auto mean_error = [&](const std::vector<double> &frequency)
  {
    double sum = 0;
    for (const double f : spaced(5000))
    {
      const unsigned int k =
          std::clamp<int>(std::upper_bound(frequency.begin(), frequency.end(), f) - frequency.begin(), 1,
                          frequency.size() - 1);
      const double share = std::log(f / frequency[k - 1]) / std::log(frequency[k] / frequency[k - 1]);
      sum += std::abs((1 - share) * level(frequency[k - 1]) + share * level(frequency[k]) - level(f));
    }
    return sum / 5000;
  };
  std::vector<double> frequency = spaced(20);
  for (unsigned int round = 0; round < 20; ++round)
  {
    std::vector<Receptance> receptance;
    for (const double f : frequency)
      receptance.push_back({std::exp(level(f))});
    const std::vector<double> more = frequencies_between(frequency, receptance, 4);
    ASSERT_EQ(more.size(), 4u);
    frequency.insert(frequency.end(), more.begin(), more.end());
    std::sort(frequency.begin(), frequency.end());
    ASSERT_EQ(std::adjacent_find(frequency.begin(), frequency.end()), frequency.end());
  }
  EXPECT_LT(mean_error(frequency), 0.02);
  EXPECT_GT(mean_error(spaced(100)), 0.05);
  // a straight line has nothing to refine
  EXPECT_TRUE(frequencies_between({1, 2, 4, 8}, {{1}, {0.25}, {0.0625}, {0.015625}}, 4).empty());
}

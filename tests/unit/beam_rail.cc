// The rail as a Timoshenko beam: waves and static stiffness in closed form or known numbers, levers of the
// contact, symmetry, damping; on any number of ranks.

#include <vibrocontact/fe/beam_elements.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;
using dealii::numbers::PI;

namespace
{
  ElasticMaterial rail_steel()
  {
    ElasticMaterial material;
    material.young_modulus = 205e9;
    material.poisson_ratio = 0.3;
    material.loss_factor = 0.02;
    return material;
  }

  ContactGrid one_point()
  {
    ContactGrid grid;
    grid.n_x = grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = 1e-3;
    return grid;
  }

  /// Frequencies of one span of 0.6 m whose sections at the ends neither shift nor twist but turn freely: waves
  /// of wavenumber pi / 0.6. `n` lowest [Hz].
  std::vector<double> span_frequencies(BeamRailParameters rail, const unsigned int n)
  {
    rail.length = 0.6;
    rail.element_length = 0.1;
    rail.pad_stiffness_x = rail.pad_stiffness_y = rail.pad_stiffness_z = 0;
    const auto system = assemble_beam_rail(rail, rail_steel(), "rail", nullptr, MPI_COMM_WORLD);
    std::vector<PetscInt> fixed;
    for (unsigned int i = 0; i < system->dof_position.size(); ++i)
    {
      const double x = system->dof_position[i][0];
      const unsigned int field = system->dof_direction[i];
      if ((field >= 1 && field <= 3 && std::abs(std::abs(x) - 0.3) < 1e-6) ||
          (field == 0 && std::abs(x) < 1e-6))
        fixed.push_back(system->locally_owned.nth_index_in_set(i));
    }
    MatZeroRowsColumns(system->stiffness, fixed.size(), fixed.data(), 1e9, nullptr, nullptr);
    MatZeroRowsColumns(system->mass, fixed.size(), fixed.data(), 0., nullptr, nullptr);
    system->n_rigid_modes = 0;
    system->rigid_motions.clear();
    Flexibility flexibility(*system);
    ModeParameters modes;
    modes.count = n;
    std::vector<double> result;
    for (const double omega : compute_modes(*system, flexibility, modes).omega)
      result.push_back(omega / (2 * PI));
    return result;
  }

  double nearest(const std::vector<double> &values, const double target)
  {
    return *std::min_element(values.begin(), values.end(),
                             [&](double a, double b) { return std::abs(a - target) < std::abs(b - target); });
  }

  /// Lower branch of Timoshenko's dispersion at wavenumber k [Hz].
  double timoshenko(const double k, const double EI, const double kGA, const double rho_A, const double rho_I)
  {
    const double a = rho_A * rho_I, b = -(rho_A * (kGA + EI * k * k) + rho_I * kGA * k * k),
                 c = kGA * EI * k * k * k * k;
    return std::sqrt((-b - std::sqrt(b * b - 4 * a * c)) / (2 * a)) / (2 * PI);
  }

  DenseMatrix compliance(const BeamRailParameters &rail, const ContactGrid &grid)
  {
    const auto system = assemble_beam_rail(rail, rail_steel(), "rail", &grid, MPI_COMM_WORLD);
    Flexibility flexibility(*system);
    return flexibility.contact_compliance();
  }
} // namespace

TEST(BeamRailMpi, waves_of_a_free_span)
{
  const BeamRailParameters rail;
  const double G = 205e9 / 2.6, k = PI / 0.6, rho = 7800;
  const auto f = span_frequencies(rail, 6);
  const double vertical =
      timoshenko(k, 205e9 * rail.moment_y, 0.4 * G * rail.area, rho * rail.area, rho * rail.moment_y);
  std::cout << "vertical " << nearest(f, 1053) << " (closed form " << vertical
            << ", solid rail 1053), lateral " << nearest(f, 499) << " (solid 499), torsion "
            << nearest(f, 828) << " Hz (solid 828)" << std::endl;
  EXPECT_NEAR(nearest(f, vertical) / vertical, 1, 1e-6);
  EXPECT_NEAR(vertical / 1058, 1, 5e-4); // pinned-pinned over point supports, shear coefficient 0.4
  EXPECT_NEAR(vertical / 1053, 1, 6e-3);
  EXPECT_NEAR(nearest(f, 499) / 499, 1, 0.012);
  // the solid rail's web bends as it twists, the beam's section keeps its shape
  EXPECT_NEAR(nearest(f, 828) / 828, 1.06, 0.01);

  // Shear centre in the centroid, no warping: lateral bending and Saint-Venant's torsion by themselves.
  BeamRailParameters simple = rail;
  simple.shear_centre_height = simple.centroid_height;
  simple.warping_constant = 0;
  const auto plain = span_frequencies(simple, 6);
  const double lateral = timoshenko(k, 205e9 * rail.moment_z, 0.55 * G * rail.area, rho * rail.area,
                                    rho * rail.moment_z),
               torsion = k / (2 * PI) *
                         std::sqrt(G * rail.torsion_constant / (rho * (rail.moment_y + rail.moment_z)));
  EXPECT_NEAR(nearest(plain, lateral) / lateral, 1, 1e-6);
  EXPECT_NEAR(nearest(plain, torsion) / torsion, 1, 1e-6);
  std::cout << "without shear centre and warping: lateral " << lateral << ", torsion " << torsion << " Hz"
            << std::endl;
}

TEST(BeamRailMpi, static_stiffness_and_levers)
{
  BeamRailParameters rail;
  rail.pad_length = 0;
  // no breadth to speak of, but enough that the foot does not roll over
  rail.foot_width = 0.02;
  // no lever of the pads' longitudinal springs below the centroid, which holds the beam's slope
  rail.pad_stiffness_x = 1e3;
  ContactGrid grid = one_point();
  const double expected[2] = {260e6, 304e6};
  unsigned int place = 0;
  for (const std::string at : {"mid-span", "support"})
  {
    rail.contact_at = at;
    rail.lateral_position = 0;
    const DenseMatrix middle = compliance(rail, grid);
    std::cout << at << ": vertical stiffness " << 1e-6 / middle(0, 0) << " MN/m" << std::endl;
    EXPECT_NEAR(1 / middle(0, 0) / expected[place], 1, 2e-3);
    // a force off the symmetry plane adds the twist by its moment: eta^2 / kt, kt from two levers
    rail.lateral_position = 0.01;
    rail.crown_radius = 0;
    const double twist = (compliance(rail, grid)(0, 0) - middle(0, 0)) / 1e-4;
    rail.lateral_position = 0.02;
    EXPECT_NEAR((compliance(rail, grid)(0, 0) - middle(0, 0)) / 4e-4 / twist, 1, 1e-6);
    // the vertical force there bends the crown sideways as the lateral force lifts it, by zeta_s times twist
    // and the pads' lateral answer
    const DenseMatrix off = compliance(rail, grid);
    EXPECT_NEAR(off(0, 2) / off(2, 0), 1, 1e-9);
    EXPECT_LT(off(0, 2), 0); // pressing at y > 0 moves the crown towards y > 0
    ++place;
  }
}

TEST(BeamRailMpi, trace_has_rank_six_and_modes_leave_a_semi_definite_residual)
{
  BeamRailParameters rail;
  rail.length = 6;
  ContactGrid grid = one_point();
  grid.n_x = 5;
  grid.n_y = 3;
  grid.x_first = -2e-3;
  grid.y_first = -1e-3;
  const auto system = assemble_beam_rail(rail, rail_steel(), "rail", &grid, MPI_COMM_WORLD);
  Flexibility flexibility(*system);
  DenseMatrix all = flexibility.contact_compliance();
  all.compute_eigenvalues();
  unsigned int rank = 0;
  for (unsigned int i = 0; i < all.m(); ++i)
    rank += std::abs(all.eigenvalue(i)) > 1e-13 ? 1 : 0;
  EXPECT_EQ(rank, 6u);
  ModeParameters parameters;
  parameters.upper_frequency = 3000;
  const StaticReduction statics = reduce_statically(*system, flexibility);
  const ModalReduction modal = reduce_modally(*system, flexibility, parameters, {});
  const ReducedBody body = combine(statics, &modal); // throws if W~ is not semi-definite
  DenseMatrix compliance = body.residual;
  add_modal_compliance(compliance, body.trace, body.omega, body.name);
  const double whole = compliance(0, 0);
  EXPECT_NEAR(whole / statics.compliance(0, 0), 1, 1e-9);
  EXPECT_LT(body.residual(0, 0), 0.1 * whole);
  // every mode loses between the rail's and the pads' share
  for (const double zeta : modal.damping_ratio)
  {
    EXPECT_GT(zeta, 0.00999);
    EXPECT_LT(zeta, 0.5);
  }
}

TEST(BeamRailMpi, free_rail_has_six_motions)
{
  BeamRailParameters rail;
  rail.length = 3;
  rail.pad_stiffness_x = rail.pad_stiffness_y = rail.pad_stiffness_z = 0;
  const ContactGrid grid = one_point();
  const auto system = assemble_beam_rail(rail, rail_steel(), "rail", &grid, MPI_COMM_WORLD);
  Flexibility flexibility(*system); // throws if one of them costs energy
  ModeParameters parameters;
  parameters.count = 4;
  const ModalReduction modal = reduce_modally(*system, flexibility, parameters, {});
  EXPECT_EQ(modal.n_rigid_modes, 6u);
  double mass = 0;
  for (unsigned int k = 0; k < 6; ++k)
    mass += std::pow(modal.participation(k, 2), 2);
  EXPECT_NEAR(mass / (7800 * rail.area * rail.length), 1, 1e-9);
}

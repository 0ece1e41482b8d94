// Bodies under the stress of their rotation and of their loads against closed forms.

#include <vibrocontact/analyses/frequency_response/modal_response.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/nearest_dof.h>
#include <vibrocontact/fe/prestress.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/flow_reduction.h>
#include <vibrocontact/reduction/prestressed_body.h>
#include <vibrocontact/scene/blade.h>
#include <vibrocontact/scene/block.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

using namespace vibrocontact;
using dealii::numbers::PI;

namespace
{
  struct PrestressedModes
  {
    PrestressedModes(BodyMesh<3> &&mesh, const ElasticModel<3> &model, const unsigned int degree,
                     const unsigned int n_modes)
        : elastic(std::move(mesh), model, degree), system(assemble_body(elastic))
    {
      prestress(elastic, StiffnessSolver::direct, *system);
      flexibility = std::make_unique<Flexibility>(*system);
      ModeParameters asked;
      asked.count = n_modes;
      modes = compute_modes(*system, *flexibility, asked);
    }

    /// Im lambda of the modes with Coriolis forces [rad/s]
    std::vector<double> whirls()
    {
      BodyInContact at_rest;
      at_rest.omega = modes.omega;
      at_rest.damping_ratio.assign(modes.omega.size(), 0.);
      const ComplexModes found =
          complex_modes(at_rest, reduce_flow(*system, *flexibility, modes), elastic.model.rotation.speed);
      std::vector<double> result;
      for (const std::complex<double> &pole : found.poles)
        result.push_back(pole.imag());
      return result;
    }

    ElasticBody<3> elastic;
    std::unique_ptr<SecondOrderSystem> system;
    std::unique_ptr<Flexibility> flexibility;
    Modes modes;
  };

  /// A straight bar along z, held at z = 0, thin along y.
  struct TurningBar
  {
    TurningBar(const double thickness, const double width)
    {
      blade.length = 1;
      blade.thickness = thickness;
      blade.chord = width;
      blade.tip_angle = 0;
      blade.length_divisions = 6;
      blade.chord_divisions = 1;
      blade.element_degree = 3;
      model.material.young_modulus = 2e11;
      model.material.poisson_ratio = 0;
      model.material.density = 8000;
    }
    /// sqrt(E I / (rho A L^4)) of bending along y [rad/s]
    double unit() const
    {
      return blade.thickness / std::sqrt(12.) *
             std::sqrt(model.material.young_modulus / model.material.density);
    }
    PrestressedModes solve(const unsigned int n_modes, const MPI_Comm communicator = MPI_COMM_SELF) const
    {
      BodyMesh<3> mesh = make_blade(blade, "bar", communicator);
      ElasticModel<3> held = model;
      held.held = {mesh.boundary_id("root")};
      for (SurfaceTraction<3> &load : held.tractions)
        load.boundary = mesh.boundary_id("tip");
      return PrestressedModes(std::move(mesh), held, blade.element_degree, n_modes);
    }

    BladeParameters blade;
    ElasticModel<3> model;
  };
} // namespace

// Cantilever of hub radius 0, first frequency across its plane of rotation over sqrt(E I / (rho A L^4)) at dimensionless speeds
// (Wright, Smith, Thresher & Wang 1982, exact power series); in the plane of rotation Omega^2 less of its square.
TEST(PrestressMpi, RotatingBeam)
{
  TurningBar bar(0.005, 0.02);
  const std::vector<std::pair<double, double>> exact = {
      {1, 3.6816}, {2, 4.1373}, {4, 5.5850}, {6, 7.3604}, {12, 13.1702}};
  for (const auto &[speed, frequency] : exact)
  {
    double found[2];
    for (const bool in_plane : {false, true})
    {
      bar.model.rotation.speed = speed * bar.unit();
      bar.model.rotation.axis = in_plane ? dealii::Tensor<1, 3>({1, 0, 0}) : dealii::Tensor<1, 3>({0, 1, 0});
      found[in_plane] = bar.solve(1, MPI_COMM_WORLD).modes.omega[0] / bar.unit();
    }
    std::printf(
        "speed %g: flap %.5f, exact %.4f, error %.2g; flap^2 - lead-lag^2 - speed^2: %.2g of flap^2\n", speed,
        found[0], frequency, found[0] / frequency - 1,
        (found[0] * found[0] - found[1] * found[1] - speed * speed) / (found[0] * found[0]));
    EXPECT_NEAR(found[0] / frequency, 1, 5e-4);
    EXPECT_NEAR((found[0] * found[0] - found[1] * found[1]) / (speed * speed), 1, 1e-3);
  }
}

namespace
{
  /// A rigid block on springs of one stiffness in all directions, which turns at 0.4 of its frequency about z.
  struct SpinningBlock
  {
    double natural = 0, mass = 0, speed = 0;
    PrestressedModes body = make();

    PrestressedModes make()
    {
      BlockParameters block;
      block.length = block.width = 0.1;
      block.height = 0.05;
      block.divisions_x = block.divisions_y = 2;
      block.divisions_z = 1;
      block.held.clear();
      BodyMesh<3> mesh = make_block<3>(block, "block", MPI_COMM_WORLD);
      ElasticModel<3> model;
      model.material.young_modulus = 2e13;
      model.material.poisson_ratio = 0.3;
      const double stiffness = 1e8;
      // as stiff above as below: what moves across does not tilt
      for (const char *const face : {"top", "bottom"})
      {
        SpringBed<3> bed;
        bed.boundary = mesh.boundary_id(face);
        for (unsigned int d = 0; d < 3; ++d)
          bed.stiffness_per_area[d] = stiffness;
        model.springs.push_back(bed);
      }
      mass = model.material.density * block.length * block.width * block.height;
      natural = std::sqrt(2 * stiffness * block.length * block.width / mass);
      speed = model.rotation.speed = 0.4 * natural;
      model.rotation.axis = dealii::Tensor<1, 3>({0, 0, 1});
      return PrestressedModes(std::move(mesh), model, 2, 6);
    }
  };
} // namespace

// Axes that turn see a rigid block on springs of one stiffness in all directions whirl at w_0 +- Omega: Coriolis forces and
// softening in closed form.
TEST(PrestressMpi, SpinningBlockOnSprings)
{
  SpinningBlock block;
  const std::vector<double> whirls = block.body.whirls();
  for (const double exact : {block.natural - block.speed, block.natural + block.speed, block.natural})
  {
    double nearest = 1e300;
    for (const double whirl : whirls)
      nearest = std::min(nearest, std::abs(whirl / exact - 1));
    std::printf("%.6g rad/s: error %.2g\n", exact, nearest);
    EXPECT_LT(nearest, 1e-5);
  }
}

// The same block shaken across its axis: x under a force along x, a / (m (a^2 - b^2)), and along y, i b / (m (a^2 - b^2)), with
// a = w_0^2 - Omega^2 - w^2 and b = 2 Omega w; by modes, as in time and by the unreduced matrices.
TEST(PrestressMpi, SpinningBlockShaken)
{
  SpinningBlock block;
  const SecondOrderSystem &system = *block.body.system;
  dealii::Point<3> low(1e9, 1e9, 1e9), high = -1. * low;
  for (const auto &position : system.dof_position)
    for (unsigned int d = 0; d < 3; ++d)
    {
      low[d] = std::min(low[d], position[d]);
      high[d] = std::max(high[d], position[d]);
    }
  for (unsigned int d = 0; d < 3; ++d)
  {
    low[d] = dealii::Utilities::MPI::min(low[d], MPI_COMM_WORLD);
    high[d] = dealii::Utilities::MPI::max(high[d], MPI_COMM_WORLD);
  }
  const dealii::Point<3> centre = low + (high - low) / 2;
  const std::vector<TraceRow> points = {nearest_dof(system, centre, 0, "x"),
                                        nearest_dof(system, centre, 1, "y")};
  const std::vector<double> damping(block.body.modes.omega.size(), 0.);
  const ResponseReduction reduced =
      reduce_response(system, *block.body.flexibility, block.body.modes, damping, false, points);
  std::vector<double> frequency;
  for (const double share : {0.2, 0.5, 0.9, 1.2, 2.})
    frequency.push_back(share * block.natural / (2 * PI));
  const DirectResponse direct = solve_directly(
      system, points, frequency, [] {}, block.speed);
  const unsigned int n = block.body.modes.omega.size();
  const std::vector<Receptance> modal = hysteretic_response(reduced, n, frequency, block.speed),
                                in_time = time_domain_response(reduced, n, frequency, block.speed);
  double worst = 0;
  for (unsigned int k = 0; k < frequency.size(); ++k)
  {
    const double omega = 2 * PI * frequency[k],
                 a = std::pow(block.natural, 2) - std::pow(block.speed, 2) - omega * omega,
                 b = 2 * block.speed * omega, under = block.mass * (a * a - b * b);
    const std::complex<double> along = a / under, across(0, b / under);
    const Receptance exact = {along, across, -across, along};
    for (unsigned int i = 0; i < 4; ++i)
      for (const std::complex<double> &found :
           {std::complex<double>(direct.real(k, i), direct.imaginary(k, i)), modal[k][i], in_time[k][i]})
        worst = std::max(worst, std::abs(found - exact[i]) / std::abs(along));
  }
  std::printf("receptances of a block that turns: error %.2g\n", worst);
  EXPECT_LT(worst, 1e-4);
}

// A half of a free block that is held across its plane of symmetry alone has the symmetric motions of the whole, rigid ones
// included.
TEST(PrestressMpi, HalfOfAFreeBlock)
{
  const auto modes_of = [](const bool half)
  {
    BlockParameters block;
    block.length = half ? 0.1 : 0.2;
    block.width = 0.04;
    block.height = 0.03;
    block.divisions_x = half ? 3 : 6;
    block.divisions_y = block.divisions_z = 1;
    BodyMesh<3> mesh = make_block<3>(block, "block", MPI_COMM_WORLD);
    ElasticModel<3> model;
    if (half)
      model.held.emplace_back(mesh.boundary_id("left"), std::array<bool, 3>{{true, false, false}});
    return PrestressedModes(std::move(mesh), model, 2, 14).modes;
  };
  const Modes half = modes_of(true), whole = modes_of(false);
  EXPECT_EQ(half.n_rigid_modes, 3u);
  EXPECT_EQ(whole.n_rigid_modes, 6u);
  double worst = 0;
  for (unsigned int k = half.n_rigid_modes; k < half.omega.size() && half.omega[k] < whole.omega.back(); ++k)
  {
    double nearest = 1;
    for (const double omega : whole.omega)
      nearest = std::min(nearest, std::abs(omega / half.omega[k] - 1));
    worst = std::max(worst, nearest);
  }
  std::printf("%zu and %zu modes, error %.2g\n", half.omega.size(), whole.omega.size(), worst);
  EXPECT_GT(whole.omega.back(), half.omega[half.n_rigid_modes + 2]);
  EXPECT_LT(worst, 1e-7);
}

// Held too little, it has nothing to answer its loads with.
TEST(Prestress, WantsABodyThatIsHeld)
{
  BlockParameters block;
  block.divisions_x = block.divisions_y = block.divisions_z = 1;
  BodyMesh<3> mesh = make_block<3>(block, "block", MPI_COMM_SELF);
  ElasticModel<3> model;
  model.held.emplace_back(mesh.boundary_id("left"), std::array<bool, 3>{{true, false, false}});
  model.tractions = {{mesh.boundary_id("right"), dealii::Tensor<1, 3>({1e6, 0, 0})}};
  model.prestressed = true;
  EXPECT_THROW(PrestressedModes(std::move(mesh), model, 1, 1), InputError);
}

// A slender shaft of square section about its own axis: pairs at w +- Omega in axes that turn with it.
TEST(Prestress, WhirlingShaft)
{
  TurningBar bar(0.01, 0.01);
  const double still = bar.solve(2).modes.omega[0];
  bar.model.rotation.speed = 0.3 * still;
  bar.model.rotation.axis = dealii::Tensor<1, 3>({0, 0, 1});
  const std::vector<double> whirls = bar.solve(6).whirls();
  EXPECT_NEAR(whirls[0] / still, 0.7, 2e-4);
  EXPECT_NEAR(whirls[1] / still, 1.3, 2e-4);
}

// What rests under its loads is where their linear answer has brought it.
TEST(Prestress, LoadHoldsTheLinearAnswer)
{
  TurningBar bar(0.02, 0.02);
  bar.model.rotation.speed = 2 * bar.unit();
  bar.model.rotation.axis = dealii::Tensor<1, 3>({0, 1, 0});
  const PrestressedModes body = bar.solve(1);
  dealii::PETScWrappers::MPI::Vector u(body.system->load);
  body.flexibility->vmult(u, body.system->load);
  // rho Omega^2 L^3 / (3 E) at the tip
  EXPECT_NEAR(u.linfty_norm() / (8000 * std::pow(bar.model.rotation.speed, 2) / 3 / 2e11), 1, 1e-6);
}

// Euler's load of a cantilever, pi^2 E I / (4 L^2): just below it stands.
TEST(Prestress, BucklesAtEulersLoad)
{
  TurningBar bar(0.01, 0.02);
  const double stress = PI * PI * 2e11 * bar.blade.thickness * bar.blade.thickness / 48;
  bar.model.prestressed = true;
  for (const double share : {0.999, 1.001})
  {
    SurfaceTraction<3> load;
    load.traction[2] = -share * stress;
    bar.model.tractions = {load};
    if (share < 1)
      EXPECT_NO_THROW(bar.solve(0));
    else
      EXPECT_THROW(bar.solve(0), ConvergenceError);
  }
}

// Along the axis it turns about nothing stiffens a shaft: it leaves at its first frequency, 3.5160 sqrt(E I / (rho A L^4)).
TEST(Prestress, FliesApart)
{
  TurningBar bar(0.01, 0.02);
  bar.model.rotation.axis = dealii::Tensor<1, 3>({0, 0, 1});
  bar.model.rotation.speed = 3.51 * bar.unit();
  EXPECT_NO_THROW(bar.solve(0));
  bar.model.rotation.speed = 3.52 * bar.unit();
  EXPECT_THROW(bar.solve(0), ConvergenceError);
}

// A free ring under pressure inside, a cut of a long tube: as a rigid body it still turns for nothing, and n >= 2 are those of
// a thin ring, m w^2 = [B (n^2 - 1)^2 + t (n^2 - 1)] n^2 / (n^2 + 1) (RingParameters without foundation, not stretched).
TEST(Prestress, RingUnderPressure)
{
  const double R = 1, h = 0.01, E = 1e8, rho = 2000, p = 50;
  BodyMesh<2> mesh;
  mesh.name = "ring";
  mesh.triangulation = std::make_unique<dealii::parallel::distributed::Triangulation<2>>(
      MPI_COMM_SELF, dealii::Triangulation<2>::limit_level_difference_at_vertices);
  mesh.geometry_degree = 4;
  dealii::GridGenerator::hyper_shell(*mesh.triangulation, dealii::Point<2>(), R - h / 2, R + h / 2, 24, true);
  ElasticModel<2> model;
  model.material.young_modulus = E;
  model.material.poisson_ratio = 0;
  model.material.density = rho;
  model.pressures = {{0, p}};
  model.prestressed = true;
  const ElasticBody<2> body(std::move(mesh), model, 4);
  const auto system = assemble_body(body);
  const auto soft = assemble_body(body);
  dealii::PETScWrappers::MPI::Vector u(system->load), force(u);
  Flexibility(*system).vmult(u, system->load);
  add_prestress(body, u, *system);
  for (unsigned int k = 0; k < 3; ++k)
  {
    system->stiffness.vmult(force, system->rigid_motions[k]);
    EXPECT_LT(force.l2_norm(), 1e-6 * system->load.l2_norm()) << k;
  }
  ModeParameters asked;
  asked.count = 8;
  Flexibility with(*system), without(*soft);
  const Modes stiff = compute_modes(*system, with, asked), at_rest = compute_modes(*soft, without, asked);
  for (unsigned int n = 2; n < 6; ++n)
  {
    const unsigned int k = 3 + 2 * (n - 2);
    const double B = E * h * h * h / (12 * R * R * R * R), t = p / R, m = rho * h,
                 share = double(n * n) / (n * n + 1) * (n * n - 1), bending = share * B * (n * n - 1) / m,
                 tension = share * t / m, own = std::pow(at_rest.omega[k], 2),
                 added = std::pow(stiff.omega[k], 2) - own;
    std::printf("n = %u: w^2 at rest %.5g of the thin ring's, by pressure %.6f\n", n, own / bending,
                added / tension);
    EXPECT_NEAR(own / bending, 1, 5e-4);
    EXPECT_NEAR(added / tension, 1, 2e-4);
  }
}

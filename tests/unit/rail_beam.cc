// The finite-element rail as a beam: waves of a free and a supported span, static stiffness on its pads
// against a Timoshenko beam on the same pads.

#include <vibrocontact/base/dense.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/modes.h>
#include <vibrocontact/scene/rail.h>

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  ElasticMaterial rail_steel()
  {
    ElasticMaterial material;
    material.young_modulus = 205e9;
    material.poisson_ratio = 0.3;
    return material;
  }

  /// Lowest frequencies of one span of 0.6 m whose ends do not move laterally or vertically but freely along
  /// x, and which is symmetric to its middle: waves cos(pi x / 0.6), exactly those of an endless rail.
  std::vector<double> span_frequencies(const bool on_pads)
  {
    RailParameters parameters;
    parameters.length = parameters.sleeper_spacing;
    parameters.pad_stiffness_x = parameters.pad_stiffness_y = parameters.pad_stiffness_z = 0;
    parameters.contact_division = parameters.coarse_division = 0.05;
    BodyMesh<3> mesh = make_rail(parameters, nullptr, "rail", MPI_COMM_WORLD);
    ElasticModel<3> model;
    model.material = rail_steel();
    if (on_pads)
    {
      // Half a pad at either end: a pad of full length stands over each support.
      const RailParameters supported;
      SpringBed<3> bed;
      bed.boundary = mesh.boundary_id("foot");
      const double area = 2 * 0.074675 * supported.pad_length, half = supported.pad_length / 2;
      bed.stiffness_per_area =
          Tensor<1, 3>({supported.pad_stiffness_x / area, supported.pad_stiffness_y / area,
                        supported.pad_stiffness_z / area});
      bed.segments = {{-0.3, -0.3 + half}, {0.3 - half, 0.3}};
      model.springs.push_back(bed);
    }
    const ElasticBody<3> body(std::move(mesh), model, 2);
    const auto system = assemble_body(body);
    std::vector<PetscInt> fixed;
    for (unsigned int i = 0; i < system->dof_position.size(); ++i)
    {
      const double x = system->dof_position[i][0];
      const bool along = system->dof_direction[i] == 0;
      if ((!along && std::abs(std::abs(x) - 0.3) < 1e-6) || (along && std::abs(x) < 1e-6))
        fixed.push_back(system->locally_owned.nth_index_in_set(i));
    }
    MatZeroRowsColumns(system->stiffness, fixed.size(), fixed.data(), 1e9, nullptr, nullptr);
    MatZeroRowsColumns(system->mass, fixed.size(), fixed.data(), 0., nullptr, nullptr);
    system->n_rigid_modes = 0;
    system->rigid_motions.clear();
    Flexibility flexibility(*system);
    ModeParameters modes;
    modes.count = 6;
    std::vector<double> result;
    for (const double omega : compute_modes(*system, flexibility, modes).omega)
      result.push_back(omega / (2 * numbers::PI));
    return result;
  }

  double nearest(const std::vector<double> &values, const double target)
  {
    return *std::min_element(values.begin(), values.end(),
                             [&](double a, double b) { return std::abs(a - target) < std::abs(b - target); });
  }

  /// Stiffness under a unit force at x = 0 of a Timoshenko beam on the rail's spread pads [N/m].
  double timoshenko_stiffness(const RailParameters &parameters)
  {
    const double EI = 205e9 * 3038.8e-8, GA = 0.4 * 205e9 / 2.6 * 76.71e-4;
    const unsigned int n = 2 * std::lround(parameters.length / 2 / 0.0125);
    const double L = parameters.length / n, phi = 12 * EI / (GA * L * L), c = EI / (L * L * L * (1 + phi));
    DenseMatrix K(2 * n + 2);
    K = 0;
    const double e[4][4] = {{12, 6 * L, -12, 6 * L},
                            {6 * L, (4 + phi) * L * L, -6 * L, (2 - phi) * L * L},
                            {-12, -6 * L, 12, -6 * L},
                            {6 * L, (2 - phi) * L * L, -6 * L, (4 + phi) * L * L}};
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          K(2 * k + i, 2 * k + j) += c * e[i][j];
    // A node carries the part of the pads that lies within half an element of it.
    for (unsigned int k = 0; k <= n; ++k)
      for (const double support : parameters.supports())
      {
        const double x = -parameters.length / 2 + k * L;
        const double low = std::max(x - L / 2, support - parameters.pad_length / 2);
        const double high = std::min(x + L / 2, support + parameters.pad_length / 2);
        if (high > low)
          K(2 * k, 2 * k) += parameters.pad_stiffness_z / parameters.pad_length * (high - low);
      }
    Vector<double> u(2 * n + 2);
    u(n) = 1;
    K.compute_lu_factorization();
    K.solve(u);
    return 1 / u(n);
  }

  /// Stiffness of the finite-element rail: force on 8 x 8 mm of the crown over the displacement of the
  /// centroid, and of the crown less the indentation of a half-space by the same square [N/m].
  std::pair<double, double> rail_stiffness(const RailParameters &parameters)
  {
    BodyMesh<3> mesh = make_rail(parameters, nullptr, "rail", MPI_COMM_WORLD);
    ElasticModel<3> model;
    model.material = rail_steel();
    add_supports(model, parameters, mesh);
    const ElasticBody<3> body(std::move(mesh), model, 2);
    ContactGrid grid;
    grid.n_x = grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = 0.008;
    const auto system = assemble_body(body, &grid);
    Flexibility flexibility(*system);
    PETScWrappers::MPI::Vector force(body.locally_owned, MPI_COMM_WORLD), u(force);
    for (const auto &[dof, weight] : system->trace.rows[contact_row(1, 0, 0)])
      force(dof) = -weight;
    force.compress(VectorOperation::insert);
    flexibility.vmult(u, force);
    const double crown = -(force * u);

    // The two nodes of the web's middle line at x = 0 next to the centroid, 80.91 mm above the foot.
    const double centroid = 0.08091 - 0.172;
    std::map<double, double> line;
    for (unsigned int i = 0; i < system->dof_position.size(); ++i)
      if (system->dof_direction[i] == 2 &&
          std::hypot(system->dof_position[i][0], system->dof_position[i][1]) < 1e-6)
        line[system->dof_position[i][2]] = u(system->locally_owned.nth_index_in_set(i));
    const auto above = line.upper_bound(centroid), below = std::prev(above);
    const double t = (centroid - below->first) / (above->first - below->first);
    const double displacement = (1 - t) * below->second + t * above->second;
    const double indentation = 0.9464 * (1 - 0.3 * 0.3) / (205e9 * 0.008);
    return {-1 / displacement, 1 / (-crown - indentation)};
  }
} // namespace

TEST(RailBeam, waves_of_a_free_span)
{
  const auto f = span_frequencies(false);
  std::cout << "lateral " << nearest(f, 499) << " torsion " << nearest(f, 828) << " vertical "
            << nearest(f, 1053) << " Hz" << std::endl;
  EXPECT_NEAR(nearest(f, 499) / 499, 1, 5e-3);
  EXPECT_NEAR(nearest(f, 828) / 828, 1, 5e-3);
  EXPECT_NEAR(nearest(f, 1053) / 1053, 1, 5e-3);
}

TEST(RailBeam, pinned_pinned_frequency)
{
  const double f = nearest(span_frequencies(true), 1058);
  std::cout << "pinned-pinned " << f << " Hz" << std::endl;
  EXPECT_NEAR(f / 1058, 1, 1e-2);
}

TEST(RailBeam, static_stiffness_against_a_timoshenko_beam_on_the_same_pads)
{
  RailParameters parameters;
  parameters.length = 4.8;
  parameters.coarse_division = 0.2;
  for (const std::string place : {"mid-span", "support"})
  {
    parameters.contact_at = place;
    const double beam = timoshenko_stiffness(parameters);
    const auto [centroid, crown] = rail_stiffness(parameters);
    std::cout << place << ": beam " << 1e-6 * beam << " MN/m, rail's centroid " << 1e-6 * centroid << " ("
              << 100 * (centroid / beam - 1) << " %), crown less indentation " << 1e-6 * crown << " MN/m"
              << std::endl;
    EXPECT_NEAR(beam / (place == "support" ? 304e6 : 260e6), 1, 0.02);
    if (place == "mid-span")
    {
      EXPECT_NEAR(centroid / beam, 1, 0.03);
    }
  }
}

TEST(RailBeam, anechoic_ends_damp_what_lives_in_them)
{
  // The paper's five pieces at either end of a rail on pads too soft to matter, cells ending where
  // pieces end. Loss factors rise from 0.1 to 1 in geometric steps; the rest of the rail has 0.02.
  RailParameters parameters;
  parameters.length = 13.2;
  parameters.section.element_degree = 1;
  parameters.contact_division = parameters.coarse_division = 0.3;
  parameters.pad_stiffness_x = parameters.pad_stiffness_y = parameters.pad_stiffness_z = 1e3;
  parameters.anechoic_lengths = {0.6, 0.6, 0.6, 1.2, 3.0};
  parameters.check("rail/Rail");
  BodyMesh<3> mesh = make_rail(parameters, nullptr, "rail", MPI_COMM_WORLD);
  ElasticModel<3> model;
  model.material = rail_steel();
  model.material.loss_factor = 0.02;
  add_supports(model, parameters, mesh);
  const ElasticBody<3> body(std::move(mesh), model, 1);
  const auto system = assemble_body(body);
  const auto shape_of = [&](const std::function<double(double)> &displacement)
  {
    PETScWrappers::MPI::Vector u(system->locally_owned, system->communicator);
    for (unsigned int i = 0; i < system->dof_position.size(); ++i)
      if (system->dof_direction[i] == 0)
        u(system->locally_owned.nth_index_in_set(i)) = displacement(system->dof_position[i][0]);
    u.compress(VectorOperation::insert);
    return u;
  };

  // A motion confined to one piece has half the piece's loss factor as its damping ratio.
  double from = 0.6;
  for (unsigned int k = 0; k < 5; ++k)
  {
    const double to = from + parameters.anechoic_lengths[k];
    Modes one;
    one.shapes = {shape_of([&](const double x) { return std::max(0., (x - from) * (to - x)); })};
    PETScWrappers::MPI::Vector force(one.shapes[0]);
    system->stiffness.vmult(force, one.shapes[0]);
    one.omega = {std::sqrt(force * one.shapes[0])};
    EXPECT_NEAR(strain_energy_damping(*system, one)[0], 0.05 * std::pow(10., k / 4.), 1e-6) << k;
    from = to;
  }

  // The first longitudinal wave, strain cos(pi x / L): closed form over the pieces.
  const double L = parameters.length, pi = numbers::PI;
  const auto energy = [&](const double x) { return x / 2 + L / (4 * pi) * std::sin(2 * pi * x / L); };
  double expected = 0.02 * energy(0.6);
  from = 0.6;
  for (unsigned int k = 0; k < 5; ++k)
  {
    const double to = from + parameters.anechoic_lengths[k];
    expected += 0.1 * std::pow(10., k / 4.) * (energy(to) - energy(from));
    from = to;
  }
  expected /= 2 * energy(L / 2);
  Flexibility flexibility(*system);
  ModeParameters wanted;
  wanted.upper_frequency = 210;
  const Modes modes = compute_modes(*system, flexibility, wanted);
  const auto zeta = strain_energy_damping(*system, modes);
  const PETScWrappers::MPI::Vector wave = shape_of([&](const double x) { return std::sin(pi * x / L); });
  unsigned int longitudinal = modes.n_rigid_modes;
  for (unsigned int i = modes.n_rigid_modes; i < modes.shapes.size(); ++i)
    if (std::abs(wave * modes.shapes[i]) > std::abs(wave * modes.shapes[longitudinal]))
      longitudinal = i;
  std::cout << "longitudinal wave at " << modes.omega[longitudinal] / (2 * pi) << " Hz, damping ratio "
            << zeta[longitudinal] << " (" << expected << ")" << std::endl;
  EXPECT_NEAR(modes.omega[longitudinal] / (2 * pi), std::sqrt(205e9 / 7800) / (2 * L), 2);
  EXPECT_NEAR(zeta[longitudinal] / expected, 1, 0.02);
}

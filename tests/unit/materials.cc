// Bodies of several materials: groups of cells in a file, stiffness, mass and loss by group, against closed forms
// of a bar in series and of a ring of two layers; what is refused.

#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/make_elastic_body.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/reduction/harmonic_solver.h>
#include <vibrocontact/reduction/modes.h>
#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/file_cells.h>
#include <vibrocontact/scene/gmsh_file.h>
#include <vibrocontact/scene/mesh_file.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/scene/wheel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  std::string materials_folder()
  {
    return scratch_folder();
  }

  ElasticMaterial make_material(const double E, const double density, const double loss)
  {
    ElasticMaterial material;
    material.young_modulus = E;
    material.poisson_ratio = 0;
    material.density = density;
    material.loss_factor = loss;
    return material;
  }

  const ElasticMaterial bar_steel = make_material(210e9, 7800, 1e-3),
                        bar_rubber = make_material(3e9, 1200, 0.05);
  constexpr double L1 = 0.4, L2 = 0.6, bar_width = 0.06;

  /// Bar along x from 0 to 1 m in a file: groups "steel" up to 0.4 m, "rubber" beyond, held on the left.
  MeshFileParameters bar_file(const std::string &name, const std::vector<std::string> &groups)
  {
    BlockParameters block;
    block.length = L1 + L2;
    block.width = block.height = bar_width;
    block.divisions_x = 10;
    block.divisions_y = block.divisions_z = 1;
    block.offset_x = 0.5;
    BodyMesh<3> mesh = make_block<3>(block, "bar", MPI_COMM_SELF);
    for (const auto &cell : mesh.triangulation->cell_iterators_on_level(0))
      cell->set_material_id(cell->center()[0] < L1 ? 0 : groups.size() - 1);
    mesh.cell_groups = groups;
    MeshFileParameters parameters;
    parameters.file = materials_folder() + "/" + name;
    write_gmsh(mesh, parameters.file);
    parameters.held_groups = {"left"};
    parameters.contact_group = "top";
    parameters.element_degree = 4;
    return parameters;
  }

  BodyParameters two_material_bar()
  {
    BodyParameters body = body_of("bar", "mesh", bar_file("bar.msh", {"steel", "rubber"}));
    body.materials = {{"steel", bar_steel}, {"rubber", bar_rubber}};
    body.loads.traction_boundary = "right";
    body.loads.traction = {1e6, 0, 0};
    return body;
  }

  std::string complaint_of(const std::function<void()> &what)
  {
    try
    {
      what();
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  /// Zeros of a function between 0 and @p most, by sign changes and bisection.
  std::vector<double> zeros(const std::function<double(double)> &f, const double most)
  {
    std::vector<double> result;
    const unsigned int n = 20000;
    for (unsigned int k = 1; k < n; ++k)
    {
      double a = most * k / n, b = most * (k + 1) / n;
      if (f(a) * f(b) > 0)
        continue;
      for (unsigned int i = 0; i < 80; ++i)
        (f(a) * f((a + b) / 2) > 0 ? a : b) = (a + b) / 2;
      result.push_back(a);
    }
    return result;
  }

  struct Found
  {
    double omega, zeta;
  };

  /// Modes of which at least @p share of the sum of squares is motion in the direction wanted at each dof.
  std::vector<Found> modes_along(const SecondOrderSystem &system, const unsigned int count,
                                 const double share,
                                 const std::function<double(const Point<3> &, unsigned int)> &direction)
  {
    Flexibility flexibility(system);
    ModeParameters parameters;
    parameters.count = count;
    const Modes modes = compute_modes(system, flexibility, parameters);
    const std::vector<double> zeta = strain_energy_damping(system, modes);
    std::vector<Found> result;
    for (unsigned int m = 0; m < modes.omega.size(); ++m)
    {
      // per node the motion along the direction
      std::map<std::array<long, 3>, double> along;
      double all = 0, own = 0;
      for (unsigned int k = 0; k < system.dof_position.size(); ++k)
      {
        const Point<3> &p = system.dof_position[k];
        const double u = modes.shapes[m](system.locally_owned.nth_index_in_set(k));
        all += u * u;
        along[{{std::lround(1e9 * p[0]), std::lround(1e9 * p[1]), std::lround(1e9 * p[2])}}] +=
            u * direction(p, system.dof_direction[k]);
      }
      for (const auto &node : along)
        own += node.second * node.second;
      if (own > share * all)
        result.push_back({modes.omega[m], zeta[m]});
    }
    return result;
  }

  /// The row that sees the mean displacement under the traction of the model.
  TraceRow load_row(const SecondOrderSystem &system)
  {
    TraceRow row;
    double sum = 0;
    for (const auto dof : system.locally_owned)
      if (const double f = system.load(dof); f != 0)
      {
        row.emplace_back(dof, f);
        sum += f;
      }
    for (auto &entry : row)
      entry.second /= sum;
    return row;
  }
} // namespace

TEST(Materials, bar_in_series_against_closed_form)
{
  const auto body = make_elastic_body(two_material_bar(), 0, {}, MPI_COMM_SELF);
  const auto system = assemble_body(*body);
  const double A = bar_width * bar_width;
  EXPECT_NEAR(system->total_mass / (A * (L1 * bar_steel.density + L2 * bar_rubber.density)), 1, 1e-12);

  // static: compliances in series
  Flexibility flexibility(*system);
  PETScWrappers::MPI::Vector u(system->load);
  flexibility.vmult(u, system->load);
  const double force = 1e6 * A;
  EXPECT_NEAR((u * system->load) / (force * force) /
                  (L1 / (bar_steel.young_modulus * A) + L2 / (bar_rubber.young_modulus * A)),
              1, 1e-9);

  // E1 k1 cos k1 L1 cos k2 L2 = E2 k2 sin k1 L1 sin k2 L2
  const auto k = [](const ElasticMaterial &m, const double omega)
  { return omega * std::sqrt(m.density / m.young_modulus); };
  const auto exact = zeros(
      [&](const double omega)
      {
        const double k1 = k(bar_steel, omega), k2 = k(bar_rubber, omega);
        return bar_steel.young_modulus * k1 * std::cos(k1 * L1) * std::cos(k2 * L2) -
               bar_rubber.young_modulus * k2 * std::sin(k1 * L1) * std::sin(k2 * L2);
      },
      2 * numbers::PI * 3000);
  const auto found = modes_along(*system, 30, 0.999,
                                 [](const Point<3> &, const unsigned int d) { return d == 0 ? 1. : 0.; });
  ASSERT_GE(exact.size(), 2u);
  ASSERT_GE(found.size(), 2u);
  for (unsigned int m = 0; m < 2; ++m)
  {
    EXPECT_NEAR(found[m].omega / exact[m], 1, 1e-5) << m;
    // strain energies of u1 = sin k1 x, u2 = B cos k2 (L - x)
    const double k1 = k(bar_steel, exact[m]), k2 = k(bar_rubber, exact[m]);
    const double B = std::sin(k1 * L1) / std::cos(k2 * L2);
    const double U1 = bar_steel.young_modulus * k1 * k1 * (L1 / 2 + std::sin(2 * k1 * L1) / (4 * k1)),
                 U2 =
                     bar_rubber.young_modulus * B * B * k2 * k2 * (L2 / 2 - std::sin(2 * k2 * L2) / (4 * k2));
    EXPECT_NEAR(found[m].zeta / ((bar_steel.loss_factor * U1 + bar_rubber.loss_factor * U2) / (U1 + U2) / 2),
                1, 1e-5)
        << m;
  }

  // hysteresis: the tip's receptance by transfer matrices of complex moduli
  HarmonicSolver solver(*system);
  for (const double frequency : {100., 600., 1400.})
  {
    using Complex = std::complex<double>;
    const double omega = 2 * numbers::PI * frequency;
    Complex motion = 0, tension = 1;
    for (const auto &[material, length] : {std::make_pair(bar_steel, L1), std::make_pair(bar_rubber, L2)})
    {
      const Complex E = material.young_modulus * Complex(1, material.loss_factor),
                    kappa = omega * std::sqrt(material.density / E), stiffness = E * A * kappa;
      const Complex next = std::cos(kappa * length) * motion + std::sin(kappa * length) / stiffness * tension;
      tension = -stiffness * std::sin(kappa * length) * motion + std::cos(kappa * length) * tension;
      motion = next;
    }
    const Complex receptance = solver.receptance(omega, {load_row(*system)})[0];
    EXPECT_LT(std::abs(receptance / (motion / tension) - 1.), 1e-5) << frequency;
  }
}

namespace
{
  constexpr double r_i = 0.10, r_m = 0.13, r_o = 0.18, b_half = 0.02;

  /// Half section of a ring of two layers, "core" inside and "rim" outside, with its outline.
  WheelParameters layered_ring()
  {
    const std::string mesh = materials_folder() + "/ring.msh", outline = materials_folder() + "/ring.txt";
    std::ofstream file(mesh);
    file.precision(17);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 7 \"core\"\n2 9 "
            "\"rim\"\n$EndPhysicalNames\n"
         << "$Nodes\n10\n";
    const double radii[] = {r_i, (r_i + r_m) / 2, r_m, (r_m + r_o) / 2, r_o};
    for (unsigned int k = 0; k < 10; ++k)
      file << k + 1 << " " << (k % 2 ? b_half : -b_half) << " " << radii[k / 2] << " 0\n";
    file << "$EndNodes\n$Elements\n4\n";
    for (unsigned int k = 0; k < 4; ++k)
      file << k + 1 << " 3 2 " << (k < 2 ? 7 : 9) << " 1 " << 2 * k + 1 << " " << 2 * k + 2 << " "
           << 2 * k + 4 << " " << 2 * k + 3 << "\n";
    file << "$EndElements\n";
    const double mm = 1e3;
    std::ofstream rows(outline);
    for (const auto &[b, part] : {std::make_pair(r_i, "bore"), std::make_pair(r_o, "tread")})
      rows << "line " << -mm * b_half << " " << mm * b << " " << mm * b_half << " " << mm * b << " 0 0 0 "
           << part << "\n";
    for (const double a : {-b_half, b_half})
      rows << "line " << mm * a << " " << mm * r_i << " " << mm * a << " " << mm * r_o << " 0 0 0 surface\n";
    WheelParameters wheel;
    wheel.section.mesh = mesh;
    wheel.section.outline = outline;
    wheel.section.element_degree = 4;
    wheel.contact_division = wheel.coarse_division = 0.095; // 12 cells around
    wheel.fine_length = 0;
    return wheel;
  }

  /// Frequencies of u(r) = a J1(kr) + b Y1(kr) in each layer, u = 0 at the bore, stress zero outside:
  /// E u' for the breathing of a ring without Poisson effect, mu (u' - u / r) for its torsion.
  std::vector<double> layered_frequencies(const ElasticMaterial &core, const ElasticMaterial &rim,
                                          const bool torsion)
  {
    const auto f = [&](const double omega)
    {
      const auto wave = [&](const ElasticMaterial &m)
      { return omega * std::sqrt(m.density / (torsion ? m.mu() : m.young_modulus)); };
      // (u, stress) of the Bessel function of first or second kind
      const auto state = [&](const ElasticMaterial &m, const unsigned int kind, const double r)
      {
        const double k = wave(m), x = k * r;
        const auto bessel = [&](const double n)
        { return kind == 0 ? std::cyl_bessel_j(n, x) : std::cyl_neumann(n, x); };
        const double u = bessel(1), du = k * (bessel(0) - bessel(1) / x);
        return std::make_pair(u, torsion ? m.mu() * (du - u / r) : m.young_modulus * du);
      };
      const auto [j_i, j_i_stress] = state(core, 0, r_i);
      const auto [y_i, y_i_stress] = state(core, 1, r_i);
      const auto [j_m, j_m_stress] = state(core, 0, r_m);
      const auto [y_m, y_m_stress] = state(core, 1, r_m);
      const double u = j_m * y_i - y_m * j_i, stress = j_m_stress * y_i - y_m_stress * j_i;
      const auto [J, J_stress] = state(rim, 0, r_m);
      const auto [Y, Y_stress] = state(rim, 1, r_m);
      const double det = J * Y_stress - Y * J_stress;
      const double a = (u * Y_stress - Y * stress) / det, b = (J * stress - u * J_stress) / det;
      return a * state(rim, 0, r_o).second + b * state(rim, 1, r_o).second;
    };
    return zeros(f, 2 * numbers::PI * 12000);
  }
} // namespace

TEST(Materials, ring_of_two_layers_against_closed_form)
{
  const ElasticMaterial core = make_material(40e9, 2000, 0.02), rim = make_material(210e9, 7800, 1e-3);
  BodyParameters parameters = body_of("ring", "wheel", layered_ring());
  parameters.materials = {{"rim", rim}, {"core", core}}; // in any order
  const auto body = make_elastic_body(parameters, 0, {}, MPI_COMM_SELF);
  const auto system = assemble_body(*body);
  const double area = numbers::PI * 2 * b_half;
  EXPECT_NEAR(system->total_mass /
                  (area * (core.density * (r_m * r_m - r_i * r_i) + rim.density * (r_o * r_o - r_m * r_m))),
              1, 1e-7);
  const auto motion = [](const bool torsion)
  {
    return [torsion](const Point<3> &p, const unsigned int d)
    {
      const double x = p[0], z = p[2] - r_o, r = std::hypot(x, z);
      const double radial[3] = {x / r, 0, z / r}, around[3] = {-z / r, 0, x / r};
      return torsion ? around[d] : radial[d];
    };
  };
  for (const bool torsion : {true, false})
  {
    const auto exact = layered_frequencies(core, rim, torsion);
    const auto found = modes_along(*system, 24, 0.9999, motion(torsion));
    ASSERT_GE(exact.size(), 1u);
    ASSERT_GE(found.size(), 1u);
    EXPECT_NEAR(found[0].omega / exact[0], 1, 1e-5) << (torsion ? "torsion" : "breathing");
    EXPECT_GT(found[0].zeta, rim.loss_factor / 2);
    EXPECT_LT(found[0].zeta, core.loss_factor / 2);
  }
}

TEST(Materials, anechoic_pieces_and_groups_are_kept_apart)
{
  const std::string mesh = materials_folder() + "/rail.msh", outline = materials_folder() + "/rail.txt";
  std::ofstream(mesh)
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"foot\"\n2 2 \"head\"\n"
         "$EndPhysicalNames\n$Nodes\n6\n1 -0.03 0 0\n2 0.03 0 0\n3 -0.03 0.05 0\n4 0.03 0.05 0\n"
         "5 -0.03 0.1 0\n6 0.03 0.1 0\n$EndNodes\n$Elements\n2\n1 3 2 1 1 1 2 4 3\n"
         "2 3 2 2 1 3 4 6 5\n$EndElements\n";
  std::ofstream(outline) << "line 0 0 30 0 0 0 0 foot\nline 30 0 30 100 0 0 0 surface\n"
                            "line 30 100 0 100 0 0 0 crown\n";
  RailParameters rail;
  rail.section.mesh = mesh;
  rail.section.outline = outline;
  rail.length = 6;
  rail.anechoic_lengths = {0.6, 1.2};
  rail.anechoic_loss_first = 0.1;
  rail.anechoic_loss_last = 1;
  BodyParameters parameters = body_of("rail", "rail", rail);
  parameters.materials = {{"foot", bar_rubber}, {"head", bar_steel}};
  const auto body = make_elastic_body(parameters, 0, {}, MPI_COMM_SELF);
  const auto &triangulation = *body->mesh.triangulation;
  double low = 1e9, high = -1e9;
  for (const auto &p : triangulation.get_vertices())
  {
    low = std::min(low, p[2]);
    high = std::max(high, p[2]);
  }
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    const bool head = cell->center()[2] > (low + high) / 2;
    const double x = std::abs(cell->center()[0]);
    const ElasticMaterial &material = body->model.material_of(cell->material_id());
    EXPECT_EQ(material.young_modulus, head ? bar_steel.young_modulus : bar_rubber.young_modulus)
        << cell->center();
    EXPECT_EQ(material.loss_factor, x > 1.8   ? 1.
                                    : x > 1.2 ? 0.1
                                    : head    ? bar_steel.loss_factor
                                              : bar_rubber.loss_factor)
        << cell->center();
  }
}

TEST(Materials, groups_and_materials_have_to_match)
{
  const auto make = [](const MeshFileParameters &file, const std::vector<std::string> &materials)
  { return complaint_of([&] { make_mesh_from_file(file, 0, nullptr, "bar", MPI_COMM_SELF, materials); }); };
  const MeshFileParameters two = bar_file("two.msh", {"steel", "rubber"}),
                           one = bar_file("one.msh", {"body"});
  EXPECT_EQ(make(one, {}), "");
  EXPECT_EQ(make(one, {"body"}), "");
  EXPECT_EQ(make(two, {"rubber", "steel"}), "");
  EXPECT_NE(make(two, {}).find("write bar/Materials = rubber, steel"), std::string::npos) << make(two, {});
  EXPECT_NE(make(two, {"steel"}).find("6 cells without a material (6 in \"rubber\")"), std::string::npos)
      << make(two, {"steel"});
  EXPECT_NE(make(two, {"steel", "rubber", "lead"}).find("lists \"lead\", but the mesh file"),
            std::string::npos);
  EXPECT_NE(make(one, {"steel"}).find("its groups: body (10 cells)"), std::string::npos)
      << make(one, {"steel"});
}

TEST(Materials, file_written_with_groups_has_them_again)
{
  const FileCells file = FileCells::read(bar_file("again.msh", {"steel", "rubber"}).file);
  EXPECT_EQ(file.groups.counts().at("steel"), 4u);
  EXPECT_EQ(file.groups.counts().at("rubber"), 6u);
}

// Bodies from gmsh files: a foreign block, the built-in wheel written and read back, and files that are
// refused.

#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/modes.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/file_cells.h>
#include <vibrocontact/scene/gmsh_file.h>
#include <vibrocontact/scene/loads.h>
#include <vibrocontact/scene/mesh_file.h>
#include <vibrocontact/scene/wheel.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  MeshFileParameters foreign_block()
  {
    MeshFileParameters parameters;
    parameters.file = mesh_directory() + "/foreign_block.msh";
    parameters.unit = 1e-3;
    parameters.contact_point = {30, 20, 20};
    parameters.contact_group = "Lauffläche";
    parameters.held_groups = {"Einspannung"};
    return parameters;
  }

  ContactGrid small_grid()
  {
    ContactGrid grid;
    grid.n_x = grid.n_y = 5;
    grid.spacing_x = grid.spacing_y = 0.001;
    grid.x_first = grid.y_first = -0.002;
    return grid;
  }

  std::string content(const std::string &file)
  {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  std::string folder()
  {
    return scratch_folder();
  }

  /// What is said about the foreign block after a change of its text.
  std::string complaint(const std::string &from, const std::string &to)
  {
    std::string text = content(foreign_block().file);
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    MeshFileParameters parameters = foreign_block();
    parameters.file = folder() + "/changed.msh";
    std::ofstream(parameters.file) << text;
    try
    {
      const ContactGrid grid = small_grid();
      make_mesh_from_file(parameters, 0, &grid, "rail", MPI_COMM_WORLD);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  std::vector<double> frequencies(BodyMesh<3> mesh, const std::string &held, const unsigned int degree)
  {
    ElasticModel<3> model;
    model.held = {mesh.boundary_id(held)};
    const ElasticBody<3> body(std::move(mesh), model, degree);
    const auto system = assemble_body(body);
    Flexibility flexibility(*system);
    ModeParameters parameters;
    parameters.count = 8;
    std::vector<double> result;
    for (const double omega : compute_modes(*system, flexibility, parameters).omega)
      result.push_back(omega / (2 * numbers::PI));
    return result;
  }
} // namespace

TEST(MeshFile, foreign_block_with_its_own_groups)
{
  const ContactGrid grid = small_grid();
  BodyMesh<3> mesh = make_mesh_from_file(foreign_block(), 0, &grid, "rail", MPI_COMM_WORLD);
  ElasticModel<3> model;
  model.held = {mesh.boundary_id("Einspannung")};
  LoadParameters loads;
  loads.traction_boundary = "Lauffläche";
  loads.traction = {0, 0, -1e6};
  add_loads(model, loads, mesh);
  const ElasticBody<3> body(std::move(mesh), model, 2);
  const auto system = assemble_body(body, &grid);
  EXPECT_NEAR(system->total_mass / (7800 * 0.06 * 0.04 * 0.02), 1, 1e-12);
  EXPECT_NEAR(system->trace.surface_height[0], 0, 1e-15);
  PETScWrappers::MPI::Vector ones = rigid_motions(body)[2];
  ones /= ones.linfty_norm();
  EXPECT_NEAR(ones * system->load, -1e6 * 0.06 * 0.04, 1e-6);

  // The static response goes to a VTU file with its PVD.
  Flexibility flexibility(*system);
  PETScWrappers::MPI::Vector u(system->load);
  flexibility.vmult(u, system->load);
  write_fields(body, {{&u, 0.}}, folder(), "rail");
  write_surface_fields(body, {{&u, 1.}, {&u, 2.}}, folder(), "rail_shapes");
  EXPECT_NE(content(folder() + "/fields/rail_0000.vtu").find("von_mises_Pa"), std::string::npos);
  EXPECT_NE(content(folder() + "/rail_shapes.pvd").find("fields/rail_shapes_0001.vtu"), std::string::npos);
}

TEST(MeshFile, wheel_written_and_read_back_has_the_same_frequencies)
{
  WheelParameters wheel;
  wheel.contact_division = wheel.coarse_division = 0.24;
  wheel.section.element_degree = 1;
  const BodyMesh<3> original = make_wheel(wheel, 0., nullptr, "wheel", MPI_COMM_WORLD);
  MeshFileParameters parameters;
  parameters.file = folder() + "/wheel.msh";
  parameters.geometry = "wheel";
  parameters.element_degree = 1;
  parameters.held_groups = {"bore"};
  write_gmsh(original, parameters.file);
  const auto counts = FileCells::read(parameters.file).face_counts();
  EXPECT_EQ(counts.size(), 3u);
  EXPECT_GT(counts.at("contact"), 0u);
  BodyMesh<3> copy = make_mesh_from_file(parameters, 0., nullptr, "wheel", MPI_COMM_WORLD);
  EXPECT_EQ(copy.triangulation->n_active_cells(), original.triangulation->n_active_cells());
  const auto f = frequencies(make_wheel(wheel, 0., nullptr, "wheel", MPI_COMM_WORLD), "bore", 1);
  const auto g = frequencies(std::move(copy), "bore", 1);
  ASSERT_EQ(f.size(), g.size());
  for (unsigned int k = 0; k < f.size(); ++k)
    EXPECT_NEAR(g[k] / f[k], 1, 1e-9);
}

TEST(MeshFile, foundation_under_a_named_group)
{
  // The block on springs instead of held: a vertical translation stretches nothing but them, and a much
  // stiffer block moves on them as a rigid body: z = -mg / (k area), loss factor of its lowest mode 0.3.
  MeshFileParameters parameters = foreign_block();
  parameters.held_groups.clear();
  EXPECT_FALSE(parameters.is_supported());
  parameters.foundation_groups = {"Einspannung"};
  parameters.foundation_stiffness = {1e8, 1e8, 0};
  EXPECT_THROW(parameters.check("rail/Mesh"), InputError);
  parameters.foundation_stiffness = {1e8, 1e8, 2e8};
  parameters.foundation_loss_factor = 0.3;
  parameters.check("rail/Mesh");
  EXPECT_TRUE(parameters.is_supported());
  BodyMesh<3> mesh = make_mesh_from_file(parameters, 0, nullptr, "rail", MPI_COMM_WORLD);
  ElasticModel<3> model;
  add_supports(model, parameters, mesh);
  model.gravity[2] = -9.81;
  const ElasticBody<3> body(std::move(mesh), model, 1);
  const auto system = assemble_body(body);
  EXPECT_EQ(system->n_rigid_modes, 0u);
  const double area = 0.06 * 0.04;
  PETScWrappers::MPI::Vector lift = rigid_motions(body)[2], force(lift);
  lift /= lift.linfty_norm();
  system->stiffness.vmult(force, lift);
  EXPECT_NEAR(lift * force / (2e8 * area), 1, 1e-9);
  Flexibility flexibility(*system);
  PETScWrappers::MPI::Vector u(system->load);
  flexibility.vmult(u, system->load);
  EXPECT_NEAR((u * system->load) * 2e8 * area / std::pow(9.81 * system->total_mass, 2), 1, 1e-2);
  ModeParameters modes;
  modes.count = 3;
  const auto zeta = strain_energy_damping(*system, compute_modes(*system, flexibility, modes));
  EXPECT_NEAR(zeta[0], 0.15, 1e-3);

  parameters.foundation_groups = {"base"};
  EXPECT_THROW(make_mesh_from_file(parameters, 0, nullptr, "rail", MPI_COMM_WORLD), InputError);
}

TEST(MeshFile, wheel_from_a_file_is_labelled_as_a_wheel)
{
  MeshFileParameters wheel;
  wheel.geometry = "wheel";
  const BodyParameters built_in("wheel", "wheel"), from_file = body_of("wheel", "mesh", wheel),
                                                   foreign = body_of("block", "mesh", foreign_block());
  ASSERT_TRUE(from_file.axle_height(0.01).has_value());
  EXPECT_EQ(*from_file.axle_height(0.01), *built_in.axle_height(0.01));
  EXPECT_NEAR(*from_file.axle_height(0), 0.46, 1e-6);
  EXPECT_FALSE(foreign.axle_height(0).has_value());
}

TEST(MeshFile, wrong_files_are_refused_with_a_sentence)
{
  const auto expect = [](const std::string &text, const std::string &part)
  { EXPECT_NE(text.find(part), std::string::npos) << "got: " << text; };
  expect(complaint("\"Lauffläche\"", "\"Schiene\""), "those it has: Einspannung (25 faces)");
  const std::string unreadable = "gmsh cannot read the mesh file";
  expect(complaint("$MeshFormat\n4.1 0 8", "$MeshFormat\n4.0 0 8"), unreadable);
  expect(complaint("$MeshFormat\n4.1 0 8", "$MeshFormat\n4.1 1 8"), "holds no solid cells and no nodes");
  expect(complaint("$EndElements", "\n"), "");
  expect(complaint("$MeshFormat", "solid"), "no $MeshFormat");
  expect(complaint("$Elements\n", "$Elements\n-"), unreadable);
  expect(complaint("$Nodes\n", "$Nodes\n-"), unreadable);

  MeshFileParameters parameters = foreign_block();
  parameters.unit = 10;
  EXPECT_THROW(make_mesh_from_file(parameters, 0, nullptr, "rail", MPI_COMM_WORLD), InputError);
  parameters.file = "/nowhere.msh";
  EXPECT_THROW(parameters.check("rail/Mesh"), InputError);

  // One node of the block moved through its opposite face inverts cells.
  std::string text = content(foreign_block().file);
  const std::string node = "\n0 0 20\n";
  const auto place = text.find(node);
  ASSERT_NE(place, std::string::npos);
  text.replace(place, node.size(), "\n50 0 20\n");
  parameters = foreign_block();
  parameters.file = folder() + "/inverted.msh";
  std::ofstream(parameters.file) << text;
  try
  {
    make_mesh_from_file(parameters, 0, nullptr, "rail", MPI_COMM_WORLD);
    FAIL();
  }
  catch (const InputError &error)
  {
    expect(error.what(), "inverted or degenerate hexahedra");
  }
}

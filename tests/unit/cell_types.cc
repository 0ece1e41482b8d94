// Bodies of hexahedra, tetrahedra and prisms, of first and second order, from files: patch test, loads, supports,
// one and two ranks, curved geometry, formats.

#include "box_of_cells.h"
#include "constant_strain.h"
#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/scene/cell_elements.h>
#include <vibrocontact/scene/file_cells.h>
#include <vibrocontact/scene/mesh_file.h>

#include <deal.II/grid/grid_tools.h>

#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  std::string cell_types_folder()
  {
    return scratch_folder();
  }

  MeshFileParameters distorted_box(const std::string &type, const bool curved, const unsigned int degree)
  {
    BoxOfCells box;
    box.type = type;
    box.divisions = {{3, 3, 3}};
    box.place = distorted_in_box;
    box.curved = curved;
    MeshFileParameters parameters;
    parameters.file = cell_types_folder() + "/" + type + (curved ? "_curved" : "") + ".inp";
    box.write(parameters.file);
    parameters.element_degree = degree;
    return parameters;
  }

  ElasticBody<3> body_of_cells(const MeshFileParameters &parameters, const ElasticModel<3> &given,
                               const MPI_Comm communicator, const std::string &loaded = "")
  {
    ElasticModel<3> model = given;
    BodyMesh<3> mesh = make_mesh_from_file(parameters, 0, nullptr, "box", communicator);
    add_supports(model, parameters, mesh);
    if (!loaded.empty())
      model.tractions.push_back({mesh.boundary_id(loaded), Tensor<1, 3>({0, 2e6, 1e6})});
    return ElasticBody<3>(std::move(mesh), model, parameters.element_degree);
  }

  struct CellCase
  {
    std::string type;
    bool curved;
    unsigned int degree;
  };
  const std::vector<CellCase> cell_cases = {
      {"C3D8", false, 1},  {"C3D8", false, 2}, {"C3D8", false, 3}, {"C3D20", false, 1}, {"C3D20", false, 2},
      {"C3D20", true, 2},  {"C3D20", true, 3}, {"C3D4", false, 1}, {"C3D4", false, 2},  {"C3D10", true, 1},
      {"C3D10", false, 2}, {"C3D10", true, 2}, {"C3D6", false, 1}, {"C3D6", false, 2},  {"C3D15", true, 1},
      {"C3D15", false, 2}, {"C3D15", true, 2}};

  std::string name_of_cells(const CellCase &one)
  {
    return one.type + (one.curved ? " curved" : "") + ", degree " + std::to_string(one.degree);
  }
} // namespace

TEST(CellTypesMpi, constant_strain_is_exact)
{
  double worst = 0;
  for (const CellCase &one : cell_cases)
  {
    const ElasticBody<3> body =
        body_of_cells(distorted_box(one.type, one.curved, one.degree), {}, MPI_COMM_WORLD);
    const auto system = assemble_body(body);
    EXPECT_EQ(system->n_rigid_modes, 6u);
    const ConstantStrain strain =
        constant_strain(body, *system, Tensor<2, 3>({{1, -2, -0.7}, {2, -2, 0.3}, {3, -2, 3.3}}));
    EXPECT_GT(strain.n_inner, 20u) << name_of_cells(one);
    worst = std::max(worst, strain.residual);
    EXPECT_LT(strain.residual, 1e-12) << name_of_cells(one);
    EXPECT_NEAR(system->total_mass / (body.model.material.density * 0.3 * 0.2 * 0.1), 1, 1e-12)
        << name_of_cells(one);
    for (const auto &motion : system->rigid_motions)
    {
      PETScWrappers::MPI::Vector force(motion);
      system->stiffness.vmult(force, motion);
      EXPECT_LT(force.linfty_norm(), 1e-12 * system->stiffness.linfty_norm()) << name_of_cells(one);
    }
  }
  std::cout << "forces on inner nodes over those on the boundary: " << worst << std::endl;
}

TEST(CellTypesMpi, loads_supports_and_modes_do_not_depend_on_ranks)
{
  for (const CellCase &one : std::vector<CellCase>{{"C3D8", false, 1},
                                                   {"C3D20", true, 2},
                                                   {"C3D4", false, 1},
                                                   {"C3D10", true, 2},
                                                   {"C3D15", true, 2}})
  {
    MeshFileParameters parameters = distorted_box(one.type, one.curved, one.degree);
    parameters.held_groups = {"left"};
    parameters.foundation_groups = {"bottom"};
    parameters.foundation_stiffness = {1e9, 2e9, 3e9};
    // an edge of a held face may belong to a face on springs, its faces do not
    ElasticModel<3> model;
    model.gravity[2] = -10;
    std::vector<double> frequencies[2];
    for (const bool alone : {true, false})
    {
      const MPI_Comm communicator = alone ? MPI_COMM_SELF : MPI_COMM_WORLD;
      const ElasticBody<3> body = body_of_cells(parameters, model, communicator, "right");
      const auto system = assemble_body(body);
      EXPECT_EQ(system->n_rigid_modes, 0u);
      Flexibility flexibility(*system);
      ModeParameters wanted;
      wanted.count = 4;
      frequencies[alone] = compute_modes(*system, flexibility, wanted).omega;
      if (alone)
      {
        // without what is held: all of the load, all of the springs
        MeshFileParameters free = parameters;
        free.held_groups.clear();
        const ElasticBody<3> whole = body_of_cells(free, model, MPI_COMM_SELF, "right");
        const auto loose = assemble_body(whole);
        const auto lift = rigid_motions(whole)[2];
        const double one_metre = lift.linfty_norm();
        PETScWrappers::MPI::Vector force(lift);
        loose->stiffness.vmult(force, lift);
        EXPECT_NEAR(lift * force / (one_metre * one_metre * 3e9 * 0.3 * 0.2), 1, 1e-9) << name_of_cells(one);
        EXPECT_NEAR((lift * loose->load) / one_metre / (1e6 * 0.2 * 0.1 - 10 * loose->total_mass), 1, 1e-9)
            << name_of_cells(one);
      }
    }
    ASSERT_EQ(frequencies[0].size(), frequencies[1].size());
    for (unsigned int k = 0; k < frequencies[0].size(); ++k)
      EXPECT_NEAR(frequencies[0][k] / frequencies[1][k], 1, 1e-10) << name_of_cells(one);
  }
}

TEST(CellTypes, one_geometry_has_the_same_modes_by_every_cell)
{
  std::map<std::string, double> first;
  for (const std::string type : {"C3D8", "C3D20", "C3D4", "C3D10", "C3D6", "C3D15"})
  {
    MeshFileParameters parameters = distorted_box(type, false, 2);
    parameters.held_groups = {"left"};
    const ElasticBody<3> body = body_of_cells(parameters, {}, MPI_COMM_SELF);
    const auto system = assemble_body(body);
    Flexibility flexibility(*system);
    ModeParameters wanted;
    wanted.count = 1;
    first[type] = compute_modes(*system, flexibility, wanted).omega[0];
  }
  EXPECT_NEAR(first["C3D4"] / first["C3D10"], 1, 1e-11);
  // with one more point in the distorted prisms
  EXPECT_NEAR(first["C3D6"] / first["C3D15"], 1, 1e-5);
  for (const auto &[type, omega] : first)
    EXPECT_NEAR(omega / first["C3D20"], 1, 0.01) << type;
}

namespace
{
  /// Error of the first longitudinal frequency c / (4 L) of a bar held at one end, Poisson's ratio 0, cells distorted
  /// inside.
  double error_of_bar(const std::string &type, const unsigned int degree, const unsigned int n)
  {
    BoxOfCells box;
    box.type = type;
    box.divisions = {{2 * n, n, n}};
    box.place = [](const Point<3> &p)
    {
      const double bump =
          0.08 * std::sin(numbers::PI * p[0]) * std::sin(numbers::PI * p[1]) * std::sin(numbers::PI * p[2]);
      return Point<3>(0.3 * (p[0] + bump), 0.2 * (p[1] - bump), 0.2 * (p[2] + bump));
    };
    MeshFileParameters parameters;
    parameters.file = cell_types_folder() + "/bar.inp";
    parameters.element_degree = degree;
    parameters.held_groups = {"left"};
    box.write(parameters.file);
    ElasticModel<3> model;
    model.material.poisson_ratio = 0;
    const ElasticBody<3> body = body_of_cells(parameters, model, MPI_COMM_SELF);
    const auto system = assemble_body(body);
    Flexibility flexibility(*system);
    ModeParameters wanted;
    wanted.count = 6;
    const Modes modes = compute_modes(*system, flexibility, wanted);
    // the mode that is most like sin(pi x / 2 L) along x
    double best = 0, omega = 0;
    for (unsigned int m = 0; m < modes.omega.size(); ++m)
    {
      double along = 0, all = 0, other = 0;
      for (unsigned int i = 0; i < system->dof_position.size(); ++i)
      {
        const double u = modes.shapes[m](body.locally_owned.nth_index_in_set(i)),
                     v = system->dof_direction[i] == 0
                             ? std::sin(numbers::PI * system->dof_position[i][0] / 0.6)
                             : 0;
        along += u * v;
        all += u * u;
        other += v * v;
      }
      const double alike = std::abs(along) / std::sqrt(all * other);
      if (alike > best)
      {
        best = alike;
        omega = modes.omega[m];
      }
    }
    EXPECT_GT(best, 0.98);
    const double exact = numbers::PI / 0.6 * std::sqrt(model.material.young_modulus / model.material.density);
    return omega / exact - 1;
  }
} // namespace

TEST(CellTypes, frequencies_converge_at_the_expected_order)
{
  for (const auto &[type, degree] : std::vector<std::pair<std::string, unsigned int>>{
           {"C3D8", 1}, {"C3D4", 1}, {"C3D6", 1}, {"C3D20", 2}, {"C3D10", 2}, {"C3D15", 2}})
  {
    // of distorted tetrahedra the order rises slowly: 3.5 from 2 cells across to 4
    const unsigned int n = type == std::string("C3D10") ? 4 : 2;
    const double coarse = error_of_bar(type, degree, n), fine = error_of_bar(type, degree, 2 * n),
                 order = std::log2(coarse / fine);
    std::cout << type << ", degree " << degree << ": " << coarse << ", " << fine << ", order " << order
              << std::endl;
    EXPECT_GT(fine, 0) << type;
    EXPECT_NEAR(order, 2. * degree, 0.35) << type;
  }
}

TEST(CellTypes, fields_of_every_cell_are_written)
{
  for (const CellCase &one : cell_cases)
  {
    const ElasticBody<3> body =
        body_of_cells(distorted_box(one.type, one.curved, one.degree), {}, MPI_COMM_SELF);
    const auto system = assemble_body(body);
    const PETScWrappers::MPI::Vector &u = system->rigid_motions[0];
    for (const char *set : {"whole", "skin"})
    {
      std::filesystem::create_directories(cell_types_folder() + "/fields");
      set == std::string("whole") ? write_fields(body, {{&u, 0.}}, cell_types_folder(), set)
                                  : write_surface_fields(body, {{&u, 0.}}, cell_types_folder(), set);
      EXPECT_GT(std::filesystem::file_size(cell_types_folder() + "/" + field_name(set, 0)), 500u)
          << name_of_cells(one);
    }
  }
}

namespace
{
  /// A sphere of radius 1 by gmsh, cells of order two and this size, in the formats of these endings.
  void write_sphere(const std::string &name, const std::vector<std::pair<std::string, double>> &formats,
                    const double size)
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::model::occ::addSphere(0, 0, 0, 1);
    gmsh::model::occ::synchronize();
    gmsh::option::setNumber("Mesh.MeshSizeMax", size);
    gmsh::option::setNumber("Mesh.MeshSizeMin", size);
    gmsh::model::addPhysicalGroup(2, {1}, 5);
    gmsh::model::setPhysicalName(2, 5, "skin");
    gmsh::model::addPhysicalGroup(3, {1}, 6);
    gmsh::model::setPhysicalName(3, 6, "steel");
    gmsh::model::mesh::generate(3);
    gmsh::model::mesh::setOrder(2);
    for (const auto &[ending, version] : formats)
    {
      gmsh::option::setNumber("Mesh.MshFileVersion", std::abs(version));
      gmsh::option::setNumber("Mesh.Binary", version < 0 ? 1 : 0);
      gmsh::write(name + ending);
    }
    gmsh::finalize();
  }
} // namespace

TEST(CellTypesMpi, curved_tetrahedra_from_every_format)
{
  const std::string name = cell_types_folder() + "/sphere";
  // version; negative: binary
  const std::vector<std::pair<std::string, double>> formats = {
      {"_4.msh", 4.1}, {"_4b.msh", -4.1}, {"_2.msh", 2.2}, {"_2b.msh", -2.2},
      {".unv", 1},     {".bdf", 1},       {".vtk", 1},     {".inp", 1}};
  write_sphere(name, formats, 0.3);
  for (const auto &[ending, version] : formats)
  {
    MeshFileParameters parameters;
    parameters.file = name + ending;
    const bool numbered = ending == ".bdf" || ending == ".vtk";
    // of surface number 1
    parameters.held_groups = {numbered ? "1" : "skin"};
    parameters.check("ball/Mesh");
    const FileCells cells = FileCells::read(parameters.file);
    EXPECT_EQ(cells.type, 11u);
    EXPECT_EQ(cells.face_counts().at(parameters.held_groups[0]), cells.faces.size()) << ending;
    const BodyMesh<3> mesh = make_mesh_from_file(parameters, 0, nullptr, "ball", MPI_COMM_WORLD);
    const auto mapping = make_mapping(mesh);
    const auto element = scalar_element<3>(mesh.reference_cell(), 2);
    FEValues<3> values(*mapping, *element, cell_quadrature<3>(mesh.reference_cell(), 3), update_JxW_values);
    FaceValues<3> face_values(*mapping, *element, 3);
    double volume = 0, area = 0;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      if (cell->is_locally_owned())
      {
        values.reinit(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          volume += values.JxW(q);
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
          {
            face_values.reinit(cell, f);
            EXPECT_EQ(cell->face(f)->boundary_id(), mesh.boundary_id(parameters.held_groups[0]));
            for (unsigned int q = 0; q < face_values.n_points(); ++q)
              area += face_values.JxW(q);
          }
      }
    volume = Utilities::MPI::sum(volume, MPI_COMM_WORLD);
    area = Utilities::MPI::sum(area, MPI_COMM_WORLD);
    EXPECT_NEAR(volume / (4 * numbers::PI / 3), 1, 2e-4) << ending;
    EXPECT_NEAR(area / (4 * numbers::PI), 1, 2e-4) << ending;
    if (ending == "_4.msh")
      std::cout << "sphere: volume " << volume / (4 * numbers::PI / 3) - 1 << ", surface "
                << area / (4 * numbers::PI) - 1 << std::endl;
  }
}

TEST(CellTypes, files_damaged_at_random_are_taken_or_refused)
{
  const unsigned int n_files = 25;
  const std::string name = cell_types_folder() + "/ball";
  const std::vector<std::pair<std::string, double>> formats = {
      {"_4.msh", 4.1}, {"_4b.msh", -4.1}, {"_2.msh", 2.2}, {"_2b.msh", -2.2},
      {".unv", 1},     {".bdf", 1},       {".vtk", 1},     {".inp", 1}};
  write_sphere(name, formats, 1.);
  std::mt19937 random(17);
  for (const auto &[ending, version] : formats)
  {
    std::ifstream stream(name + ending, std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(stream)), {});
    unsigned int n_taken = 0, n_refused = 0, n_crashes = 0;
    for (unsigned int k = 0; k < n_files; ++k)
    {
      // up to four bytes are others, and of every third file the end is missing
      std::string text = whole;
      for (unsigned int n = 1 + random() % 4; n > 0; --n)
        text[random() % text.size()] = k % 2 == 0 ? char(random() % 256) : "0123456789-. \n"[random() % 14];
      if (k % 3 == 0)
        text.resize(random() % text.size());
      const std::string damaged = cell_types_folder() + "/damaged" + ending;
      std::ofstream(damaged, std::ios::binary) << text;
      try
      {
        FileCells::read(damaged);
        ++n_taken;
      }
      catch (const InputError &error)
      {
        ++n_refused;
        n_crashes += std::string(error.what()).find("gmsh breaks off") != std::string::npos;
      }
    }
    EXPECT_EQ(n_taken + n_refused, n_files);
    std::cout << ending << ": " << n_taken << " taken, " << n_refused << " refused, gmsh broke off in "
              << n_crashes << std::endl;
  }
}

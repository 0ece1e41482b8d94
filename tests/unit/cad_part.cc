// Parts from STEP files: faces that are chosen, tetrahedra against closed forms and hexahedra, the cache of meshes, and damaged
// files that are refused with a sentence.

#include "step_file.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/modes.h>
#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/cell_elements.h>
#include <vibrocontact/scene/mesh_file.h>

#include <gmsh.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  void draw_cylinder()
  {
    gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, 20, 5);
  }

  MeshFileParameters part_of(const std::string &file, const std::string &faces, const double size)
  {
    MeshFileParameters parameters;
    parameters.file = file;
    parameters.cad.faces = faces;
    parameters.cad.cell_size = size;
    return parameters;
  }

  std::string said_of_part(const MeshFileParameters &parameters)
  {
    try
    {
      parameters.check("part/Mesh");
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "nothing";
  }

  std::string said_of_step(const std::string &text, const std::string &ending = ".step")
  {
    const std::string file = scratch_folder() + "/damaged" + ending;
    std::ofstream(file, std::ios::binary) << text;
    return said_of_part(part_of(file, "", 5e-3));
  }

  void expect_sentence(const std::string &said, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(said.find(part), std::string::npos) << "wanted: " << part << "\ngot: " << said;
    EXPECT_LT(said.size(), 700u) << said;
  }

  struct Measures
  {
    double volume = 0;
    std::map<std::string, double> areas;
  };

  Measures measures(const BodyMesh<3> &mesh)
  {
    const auto mapping = make_mapping(mesh);
    const auto element = scalar_element<3>(mesh.reference_cell(), 2);
    FEValues<3> values(*mapping, *element, cell_quadrature<3>(mesh.reference_cell(), 3), update_JxW_values);
    FaceValues<3> face_values(*mapping, *element, 3);
    Measures result;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      values.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices())
        result.volume += values.JxW(q);
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          face_values.reinit(cell, f);
          for (const auto &[name, id] : mesh.boundaries)
            if (id == cell->face(f)->boundary_id())
              for (unsigned int q = 0; q < face_values.n_points(); ++q)
                result.areas[name] += face_values.JxW(q);
        }
    }
    result.volume = Utilities::MPI::sum(result.volume, MPI_COMM_WORLD);
    for (const auto &[name, id] : mesh.boundaries)
      result.areas[name] = Utilities::MPI::sum(result.areas[name], MPI_COMM_WORLD);
    return result;
  }

  std::vector<double> first_frequencies(BodyMesh<3> mesh, const std::string &held)
  {
    ElasticModel<3> model;
    model.held = {mesh.boundary_id(held)};
    const ElasticBody<3> body(std::move(mesh), model, 2);
    const auto system = assemble_body(body);
    Flexibility flexibility(*system);
    ModeParameters parameters;
    parameters.count = 4;
    std::vector<double> result;
    for (const double omega : compute_modes(*system, flexibility, parameters).omega)
      result.push_back(omega / (2 * numbers::PI));
    return result;
  }
} // namespace

TEST(CadPart, faces_are_chosen_by_number_plane_cylinder_box_and_name)
{
  const std::string file = step_file("chosen.step", draw_cylinder);
  // the first face is the curved one
  std::ofstream(scratch_folder() + "/named.step")
      << step_with(step_text(file), "ADVANCED_FACE(''", "ADVANCED_FACE('mantle'");
  const CadPart part = read_cad_part(scratch_folder() + "/named.step");
  ASSERT_EQ(part.faces.size(), 3u);
  EXPECT_NEAR(part.volume / (numbers::PI * 25e-6 * 20e-3), 1, 1e-9);
  const auto chosen = [&](const std::string &rule)
  {
    const auto groups = chosen_faces(face_rules("group: " + rule, "Faces"), part, "Faces", "file");
    return groups.at("group");
  };
  using Faces = std::vector<int>;
  unsigned int mantle = 0, top = 0, foot = 0;
  for (const CadFace &face : part.faces)
    (face.surface == "Cylinder" ? mantle : face.centre[2] > 0.01 ? top : foot) = face.number;
  EXPECT_EQ(chosen("plane z = 0.02"), Faces{int(top)});
  EXPECT_EQ(chosen("plane z=0"), Faces{int(foot)});
  EXPECT_EQ(chosen("cylinder z 0.005"), Faces{int(mantle)});
  EXPECT_EQ(chosen("cylinder z 0.005 at 0 0"), Faces{int(mantle)});
  EXPECT_EQ(chosen("name mantle"), Faces{int(mantle)});
  EXPECT_EQ(chosen("number " + std::to_string(top)), Faces{int(top)});
  EXPECT_EQ(chosen("box -0.005 -0.005 -0.001 0.005 0.005 0.001"), Faces{int(foot)});
  EXPECT_EQ(chosen("box -0.005 -0.005 0 0.005 0.005 0.02").size(), 3u);
  EXPECT_EQ(chosen("plane z = 0; group: plane z = 0.02").size(), 2u);
  for (const char *rule : {"plane z = 0.019", "plane x = 0", "cylinder z 0.004", "cylinder x 0.005",
                           "cylinder z 0.005 at 0 0.001", "name other", "number 4"})
    EXPECT_THROW(chosen(rule), InputError) << rule;
  for (const char *rule : {"plane w = 0", "plane z", "plane z = 0 1", "cylinder z", "cylinder z 1 at 0",
                           "box 0 0 0 1", "box 1 0 0 0 1 1", "number", "number 1.5", "name", "sphere 1", ""})
    EXPECT_THROW(chosen(rule), InputError) << rule;
  EXPECT_THROW(chosen_faces(face_rules("a: plane z = 0; b: number " + std::to_string(foot), "Faces"), part,
                            "Faces", "file"),
               InputError);
}

TEST(CadPartMpi, cylinder_and_sphere_against_closed_forms)
{
  const std::string cylinder_file = step_file("cylinder.step", draw_cylinder);
  MeshFileParameters parameters =
      part_of(cylinder_file, "mantle: cylinder z 0.005; top: plane z = 0.02", 2e-3);
  parameters.held_groups = {"top"};
  const Measures one = measures(make_mesh_from_file(parameters, 0, nullptr, "pin", MPI_COMM_WORLD));
  EXPECT_NEAR(one.volume / (numbers::PI * 25e-6 * 20e-3), 1, 1e-4);
  EXPECT_NEAR(one.areas.at("mantle") / (2 * numbers::PI * 5e-3 * 20e-3), 1, 1e-4);
  EXPECT_NEAR(one.areas.at("top") / (numbers::PI * 25e-6), 1, 1e-4);

  const std::string sphere_file = step_file("sphere.step", [] { gmsh::model::occ::addSphere(0, 0, 0, 10); });
  const Measures ball = measures(make_mesh_from_file(part_of(sphere_file, "skin: number 1", 2.5e-3), 0,
                                                     nullptr, "ball", MPI_COMM_WORLD));
  EXPECT_NEAR(ball.volume / (4 * numbers::PI / 3 * 1e-6), 1, 2e-4);
  EXPECT_NEAR(ball.areas.at("skin") / (4 * numbers::PI * 1e-4), 1, 2e-4);
}

TEST(CadPart, frequencies_are_those_of_hexahedra)
{
  const std::string file = step_file("beam.step", [] { gmsh::model::occ::addBox(0, 0, 0, 60, 10, 8); });
  const auto tetrahedra = first_frequencies(
      make_mesh_from_file(part_of(file, "root: plane x = 0", 2e-3), 0, nullptr, "beam", MPI_COMM_WORLD),
      "root");
  BlockParameters block;
  block.length = 0.06;
  block.width = 0.01;
  block.height = 0.008;
  block.divisions_x = 24;
  block.divisions_y = block.divisions_z = 4;
  const auto hexahedra = first_frequencies(make_block<3>(block, "beam", MPI_COMM_WORLD), "left");
  for (unsigned int k = 0; k < 4; ++k)
    EXPECT_NEAR(tetrahedra[k] / hexahedra[k], 1, 2e-3) << k;
}

TEST(CadPart, a_mesh_is_made_once_and_finer_at_the_contact)
{
  namespace fs = std::filesystem;
  const std::string file = step_file("cached.step", draw_cylinder), folder = scratch_folder() + "/cache";
  fs::remove_all(folder);
  MeshFileParameters parameters = part_of(file, "contact: plane z = 0", 4e-3);
  const auto n_cells = [&]
  {
    return make_mesh_from_file(parameters, 0, nullptr, "pin", MPI_COMM_WORLD, {}, folder)
        .triangulation->n_global_active_cells();
  };
  const auto n_files = [&]
  { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); };
  const auto coarse = n_cells();
  ASSERT_EQ(n_files(), 1);
  // a mark in the kept file shows that it is taken, not made
  const fs::path kept = fs::directory_iterator(folder)->path();
  const auto time = fs::last_write_time(kept) - std::chrono::hours(1);
  fs::last_write_time(kept, time);
  EXPECT_EQ(n_cells(), coarse);
  EXPECT_EQ(n_files(), 1);
  EXPECT_EQ(fs::last_write_time(kept), time);

  parameters.cad.contact_cell_size = 1e-3;
  parameters.cad.growth_distance = 8e-3;
  EXPECT_GT(n_cells(), 2 * coarse);
  EXPECT_EQ(n_files(), 2);
  // looked at only: nothing is kept
  parameters.cad.cell_size = 3e-3;
  parameters.write_no_mesh();
  EXPECT_GT(n_cells(), coarse);
  EXPECT_EQ(n_files(), 2);
  // a mesh that is written is that of the part
  parameters.cad.copy = scratch_folder() + "/copy.msh";
  const auto fine = n_cells();
  MeshFileParameters copy;
  copy.file = parameters.cad.copy;
  EXPECT_EQ(
      make_mesh_from_file(copy, 0, nullptr, "pin", MPI_COMM_WORLD).triangulation->n_global_active_cells(),
      fine);
}

TEST(CadPart, units_are_those_of_the_file)
{
  const std::string text = step_text(step_file("units.step", draw_cylinder));
  const std::string file = scratch_folder() + "/centimetres.step";
  std::ofstream(file) << step_with(text, ".MILLI.,.METRE.", ".CENTI.,.METRE.");
  EXPECT_NEAR(read_cad_part(file).volume / (numbers::PI * 2.5e-3 * 0.2), 1, 1e-9);
  MeshFileParameters parameters = part_of(file, "", 0.02);
  parameters.unit = 1e-3;
  expect_sentence(said_of_part(parameters), {"part/Mesh/Unit is 0.001", "leave it out"});
}

TEST(CadPart, damaged_files_are_refused_with_a_sentence)
{
  const std::string text = step_text(step_file("whole.step", draw_cylinder));
  EXPECT_EQ(said_of_step(text), "nothing");
  expect_sentence(said_of_step(""), {"no file of its format", "ISO-10303-21"});
  expect_sentence(said_of_step("solid cube\nendsolid\n"), {"no file of its format"});
  expect_sentence(said_of_step(text.substr(0, text.size() / 2)), {"is cut off", "END-ISO-10303-21"});
  const std::size_t data = text.find("DATA;") + 5;
  expect_sentence(said_of_step(text.substr(0, data) + "\nENDSEC;\nEND-ISO-10303-21;\n"),
                  {"says no unit of length"});
  expect_sentence(said_of_step(text.substr(0, data) + "\n#1 = LENGTH_UNIT();\nENDSEC;\nEND-ISO-10303-21;\n"),
                  {"CAD file"});
  // the shell of the solid is missing
  expect_sentence(said_of_step(step_with(text, "CLOSED_SHELL", "CARTESIAN_POINT")), {"CAD file"});
  expect_sentence(said_of_step(step_with(text, "MANIFOLD_SOLID_BREP", "NO_SOLID_AT_ALL")),
                  {"the CAD file", "damaged"});
  expect_sentence(said_of_step(text, ".brep"), {"no file of its format", "DBRep_DrawableShape"});
  expect_sentence(said_of_step("DBRep_DrawableShape\n\nCASCADE Topology V1\n", ".brep"), {"CAD file"});
  const std::string surface =
      step_file("surface.step", [] { gmsh::model::occ::addRectangle(0, 0, 0, 10, 10); });
  expect_sentence(said_of_part(part_of(surface, "", 1e-3)), {"has no solid, only 1 surfaces"});
  expect_sentence(said_of_step(step_with(text, ".MILLI.,.METRE.", ".MICRO.,.METRE.")),
                  {"describes a part of", "unit"});
}

TEST(CadPart, entries_that_do_not_fit_are_refused)
{
  const std::string file = step_file("entries.step", draw_cylinder);
  expect_sentence(said_of_part(part_of(file, "", 0)), {"part/Mesh/CAD/Cell size is not set", "volume"});
  expect_sentence(said_of_part(part_of(file, "", 1e-6)), {"unknowns", "part/Mesh/CAD/Cell size larger"});
  expect_sentence(said_of_part(part_of(file, "top: plane z = 0.03", 5e-3)),
                  {"\"plane z = 0.03\" is no face", "which has 3", "Cylinder at"});
  MeshFileParameters parameters = part_of(file, "top: plane z = 0.02", 5e-3);
  parameters.cad.contact_cell_size = 6e-3;
  expect_sentence(said_of_part(parameters), {"Contact cell size is 0.006", "above the Cell size"});
  parameters.cad.contact_cell_size = 0;
  parameters.held_groups = {"foot"};
  expect_sentence(said_of_part(parameters), {"names the group 'foot'", "only top"});
}

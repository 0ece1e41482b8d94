// CAD files of several solids: their names, faces of one solid, each meshed by itself, glued: two bars of two materials in series, and a
// constant stress; solids that share a face; what is refused.

#include "step_file.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/make_elastic_body.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/flexibility.h>
#include <vibrocontact/scene/file_cells.h>
#include <vibrocontact/scene/mesh_file.h>

#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

using namespace vibrocontact;
using namespace dealii;

namespace
{
  constexpr double length_1 = 0.06, length_2 = 0.04, section_area = 0.01 * 0.008;

  /// Along x, one behind the other.
  void draw_two_bars()
  {
    gmsh::model::occ::addBox(0, 0, 0, 60, 10, 8);
    gmsh::model::occ::addBox(60, 0, 0, 40, 10, 8);
  }

  /// The same, but the faces of the second are cut along y = 3 mm, so that its mesh at the joint is another one.
  void draw_bars_of_other_faces()
  {
    gmsh::option::setNumber("Geometry.OCCUnionUnify", 0);
    gmsh::model::occ::addBox(0, 0, 0, 60, 10, 8);
    gmsh::vectorpair all;
    std::vector<gmsh::vectorpair> map;
    gmsh::model::occ::fuse({{3, gmsh::model::occ::addBox(60, 0, 0, 40, 3, 8)}},
                           {{3, gmsh::model::occ::addBox(60, 3, 0, 40, 7, 8)}}, all, map);
  }

  /// The solids called rod and tip; gmsh's writer leaves them a name of its own.
  std::string named_bars(const std::string &name,
                         const std::function<void()> &draw = draw_bars_of_other_faces)
  {
    std::string text = step_text(step_file("unnamed_" + name, draw));
    for (const auto &[own, given] :
         std::vector<std::pair<std::string, std::string>>{{".1'", "rod'"}, {".2'", "tip'"}})
    {
      // both texts of a product: number and name
      const std::string front = "Open CASCADE STEP translator ";
      for (std::size_t at = text.find(front); at != std::string::npos; at = text.find(front, at + 1))
      {
        const std::size_t end = text.find('\'', at);
        if (text.compare(end - 2, 3, own) == 0)
          text.replace(at, end + 1 - at, given);
      }
    }
    const std::string file = scratch_folder() + "/" + name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  MeshFileParameters bars_of(const std::string &file, const std::string &first, const std::string &second)
  {
    MeshFileParameters parameters;
    parameters.file = file;
    parameters.cad.faces = "root: plane x = 0; end: plane x = 0.1; joint 1: plane x = 0.06 of " + first +
                           "; joint 2: plane x = 0.06 of " + second;
    parameters.cad.cell_size = 5e-3;
    parameters.held_groups = {"root"};
    parameters.glued_groups = "joint 2: joint 1";
    return parameters;
  }

  ElasticMaterial without_contraction(const double young_modulus, const double density)
  {
    ElasticMaterial material;
    material.young_modulus = young_modulus;
    material.poisson_ratio = 0;
    material.density = density;
    return material;
  }

  std::string said_of_solids(const MeshFileParameters &parameters)
  {
    try
    {
      parameters.check("part/Mesh");
      make_mesh_from_file(parameters, 0, nullptr, "part", MPI_COMM_SELF);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "nothing";
  }

  void expect_of_solids(const std::string &said, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(said.find(part), std::string::npos) << "wanted: " << part << "\ngot: " << said;
    EXPECT_LT(said.size(), 700u) << said;
  }
} // namespace

TEST(CadSolids, names_and_faces)
{
  const CadPart named = read_cad_part(named_bars("named.step", draw_two_bars));
  ASSERT_EQ(named.solids.size(), 2u);
  EXPECT_EQ(named.solids[0].name, "rod");
  EXPECT_EQ(named.solids[1].name, "tip");
  const CadPart part = read_cad_part(step_file("two.step", draw_two_bars));
  ASSERT_EQ(part.solids.size(), 2u);
  EXPECT_EQ(part.solids[0].name, "solid1");
  EXPECT_EQ(part.solids[1].name, "solid2");
  EXPECT_NEAR(part.solids[0].volume / (length_1 * section_area), 1, 1e-9);
  EXPECT_NEAR(part.volume / ((length_1 + length_2) * section_area), 1, 1e-9);
  ASSERT_EQ(part.faces.size(), 12u);
  // of the two faces at one place each is chosen
  const auto chosen = [&](const std::string &rule)
  { return chosen_faces(face_rules("group: " + rule, "Faces"), part, "Faces", "file").at("group"); };
  EXPECT_EQ(chosen("plane x = 0.06").size(), 2u);
  for (const CadSolid &solid : part.solids)
  {
    const std::vector<int> one = chosen("plane x = 0.06 of " + solid.name);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(std::count(solid.faces.begin(), solid.faces.end(), one[0]), 1);
  }
  EXPECT_EQ(chosen("box -1 -1 -1 1 1 1 of solid2").size(), 6u);
  for (const char *rule : {"plane x = 0 of solid2", "plane x = 0 of rod", "number 99"})
    try
    {
      chosen(rule);
      ADD_FAILURE() << rule;
    }
    catch (const InputError &error)
    {
      expect_of_solids(error.what(), {rule, "solids solid1 (faces 1 to 6), solid2 (faces 7 to 12)"});
    }
  EXPECT_THROW(chosen("plane x = 0 of"), InputError);
}

TEST(CadSolids, names_in_an_assembly)
{
  // of two faces at one place each has its own
  std::string text = step_text(named_bars("faces.step", draw_two_bars));
  unsigned int n = 0;
  for (std::size_t at = text.find("ADVANCED_FACE(''"); at != std::string::npos;
       at = text.find("ADVANCED_FACE(''", at + 1))
    text.replace(at, 16, "ADVANCED_FACE('face " + std::to_string(++n) + "'");
  // as it is, and the second bar moved by its place in the assembly
  for (const bool moved : {false, true})
  {
    const std::string file = scratch_folder() + (moved ? "/moved.step" : "/faces.step");
    std::ofstream(file, std::ios::binary) << (moved ? step_with(text, "#20 = CARTESIAN_POINT('',(0.,0.,0.))",
                                                                "#20 = CARTESIAN_POINT('',(0.,30.,2.))")
                                                    : text);
    const CadPart part = read_cad_part(file);
    ASSERT_EQ(part.solids.size(), 2u);
    EXPECT_EQ(part.solids[1].name, "tip");
    EXPECT_LT(
        part.solids[1].centre.distance(moved ? Point<3>(0.08, 0.035, 0.006) : Point<3>(0.08, 0.005, 0.004)),
        1e-9);
    std::set<std::string> names;
    for (const CadFace &face : part.faces)
    {
      names.insert(face.name);
      EXPECT_EQ(face.solids, std::vector<std::string>{face.number <= 6 ? "rod" : "tip"});
    }
    EXPECT_EQ(names.size(), 12u);
    EXPECT_EQ(names.count(""), 0u);
  }
  // what a list of groups cannot hold is no name
  for (std::size_t at = text.find("'tip'"); at != std::string::npos; at = text.find("'tip'", at + 1))
    text.replace(at, 5, "'tip, 2'");
  std::ofstream(scratch_folder() + "/comma.step", std::ios::binary) << text;
  EXPECT_EQ(read_cad_part(scratch_folder() + "/comma.step").solids[1].name, "solid2");
}

TEST(CadSolidsMpi, two_bars_of_two_materials_are_in_series)
{
  const std::string file = named_bars("bars.step");
  const ElasticMaterial rod = without_contraction(210e9, 7800), tip = without_contraction(3e9, 1200);
  for (const unsigned int degree : {1u, 2u})
  {
    MeshFileParameters mesh = bars_of(file, "rod", "tip");
    mesh.element_degree = degree;
    BodyParameters bars = body_of("bars", "mesh", mesh);
    bars.materials = {{"rod", rod}, {"tip", tip}};
    bars.loads.traction_boundary = "end";
    bars.loads.traction = {1e6, 0, 0};
    const auto body = make_elastic_body(bars, 0, {}, MPI_COMM_WORLD);
    const auto system = assemble_body(*body);
    EXPECT_EQ(system->n_rigid_modes, 0u);
    EXPECT_NEAR(system->total_mass / (section_area * (length_1 * rod.density + length_2 * tip.density)), 1,
                1e-9);
    Flexibility flexibility(*system);
    PETScWrappers::MPI::Vector u(system->load);
    flexibility.vmult(u, system->load);
    // each node by its place: the stress is the same everywhere
    double worst = 0;
    const double stretch = 1e6 * (length_1 / rod.young_modulus + length_2 / tip.young_modulus);
    for (unsigned int i = 0; i < system->dof_position.size(); ++i)
    {
      const double x = system->dof_position[i][0];
      const unsigned int dof = body->locally_owned.nth_index_in_set(i);
      const double exact = system->dof_direction[i] > 0 ? 0
                           : x < length_1 + 1e-9
                               ? 1e6 * x / rod.young_modulus
                               : 1e6 * (length_1 / rod.young_modulus + (x - length_1) / tip.young_modulus);
      if (!body->constraints.is_constrained(dof))
        worst = std::max(worst, std::abs(u(dof) - exact) / stretch);
    }
    worst = Utilities::MPI::max(worst, MPI_COMM_WORLD);
    std::cout << "degree " << degree << ": displacements off by " << worst << " of the stretch" << std::endl;
    EXPECT_LT(worst, 1e-9);
    const double force = 1e6 * section_area;
    EXPECT_NEAR((u * system->load) / (force * stretch), 1, 1e-9);
  }
}

TEST(CadSolids, each_is_meshed_by_itself_and_cached_by_its_names)
{
  namespace fs = std::filesystem;
  const std::string folder = scratch_folder() + "/solids_cache";
  MeshFileParameters parameters = bars_of(named_bars("kept.step"), "rod", "tip");
  const auto n_files = [&]
  { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); };
  parameters.cad.copy = scratch_folder() + "/bars.msh";
  make_mesh_from_file(parameters, 0, nullptr, "bars", MPI_COMM_SELF, {"rod", "tip"}, folder);
  EXPECT_EQ(n_files(), 1);
  const FileCells cells = FileCells::read(parameters.cad.copy);
  EXPECT_GT(cells.groups.counts().at("rod"), 10u);
  EXPECT_GT(cells.groups.counts().at("tip"), 10u);
  EXPECT_NE(cells.face_counts().at("joint 1"), cells.face_counts().at("joint 2"));
  // no vertex belongs to both
  std::map<unsigned int, unsigned int> group_at;
  for (unsigned int c = 0; c < cells.cells.size(); ++c)
    for (const unsigned int v : cells.cells[c].vertices)
      EXPECT_EQ(group_at.emplace(v, cells.groups.groups[c].at(0)).first->second,
                cells.groups.groups[c].at(0));
}

TEST(CadSolids, those_that_share_a_face_are_one_mesh_and_vibrate_as_glued_ones)
{
  const auto frequencies = [](MeshFileParameters mesh, const std::vector<std::string> &names)
  {
    mesh.held_groups = {"root"};
    BodyParameters bars = body_of("bars", "mesh", mesh);
    bars.materials = {{names[0], without_contraction(210e9, 7800)},
                      {names[1], without_contraction(70e9, 2700)}};
    const auto body = make_elastic_body(bars, 0, {}, MPI_COMM_SELF);
    const auto system = assemble_body(*body);
    Flexibility flexibility(*system);
    ModeParameters wanted;
    wanted.count = 4;
    return compute_modes(*system, flexibility, wanted).omega;
  };
  // by fragments of each other, which a BREP file keeps
  MeshFileParameters shared;
  shared.file = step_file("fragments.brep",
                          []
                          {
                            draw_two_bars();
                            gmsh::vectorpair all;
                            std::vector<gmsh::vectorpair> map;
                            gmsh::model::occ::fragment({{3, 1}}, {{3, 2}}, all, map);
                          });
  shared.unit = 1e-3;
  shared.cad.faces = "root: plane x = 0";
  shared.cad.cell_size = 4;
  EXPECT_EQ(read_cad_part(shared.file).faces.size(), 11u);
  const auto one_mesh = frequencies(shared, {"solid1", "solid2"});
  MeshFileParameters apart = bars_of(named_bars("glued.step"), "rod", "tip");
  apart.cad.cell_size = 4e-3;
  const auto glued = frequencies(apart, {"rod", "tip"});
  double worst = 0;
  for (unsigned int k = 0; k < 4; ++k)
    worst = std::max(worst, std::abs(glued.at(k) / one_mesh.at(k) - 1));
  std::cout << "four frequencies of glued bars against those of one mesh: " << worst << std::endl;
  EXPECT_LT(worst, 2e-4);
}

TEST(CadSolids, what_does_not_fit_is_refused)
{
  const std::string file = named_bars("refused.step");
  MeshFileParameters parameters = bars_of(file, "rod", "tip");
  expect_of_solids(said_of_solids(parameters), {"groups of cells, rod (", "part/Materials = rod, tip"});
  parameters.cad.faces = "root: plane x = 0; joint 1: plane x = 0.06 of rod";
  expect_of_solids(said_of_solids(parameters),
                   {"names the group 'joint 2'", "part/Mesh/CAD/Faces has only joint 1, root"});
  // nothing joins them
  parameters = bars_of(file, "rod", "tip");
  parameters.glued_groups.clear();
  try
  {
    make_mesh_from_file(parameters, 0, nullptr, "part", MPI_COMM_SELF, {"rod", "tip"});
    ADD_FAILURE();
  }
  catch (const InputError &error)
  {
    expect_of_solids(error.what(), {"double nodes", "Mesh/Glued"});
  }
  MeshFileParameters apart = parameters;
  apart.file = step_file("apart.step",
                         []
                         {
                           gmsh::model::occ::addBox(0, 0, 0, 60, 10, 8);
                           gmsh::model::occ::addBox(61, 0, 0, 40, 10, 8);
                         });
  apart.cad.faces = "root: plane x = 0";
  try
  {
    make_mesh_from_file(apart, 0, nullptr, "part", MPI_COMM_SELF, {"solid1", "solid2"});
    ADD_FAILURE();
  }
  catch (const InputError &error)
  {
    expect_of_solids(error.what(), {"falls into 2 pieces", "part/Mesh/Glued"});
  }
}

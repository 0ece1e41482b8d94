// Sections that are given as an outline alone: gmsh's cells against cells made by hand, the shipped wheel from its corners, and
// what is said of outlines that enclose nothing or too much.
#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/scene/drawn_section.h>
#include <vibrocontact/scene/revolved_mesh.h>
#include <vibrocontact/scene/section_manifolds.h>
#include <vibrocontact/scene/wheel.h>

#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace vibrocontact;

namespace
{
  std::string file_of(const std::string &name, const std::string &text)
  {
    const std::string file = scratch_folder() + "/" + name;
    std::ofstream(file) << text;
    return file;
  }

  std::vector<double> frequencies(const RevolvedSection &section, const unsigned int n)
  {
    run_log().set_screen(false);
    const auto system = section.system(n);
    Flexibility flexibility(*system);
    ModeParameters parameters;
    parameters.count = 3;
    std::vector<double> result;
    for (const double omega : compute_modes(*system, flexibility, parameters).omega)
      result.push_back(omega / (2 * dealii::numbers::PI));
    return result;
  }

  ElasticMaterial material(const double young, const double density)
  {
    ElasticMaterial result;
    result.young_modulus = young;
    result.density = density;
    return result;
  }

  RevolvedSection wheel(const std::string &outline, const std::vector<std::string> &groups,
                        const std::vector<ElasticMaterial> &materials, const double size)
  {
    WheelParameters parameters;
    parameters.model = "harmonics";
    parameters.section.element_degree = 3;
    parameters.section.outline = outline;
    parameters.section.cell_size = size;
    const std::vector<ContactPlace> none;
    const RevolvedMesh mesh = parameters.make_section({"wheel", 0., none, nullptr, groups, MPI_COMM_SELF});
    ElasticModel<3> model;
    model.material = materials.front();
    for (unsigned int k = 0; k < materials.size(); ++k)
      model.zones[k] = materials[k];
    model.held = {mesh.held};
    return RevolvedSection("wheel", mesh.triangulation, model, mesh.degree);
  }

  /// Why an outline is refused.
  std::string complaint(const std::string &text, const bool mirrored = false)
  {
    const std::string file = file_of("vibrocontact_wrong_outline.csv", text);
    try
    {
      closed_loops(SectionOutline::read(file), mirrored, "it");
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  const std::string rings = "a, r, rounding, part, region\n"
                            "-30, 60, 0, surface, disc\n-30, 200, 0, joint, disc\n30, 200, 0, surface, "
                            "disc\n30, 60, 0, bore, disc\n"
                            "-30, 200, 0, surface, rubber\n-30, 220, 0, joint, rubber\n30, 220, 0, surface, "
                            "rubber\n30, 200, 0, joint, rubber\n"
                            "-30, 220, 0, surface, tyre\n-30, 300, 0, tread, tyre\n30, 300, 0, surface, "
                            "tyre\n30, 220, 0, joint, tyre\n";
} // namespace

// Three rings of different materials: volume in closed form, frequencies of cells made by hand.
TEST(DrawnSection, SeveralMaterials)
{
  const std::vector<ElasticMaterial> materials = {material(210e9, 7800), material(1e9, 1100),
                                                  material(190e9, 7000)};
  const RevolvedSection drawn =
      wheel(file_of("vibrocontact_rings.csv", rings), {"disc", "rubber", "tyre"}, materials, 0.007);
  const auto ring = [](const double inner, const double outer)
  { return dealii::numbers::PI * (outer * outer - inner * inner) * 0.06; };
  const double mass = 7800 * ring(0.06, 0.2) + 1100 * ring(0.2, 0.22) + 7000 * ring(0.22, 0.3);
  EXPECT_NEAR(drawn.mass(), mass, 1e-9 * mass);

  const auto by_hand = std::make_shared<dealii::Triangulation<2>>();
  dealii::GridGenerator::subdivided_hyper_rectangle(*by_hand, {3u, 12u}, {-0.03, 0.06}, {0.03, 0.3}, true);
  for (const auto &cell : by_hand->active_cell_iterators())
    cell->set_material_id(cell->center()[1] < 0.2 ? 0 : cell->center()[1] < 0.22 ? 1 : 2);
  ElasticModel<3> model;
  model.material = materials.front();
  for (unsigned int k = 0; k < materials.size(); ++k)
    model.zones[k] = materials[k];
  model.held = {2};
  // both resolve the edges of the rubber, where stresses are singular
  by_hand->refine_global(2);
  const RevolvedSection plain("wheel", by_hand, model, 3);
  for (const unsigned int n : {0, 2, 3})
  {
    const std::vector<double> a = frequencies(drawn, n), b = frequencies(plain, n);
    for (unsigned int k = 0; k < 3; ++k)
      EXPECT_NEAR(a[k], b[k], 2e-4 * b[k]) << n << " waves, mode " << k;
  }
}

// The shipped wheel's defining corners and their roundings give its lines and arcs, and these cells give its modes.
TEST(DrawnSection, ShippedWheel)
{
  const std::string file =
      file_of("vibrocontact_wheel_corners.csv",
              "-95.0000,92.5000,0,surface\n-95.0000,125.5000,5,surface\n-9.4500,128.5000,45,surface\n"
              "-9.6000,262.0000,300,surface\n-13.2000,398.4000,32,surface\n-70.0000,404.9000,8,surface\n"
              "-70.0000,488.0000,11.5,surface\n-44.0514,488.0000,10.5,surface\n-33.8603,460.0000,13,tread\n"
              "60.0000,460.0000,0,surface\n65.0000,455.0000,0,surface\n65.0000,407.4000,8,surface\n"
              "11.2000,398.4000,32,surface\n12.6000,262.0000,300,surface\n21.4500,128.5000,45,surface\n"
              "85.0000,125.5000,5,surface\n85.0000,92.5000,0,bore\n");
  const SectionOutline corners = SectionOutline::read(file),
                       curves = SectionOutline::read(mesh_directory() + "/wheel_outline.txt");
  ASSERT_EQ(corners.rows.size(), curves.rows.size());
  for (unsigned int k = 0; k < curves.rows.size(); ++k)
  {
    EXPECT_LT(corners.rows[k].start.distance(curves.rows[k].start), 1e-7) << k;
    EXPECT_LT(corners.rows[k].end.distance(curves.rows[k].end), 1e-7) << k;
    EXPECT_EQ(corners.rows[k].is_arc, curves.rows[k].is_arc) << k;
    EXPECT_EQ(corners.rows[k].part, curves.rows[k].part) << k;
  }
  const RevolvedSection section = wheel(file, {}, {material(206.9e9, 7800)}, 0.015);
  EXPECT_NEAR(section.mass(), 314.86, 2e-4 * 314.86);
}

TEST(DrawnSection, RailByCorners)
{
  // a box of 60 by 100 mm with a straight crown: corners draw the line of symmetry too, wherever they begin
  const std::string corners[] = {"0, 0, 0, foot", "30, 0, 0, surface", "30, 100, 0, crown",
                                 "0, 100, 0, surface"};
  for (unsigned int first = 0; first < 4; ++first)
  {
    std::string text;
    for (unsigned int k = 0; k < 4; ++k)
      text += corners[(first + k) % 4] + "\n";
    const std::string file = file_of("box.csv", text);
    const SectionOutline outline = SectionOutline::read(file);
    const GmshFile mesh = mesh_outline(outline, 0.02, true, file);
    double area = 0;
    for (const auto &cell : mesh.quadrilaterals)
      for (unsigned int v = 0; v < 4; ++v)
      {
        const auto &p = mesh.nodes[cell[v]], &q = mesh.nodes[cell[(v + 1) % 4]];
        area += (p[0] * q[1] - p[1] * q[0]) / 2;
      }
    EXPECT_NEAR(std::abs(area), 0.06 * 0.1, 1e-12) << first;
  }
  std::vector<SectionOutline::Row> crown(1);
  crown[0].start = {0.03, 0.09};
  crown[0].end = {0., 0.1};
  EXPECT_NEAR(CrownManifold::height(crown, -0.015), 0.095, 1e-15);
}

TEST(DrawnSection, WrongOutlines)
{
  const auto says = [](const std::string &text, const std::string &part, const bool mirrored = false)
  { EXPECT_NE(complaint(text, mirrored).find(part), std::string::npos) << complaint(text, mirrored); };
  EXPECT_EQ(complaint(rings), "");
  says("-30, 60, 0, surface\n-30, 200, 0, tread\n", "has three or more");
  says("-30, 60, 0, surface\n30, 200, 0, surface\n-30, 200, 0, tread\n30, 60, 0, bore\n",
       "overlaps itself at");
  says("-30, -5, 0, surface\n-30, 200, 0, tread\n30, 200, 0, surface\n30, -5, 0, bore\n",
       "crosses its axle: it reaches a radius of -5 mm");
  says("-30, 60, 0, surface\n-30, 200, 80, tread\n30, 200, 0, surface\n30, 60, 0, bore\n",
       "take 80 mm of its 60 mm");
  says("-30, 60, 0, surface\n-30, x, 0, tread\n", "is no corner");
  says("-30, 60, 0, surface, a\n-30, 90, 0, surface, a\n30, 90, 0, surface, a\n-30, 80, 0, surface, b\n30, "
       "80, 0, surface, b\n30, 120, 0, tread, b\n",
       "Regions a and b");
  says("-30, 60, 0, surface, a\n-30, 90, 0, surface, a\n30, 90, 0, surface, a\n30, 60, 0, bore, a\n"
       "-20, 70, 0, surface, b\n20, 70, 0, surface, b\n0, 80, 0, tread, b\n",
       "overlap at");
  says("-1, 60, 0, surface\n30, 90, 0, surface\n30, 60, 0, bore\n", "reaches over its line of symmetry",
       true);
  const std::string open =
      file_of("vibrocontact_open_outline.txt", "line 0 60 0 90 0 0 0 surface\nline 0 90 30 90 0 0 0 tread\n"
                                               "line 30 90 30 61 0 0 0 surface\n");
  try
  {
    closed_loops(SectionOutline::read(open), false, "it");
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(
        std::string(error.what())
            .find("is not closed: its curve number 3 ends at (30, 61) mm, the first begins at (0, 60) mm"),
        std::string::npos)
        << error.what();
  }
}

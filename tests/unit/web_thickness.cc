// A wheel's web that is made thicker without another drawing: the same wheel drawn thicker, volume in closed form, where it is
// left alone, and what is refused.
#include "scratch_folder.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/scene/revolved_mesh.h>
#include <vibrocontact/scene/wheel.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace vibrocontact;

namespace
{
  const double bore = 0.06, rim = 0.3, inner = 0.1, outer = 0.26;

  double bump(const double r)
  {
    return r > inner && r < outer ? std::pow(std::sin(dealii::numbers::PI * (r - inner) / (outer - inner)), 2)
                                  : 0;
  }

  /// A conical plate, 20 mm thick and thicker by `change` between the radii, as a polygon.
  std::string drawn(const std::string &name, const double change)
  {
    const std::string file = scratch_folder() + "/" + name;
    std::ofstream out(file);
    out.precision(12);
    const unsigned int n = 32;
    const auto face = [&](const double side, const double r)
    { return 1e3 * (0.05 * (r - rim) + side * (0.01 + change / 2 * bump(r))); };
    for (unsigned int k = 0; k <= n; ++k)
    {
      const double r = inner + (outer - inner) * k / n;
      if (k == 0)
        out << face(-1, bore) << ", " << 1e3 * bore << ", 0, surface\n";
      out << face(-1, r) << ", " << 1e3 * r << ", 0, surface\n";
    }
    out << face(-1, rim) << ", " << 1e3 * rim << ", 0, tread\n";
    out << face(1, rim) << ", " << 1e3 * rim << ", 0, surface\n";
    for (unsigned int k = 0; k <= n; ++k)
    {
      const double r = outer + (inner - outer) * k / n;
      out << face(1, r) << ", " << 1e3 * r << ", 0, surface\n";
    }
    out << face(1, bore) << ", " << 1e3 * bore << ", 0, bore\n";
    return file;
  }

  WheelParameters wheel(const std::string &outline, const double change, const std::vector<double> &radii)
  {
    WheelParameters parameters;
    parameters.model = "harmonics";
    parameters.section.element_degree = 2;
    parameters.section.outline = outline;
    parameters.section.cell_size = 0.01;
    parameters.web.change = change;
    parameters.web.radii = radii;
    return parameters;
  }

  RevolvedSection section(const WheelParameters &parameters)
  {
    const std::vector<ContactPlace> none;
    const RevolvedMesh mesh = parameters.make_section({"wheel", 0., none, nullptr, {}, MPI_COMM_SELF});
    ElasticModel<3> model;
    model.held = {mesh.held};
    return RevolvedSection("wheel", mesh.triangulation, model, mesh.degree, mesh.displacement);
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

  std::string complaint(const WheelParameters &parameters)
  {
    try
    {
      section(parameters);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

TEST(WebThickness, IsThatOfAWheelDrawnThicker)
{
  const std::string plain = drawn("vibrocontact_web.csv", 0);
  const RevolvedSection as_drawn = section(wheel(plain, 0, {}));
  for (const double change : {6e-3, -4e-3})
  {
    const RevolvedSection moved = section(wheel(plain, change, {inner, outer})),
                          other = section(wheel(drawn("vibrocontact_thicker_web.csv", change), 0, {}));
    // volume 2 pi int r change sin^2 dr: half of the annulus by symmetry of sin^2
    const double more =
        ElasticMaterial().density * dealii::numbers::PI / 2 * (outer * outer - inner * inner) * change;
    EXPECT_NEAR(moved.mass() - as_drawn.mass(), more, 1e-5 * std::abs(more));
    for (const unsigned int n : {0, 2})
    {
      const std::vector<double> a = frequencies(moved, n), b = frequencies(other, n),
                                before = frequencies(as_drawn, n);
      for (unsigned int k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(a[k], b[k], 2e-4 * b[k]) << n << " waves, mode " << k << ", change " << change;
        if (k == 0)
          // a web that bends is the stiffer the thicker it is
          EXPECT_GT((a[k] - before[k]) / change, 0) << n << " waves";
      }
    }
  }
}

TEST(WebThickness, MovesNothingOutsideAndFollowsTheFacesWithin)
{
  WheelParameters parameters;
  parameters.model = "harmonics";
  parameters.web.change = 2e-3;
  const SectionOutline outline = parameters.section.read_outline();
  const auto moved = parameters.web_motion(outline, "wheel/Wheel");
  for (const double r : {0.1, 0.175, 0.37, 0.46})
    EXPECT_EQ(moved({0.01, r})[0], 0);
  // at the joint of both left arcs and lines, where the outline has its own points
  for (const SectionOutline::Row &row : outline.rows)
    for (const dealii::Point<2> &p : {row.start, row.end})
      if (p[1] > 0.176 && p[1] < 0.369)
      {
        const double share = std::pow(std::sin(dealii::numbers::PI * (p[1] - 0.175) / (0.37 - 0.175)), 2);
        EXPECT_NEAR(std::abs(moved(p)[0]), 1e-3 * share, 1e-9) << p;
        EXPECT_GT(moved(p)[0] * p[0], 0) << p;
        EXPECT_EQ(moved(p)[1], 0);
      }
}

TEST(WebThickness, WhatIsRefused)
{
  const std::string plain = drawn("vibrocontact_web.csv", 0);
  const auto says = [](const WheelParameters &parameters, const std::string &part)
  { EXPECT_NE(complaint(parameters).find(part), std::string::npos) << complaint(parameters); };
  says(wheel(plain, 1e-3, {}), "wheel/Wheel/Web thickness change is 0.001 m, but Web radii is empty");
  says(wheel(plain, 0, {0.2, 0.1}), "the smaller radius first");
  says(wheel(plain, 1e-3, {0.02, 0.2}), "leave the section: it has nothing at a radius of 0.02 m");
  says(wheel(plain, 1e-3, {0.1, 0.31}), "leave the section");
  says(wheel(plain, -0.0195, {inner, outer}), "leaves less than a tenth of the web, which is 0.02 m thick");
  WheelParameters shipped;
  shipped.model = "harmonics";
  shipped.web.change = 1e-3;
  shipped.web.radii = {0.2, 0.47};
  says(shipped, "reach the tread at 0.46 m");
  shipped.web.radii = {0.2, 0.4599};
  EXPECT_EQ(complaint(shipped), "");
  const std::string stepped = scratch_folder() + "/vibrocontact_stepped.csv";
  std::ofstream(stepped) << "-10, 60, 0, surface\n-10, 150, 0, surface\n-20, 150, 0, surface\n-20, 300, 0, "
                            "tread\n20, 300, 0, surface\n20, 150, 0, surface\n10, 150, 0, surface\n"
                            "10, 60, 0, bore\n";
  says(wheel(stepped, 1e-3, {0.1, 0.2}), "hold a step of the section at 0.15 m");
  const std::string twin = scratch_folder() + "/vibrocontact_twin.csv";
  std::ofstream(twin) << "-20, 60, 0, surface\n-20, 300, 0, tread\n20, 300, 0, surface\n20, 60, 0, bore\n"
                         "10, 60, 0, surface\n10, 250, 0, surface\n-10, 250, 0, surface\n-10, 60, 0, bore\n";
  says(wheel(twin, 1e-3, {0.1, 0.2}), "the section has 2 pieces at a radius of 0.1 m");
  EXPECT_EQ(complaint(wheel(stepped, 1e-3, {0.16, 0.2})), "");
}

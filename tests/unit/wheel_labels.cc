// Labels of a wheel's modes: every mode that the section's description names, on the wheel and on one twice
// as large.

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/reduction/wheel_labels.h>
#include <vibrocontact/scene/wheel.h>

#include <gtest/gtest.h>

#include <set>

using namespace vibrocontact;

namespace
{
  struct Named
  {
    double frequency;
    std::string label;
  };

  /// Labels near these frequencies of a coarse wheel: 14 cells round the tread, enough for six nodal
  /// diameters.
  void check_wheel(const double scale, const double upper_frequency, const std::vector<Named> &expected)
  {
    WheelParameters parameters;
    parameters.scale = scale;
    parameters.contact_division = parameters.coarse_division = 0.21 * scale;
    BodyMesh<3> mesh = make_wheel(parameters, 0, nullptr, "wheel", MPI_COMM_WORLD);
    ElasticModel<3> model;
    model.held.push_back(mesh.boundary_id("bore"));
    const ElasticBody<3> body(std::move(mesh), model, 2);
    const auto system = body.assemble();
    Flexibility flexibility(*system);
    ModeParameters mode_parameters;
    mode_parameters.upper_frequency = upper_frequency / scale;
    const Modes modes = compute_modes(*system, flexibility, mode_parameters);
    const auto labels = wheel_labels(*system, modes, WheelFrame{0.46 * scale, 0.385 * scale});
    const auto texts = unique_texts(labels);
    EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(), texts.size());
    const auto damping = wheel_damping(labels, mode_parameters);
    for (const auto &[frequency, label] : expected)
    {
      const auto found = std::find(texts.begin(), texts.end(), label);
      ASSERT_NE(found, texts.end()) << label;
      const unsigned int i = found - texts.begin(), n = labels[i].nodal_diameters;
      EXPECT_NEAR(modes.omega[i] / (2 * std::acos(-1.)) * scale / frequency, 1, 0.08) << label;
      EXPECT_EQ(damping[i], n == 0 ? 1e-3 : n == 1 ? 1e-2 : 1e-4);
      // the second of the pair follows
      if (n > 0)
        EXPECT_EQ(texts.at(i + 1), label + "#2");
    }
  }
} // namespace

TEST(WheelLabels, NamedModes)
{
  check_wheel(1, 3750,
              {{136.3, "axial(0,1)"},
               {197.6, "axial(0,0)"},
               {334.1, "axial(0,2)"},
               {510.7, "torsion(0,0)"},
               {918.0, "axial(0,3)"},
               {1670.1, "axial(0,4)"},
               {2515.8, "axial(0,5)"},
               {3278, "radial(1,5)"},
               {3413, "axial(0,6)"}});
}

TEST(WheelLabels, WheelTwiceAsLarge)
{
  check_wheel(2, 1000,
              {{136.3, "axial(0,1)"}, {334.1, "axial(0,2)"}, {510.7, "torsion(0,0)"}, {918.0, "axial(0,3)"}});
}

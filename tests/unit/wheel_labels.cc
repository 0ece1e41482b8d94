// Labels of a wheel's modes: every mode that the section's description names, on the wheel and on one twice
// as large.

#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/wheel_labels.h>
#include <vibrocontact/scene/wheel.h>

#include <gtest/gtest.h>

#include <set>

using namespace vibrocontact;

namespace
{
  struct Solved
  {
    std::unique_ptr<SecondOrderSystem> system;
    Modes modes;
  };

  /// Modes up to 1,800 Hz of a coarse wheel: 14 cells round the tread, enough for four nodal diameters.
  Solved solve_wheel()
  {
    WheelParameters parameters;
    parameters.contact_division = parameters.coarse_division = 0.21;
    BodyMesh<3> mesh = make_wheel(parameters, 0, nullptr, "wheel", MPI_COMM_WORLD);
    ElasticModel<3> model;
    model.held.push_back(mesh.boundary_id("bore"));
    const ElasticBody<3> body(std::move(mesh), model, 2);
    Solved solved;
    solved.system = assemble_body(body);
    Flexibility flexibility(*solved.system);
    ModeParameters wanted;
    wanted.upper_frequency = 1800;
    solved.modes = compute_modes(*solved.system, flexibility, wanted);
    return solved;
  }

  struct Named
  {
    double frequency;
    std::string label;
  };
} // namespace

TEST(WheelLabels, NamedModesOfTheWheelAndOfOneTwiceAsLarge)
{
  // Axial (0,5), radial (1,5) and axial (0,6), 2.5 to 3.4 kHz, are seen by
  // parameter_files/verification/wheel_frequencies.
  const std::vector<Named> expected = {{136.3, "axial(0,1)"}, {197.6, "axial(0,0)"},
                                       {334.1, "axial(0,2)"}, {510.7, "torsion(0,0)"},
                                       {918.0, "axial(0,3)"}, {1670.1, "axial(0,4)"}};
  Solved wheel = solve_wheel();
  const auto labels = wheel_labels(*wheel.system, wheel.modes, WheelFrame{0.46, 0.385});
  const auto texts = unique_texts(labels);
  EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(), texts.size());
  const auto damping = wheel_damping(labels, ModeParameters());
  for (const auto &[frequency, label] : expected)
  {
    const auto found = std::find(texts.begin(), texts.end(), label);
    ASSERT_NE(found, texts.end()) << label;
    const unsigned int i = found - texts.begin(), n = labels[i].nodal_diameters;
    EXPECT_NEAR(wheel.modes.omega[i] / (2 * dealii::numbers::PI) / frequency, 1, 0.06) << label;
    EXPECT_EQ(damping[i], n == 0 ? 1e-3 : n == 1 ? 1e-2 : 1e-4);
    // the second of the pair follows
    if (n > 0)
      EXPECT_EQ(texts.at(i + 1), label + "#2");
  }

  // A wheel twice as large has the same shapes at twice the distances: the same labels.
  for (auto &place : wheel.system->dof_position)
    place *= 2;
  EXPECT_EQ(unique_texts(wheel_labels(*wheel.system, wheel.modes, WheelFrame{0.92, 0.77})), texts);
}

TEST(WheelLabels, ScaledWheelIsSimilar)
{
  WheelParameters parameters;
  parameters.contact_division = parameters.coarse_division = 0.2;
  const BodyMesh<3> one = make_wheel(parameters, 0.01, nullptr, "wheel", MPI_COMM_WORLD);
  parameters.contact_division = parameters.coarse_division = 0.4;
  parameters.fine_length *= 2;
  parameters.scale = 2;
  const BodyMesh<3> two = make_wheel(parameters, 0.02, nullptr, "wheel", MPI_COMM_WORLD);
  const auto &a = one.triangulation->get_vertices(), &b = two.triangulation->get_vertices();
  ASSERT_EQ(a.size(), b.size());
  for (unsigned int i = 0; i < a.size(); ++i)
    EXPECT_LT((2. * a[i]).distance(b[i]), 1e-9);
}

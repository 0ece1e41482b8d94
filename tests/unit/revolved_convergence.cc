// Frequencies of the shipped wheel by harmonics, refined in the degree of the elements and in the size of the cells separately. Of
// all modes below 8 and 20 kHz those of some numbers of waves; parameter_files/verification/wheel_by_harmonics has all, with times.
#include <vibrocontact/base/log.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/scene/revolved_mesh.h>
#include <vibrocontact/scene/wheel.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  std::vector<double> frequencies(const unsigned int degree, const unsigned int halvings,
                                  const unsigned int n, const double limit)
  {
    run_log().set_screen(false);
    WheelParameters parameters;
    parameters.model = "harmonics";
    parameters.section.element_degree = degree;
    parameters.section.refinements = halvings;
    const std::vector<ContactPlace> none;
    const RevolvedMesh mesh = parameters.make_section({"wheel", 0., none, nullptr, {}, MPI_COMM_SELF});
    ElasticModel<3> model;
    model.held = {mesh.held};
    const RevolvedSection section("wheel", mesh.triangulation, model, mesh.degree);
    const auto system = section.system(n);
    Flexibility flexibility(*system);
    ModeParameters wanted;
    wanted.upper_frequency = limit;
    return compute_modes(*system, flexibility, wanted).omega;
  }

  double error(const std::vector<double> &found, const std::vector<double> &finest)
  {
    EXPECT_EQ(found.size(), finest.size());
    double worst = 0;
    for (unsigned int k = 0; k < std::min(found.size(), finest.size()); ++k)
      worst = std::max(worst, std::abs(found[k] / finest[k] - 1));
    return worst;
  }
} // namespace

// Cubic elements, the default, 0.02 %; both ways of refining them come ten times nearer.
TEST(RevolvedConvergence, To8kHz)
{
  for (const unsigned int n : {1, 6, 10})
  {
    const std::vector<double> finest = frequencies(4, 1, n, 8000);
    EXPECT_GE(finest.size(), 2u) << n;
    EXPECT_LT(error(frequencies(3, 0, n, 8000), finest), 2e-4) << n << " waves";
    EXPECT_LT(error(frequencies(4, 0, n, 8000), finest), 2e-5) << n << " waves, a degree more";
    EXPECT_LT(error(frequencies(3, 1, n, 8000), finest), 2e-5) << n << " waves, halved cells";
  }
}

TEST(RevolvedConvergence, To20kHz)
{
  for (const unsigned int n : {7, 20})
  {
    const std::vector<double> finest = frequencies(4, 1, n, 20000);
    EXPECT_GE(finest.size(), 3u) << n;
    EXPECT_LT(error(frequencies(3, 0, n, 20000), finest), 1e-3) << n << " waves";
    EXPECT_LT(error(frequencies(4, 0, n, 20000), finest), 2e-4) << n << " waves, a degree more";
  }
}

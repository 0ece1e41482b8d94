// Frequency response of a body of revolution: modes and Ritz vectors against direct solutions wave by wave, reciprocity, the
// static answer, and the same point seen from elsewhere around the axle.
#include <vibrocontact/analyses/frequency_response/revolved_response.h>
#include <vibrocontact/base/log.h>

#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  using Points = std::vector<RevolvedPoint>;

  /// A disc held at its bore, of a material with loss.
  RevolvedSection disc()
  {
    run_log().set_screen(false);
    const auto section = std::make_shared<dealii::Triangulation<2>>();
    dealii::GridGenerator::subdivided_hyper_rectangle(*section, {1u, 4u}, {-0.02, 0.05}, {0.02, 0.25}, true);
    ElasticModel<3> model;
    model.material.loss_factor = 0.01;
    model.held = {2};
    return RevolvedSection("disc", section, model, 2);
  }

  /// On the rim: over a patch of the tread (along z, x, y), then at a node of the side.
  Points points(const RevolvedSection &section, const double angle)
  {
    Points result(4);
    for (unsigned int k = 0; k < 4; ++k)
    {
      result[k].component = k % 3;
      result[k].angle = angle;
      if (k == 3)
      {
        result[k].rows = section.node({0.02, 0.15}, "a point");
        result[k].component = 2;
        continue;
      }
      result[k].half_angle = 0.1;
      for (const auto c : {RevolvedSection::axial, RevolvedSection::radial, RevolvedSection::circumferential})
        result[k].rows[c] = section.mean_over(3, -0.01, 0.01, c);
    }
    return result;
  }

  ModeParameters modes()
  {
    ModeParameters parameters;
    parameters.upper_frequency = 6000;
    parameters.damping_0 = 0.004;
    parameters.damping_1 = 0.01;
    parameters.damping_2 = 0.002;
    return parameters;
  }

  constexpr unsigned int n_waves = 12;
} // namespace

TEST(RevolvedResponse, ModesAndDirectSolutions)
{
  const RevolvedSection section = disc();
  const Points at = points(section, 0.3);
  RevolvedResponse response(section, at, modes(), n_waves, MPI_COMM_SELF);
  const std::vector<double> frequency = {0.1, 700, 1500, 3100};
  const auto direct = response.direct(frequency), modal = response.modal(true, 0, frequency);
  const unsigned int m = at.size();
  double worst = 0;
  for (unsigned int k = 0; k < frequency.size(); ++k)
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
      {
        const double size = std::sqrt(std::abs(direct[k][i * m + i]) * std::abs(direct[k][j * m + j]));
        EXPECT_LT(std::abs(direct[k][i * m + j] - direct[k][j * m + i]), 1e-10 * size) << "reciprocity";
        worst = std::max(worst, std::abs(modal[k][i * m + j] - direct[k][i * m + j]) / size);
      }
  EXPECT_LT(worst, 2e-3);
  EXPECT_GT(response.n_modes(0), 10u);
  RecordProperty("largest difference of modes", std::to_string(worst));
  // a mode fewer is seen
  const auto fewer = response.modal(true, 1000, {3100});
  EXPECT_GT(std::abs(fewer[0][0] - direct[3][0]), 1e-3 * std::abs(direct[3][0]));
}

// Forces along x and z at an angle are those at the contact, turned.
TEST(RevolvedResponse, TurnsAroundTheAxle)
{
  const RevolvedSection section = disc();
  const double angle = 1.1, c = std::cos(angle), s = std::sin(angle);
  const Points here = points(section, 0), there = points(section, angle);
  const auto a = RevolvedResponse(section, here, modes(), n_waves, MPI_COMM_SELF).direct({900})[0],
             b = RevolvedResponse(section, there, modes(), n_waves, MPI_COMM_SELF).direct({900})[0];
  // rows z, x, y, y: the normal there is (-sin, cos) in x and z, the tangent (cos, sin)
  const double turn[4][4] = {{c, s, 0, 0}, {-s, c, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int j = 0; j < 4; ++j)
    {
      std::complex<double> expected = 0;
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int l = 0; l < 4; ++l)
          expected += turn[i][k] * a[k * 4 + l] * turn[j][l];
      EXPECT_LT(std::abs(b[i * 4 + j] - expected), 1e-9 * std::abs(a[0])) << i << ", " << j;
    }
}

// Finite elements of a section in 2.5 dimensions: free waves of a round bar in closed form and of the shipped rail.

#include <vibrocontact/scene/section_parameters.h>
#include <vibrocontact/waveguide/plane_section.h>
#include <vibrocontact/waveguide/section_matrices.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

using namespace vibrocontact;
using dealii::numbers::PI;

namespace
{
  ElasticMaterial steel()
  {
    ElasticMaterial material;
    material.young_modulus = 205e9;
    material.poisson_ratio = 0.3;
    return material;
  }

  /// Pochhammer's and Chree's equation of axisymmetric waves of a bar of radius a (Graff, Wave motion in elastic solids,
  /// Eq. 8.2.37), between the speeds of shear and of pressure waves.
  double pochhammer_chree(const ElasticMaterial &material, const double a, const double k, const double omega)
  {
    const double cL = std::sqrt((material.lambda() + 2 * material.mu()) / material.density),
                 cT = std::sqrt(material.mu() / material.density),
                 alpha = std::sqrt(k * k - std::pow(omega / cL, 2)),
                 beta = std::sqrt(std::pow(omega / cT, 2) - k * k);
    const double I0 = std::cyl_bessel_i(0, alpha * a), I1 = std::cyl_bessel_i(1, alpha * a),
                 J0 = std::cyl_bessel_j(0, beta * a), J1 = std::cyl_bessel_j(1, beta * a);
    return -2 * alpha / a * (beta * beta + k * k) * I1 * J1 - std::pow(beta * beta - k * k, 2) * I0 * J1 +
           4 * k * k * alpha * beta * I1 * J0;
  }

  double nearest(const std::vector<FreeWave> &waves, const double target)
  {
    double result = 0;
    for (const FreeWave &wave : waves)
      if (std::abs(wave.frequency - target) < std::abs(result - target))
        result = wave.frequency;
    return result;
  }
} // namespace

TEST(SectionWaves, round_bar_in_closed_form)
{
  const double a = 0.03;
  dealii::Triangulation<2> disc;
  dealii::GridGenerator::hyper_ball_balanced(disc, {}, a);
  const double cT = std::sqrt(steel().mu() / steel().density),
               bar = std::sqrt(steel().young_modulus / steel().density);
  double coarser = 0;
  for (const unsigned int degree : {2, 3, 4})
  {
    const SectionElements elements(disc, {steel()}, degree);
    const SectionMatrices section = reduced_section(elements, all_shapes(elements));
    // second torsional wave: J2(a sqrt(omega^2 / cT^2 - k^2)) = 0
    const double k = 40, second = cT * std::hypot(k, 5.135622301840683 / a) / (2 * PI),
                 error = std::abs(nearest(free_waves(section, k, 100e3), second) / second - 1);
    std::cout << "degree " << degree << ": second torsional wave off by " << error << std::endl;
    if (degree > 2)
      EXPECT_LT(error, coarser / 10);
    coarser = error;
  }
  const SectionElements elements(disc, {steel()}, 4);
  const SectionMatrices section = reduced_section(elements, all_shapes(elements));
  EXPECT_NEAR(elements.area / (PI * a * a), 1, 1e-6);
  for (const double k : {10., 40.})
  {
    const auto waves = free_waves(section, k, 35e3);
    EXPECT_NEAR(nearest(waves, k * cT / (2 * PI)) / (k * cT / (2 * PI)), 1, 1e-6);
    double low = 0.9 * bar * k, high = 1.005 * bar * k;
    ASSERT_LT(pochhammer_chree(steel(), a, k, low) * pochhammer_chree(steel(), a, k, high), 0);
    for (unsigned int step = 0; step < 60; ++step)
    {
      const double middle = (low + high) / 2;
      (pochhammer_chree(steel(), a, k, low) * pochhammer_chree(steel(), a, k, middle) > 0 ? low : high) =
          middle;
    }
    EXPECT_NEAR(nearest(waves, low / (2 * PI)) / (low / (2 * PI)), 1, 1e-6);
    std::cout << "k " << k << "/m: longitudinal " << nearest(waves, low / (2 * PI)) << " Hz, closed form "
              << low / (2 * PI) << std::endl;
  }
  // The group velocity of each wave is the slope of its frequency over k.
  const double k = 40, step = 0.01;
  const auto before = free_waves(section, k - step, 30e3), at = free_waves(section, k, 30e3),
             after = free_waves(section, k + step, 30e3);
  ASSERT_EQ(before.size(), after.size());
  ASSERT_EQ(before.size(), at.size());
  for (unsigned int j = 0; j < at.size(); ++j)
    EXPECT_NEAR(PI * (after[j].frequency - before[j].frequency) / step, at[j].group_velocity, 0.02);
}

// Half a wave between two supports: the numbers of an independent program on the same outline. The shipped mesh of quadratic
// elements cuts the fillets of the foot, 0.02 % of the area, and is 0.2 % too stiff in torsion.
TEST(SectionWaves, free_rail_between_its_supports)
{
  const SectionParameters parameters("rail_60e1", {"foot", "crown"});
  const SectionOutline outline = parameters.read_outline();
  const auto mesh = plane_section(parameters.read_mesh(outline, true, {"rail", {}}), outline);
  const SectionElements elements(*mesh, {steel()}, 2);
  const SectionMatrices section = reduced_section(elements, all_shapes(elements));
  EXPECT_NEAR(elements.area / 76.71e-4, 1, 5e-4);
  const auto waves = free_waves(section, PI / 0.6, 3000);
  for (const double known : {499., 828., 1053.})
  {
    std::cout << known << " Hz: " << nearest(waves, known) << std::endl;
    EXPECT_NEAR(nearest(waves, known) / known, 1, 3e-3);
  }
}

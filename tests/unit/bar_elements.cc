// The bar of 1-D elements: frequencies and flexibilities in closed form, free and held, on any number of
// ranks.

#include "pi.h"

#include <vibrocontact/fe/bar_elements.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

TEST(BarElementsMpi, FrequenciesAndTipFlexibility)
{
  ElasticMaterial material;
  material.young_modulus = 900;
  material.poisson_ratio = 0;
  material.density = 1;
  BarParameters bar;
  bar.length = 10;
  bar.section = 2;
  bar.divisions = 40;
  bar.degree = 4;
  ContactGrid grid;
  grid.n_x = grid.n_y = 1;
  grid.spacing_x = grid.spacing_y = std::sqrt(bar.section);
  const double c = 30;
  for (const std::string far_end : {"held", "free"})
  {
    bar.far_end = far_end;
    const bool free = far_end == "free";
    const auto system = assemble_bar(bar, material, "bar", true, &grid, MPI_COMM_WORLD);
    Flexibility flexibility(*system);
    // held: L / (E S); free, inertia relief: L / (3 E S)
    const double expected = bar.length / (material.young_modulus * bar.section) / (free ? 3 : 1);
    EXPECT_NEAR(flexibility.contact_compliance()(0, 0) / expected, 1, 1e-10);
    ModeParameters parameters;
    parameters.count = 20;
    const Modes modes = compute_modes(*system, flexibility, parameters);
    ASSERT_EQ(modes.n_rigid_modes, free ? 1u : 0u);
    for (unsigned int k = modes.n_rigid_modes; k < modes.omega.size(); ++k)
      EXPECT_NEAR(modes.omega[k] / ((free ? k : k + 0.5) * pi * c / bar.length), 1, 1e-6) << k;
    EXPECT_NEAR(std::abs(contact_trace(system->trace, modes.shapes.back())[0]),
                std::sqrt(2 / (material.density * bar.section * bar.length)), 1e-5);
  }
}

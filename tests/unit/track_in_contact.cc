// A periodic rail at the points of a contact: what the choices of its reduction change.

#include <vibrocontact/waveguide/track_in_contact.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>

using namespace vibrocontact;
using dealii::numbers::PI;

namespace
{
  BodyParameters rail_body()
  {
    BodyParameters body("rail", "rail");
    body.material.young_modulus = 205e9;
    body.material.poisson_ratio = 0.3;
    body.material.density = 7800;
    body.material.loss_factor = 0.02;
    return body;
  }

  ContactGrid grid_of(const unsigned int n_x, const unsigned int n_y, const double spacing)
  {
    ContactGrid grid;
    grid.n_x = n_x;
    grid.n_y = n_y;
    grid.spacing_x = grid.spacing_y = spacing;
    grid.x_first = -0.5 * (n_x - 1) * spacing;
    grid.y_first = -0.5 * (n_y - 1) * spacing;
    return grid;
  }

  double largest(const DenseMatrix &A)
  {
    double value = 0;
    for (unsigned int j = 0; j < A.n(); ++j)
      for (unsigned int i = 0; i < A.m(); ++i)
        value = std::max(value, std::abs(A(i, j)));
    return value;
  }

  double distance(const DenseMatrix &A, const DenseMatrix &B)
  {
    DenseMatrix difference = A;
    difference.add(-1., B);
    return largest(difference) / largest(B);
  }
} // namespace

TEST(TrackInContact, CompliancePastTheSectionsWavesIsTheHalfSpaces)
{
  // where the section hands over to the half-space hardly matters, more for elements that are too stiff for short waves
  RailParameters rail;
  rail.section.element_degree = 3;
  const BodyParameters body = rail_body();
  const RailSection section(body, rail);
  const ContactGrid grid = grid_of(7, 5, 2e-3);
  const auto compliance = [&](const double shortest) {
    return crown_compliance(section.elements, {{1e9, 1e9, 4e9}}, 0, grid, {205e9, 0.3}, {shortest, 6});
  };
  const DenseMatrix W = compliance(80), shorter = compliance(160), longer = compliance(60);
  std::cout << "change of the largest entry, 160 and 60 instead of 80 rad/m: " << distance(shorter, W) << ", "
            << distance(longer, W) << std::endl;
  EXPECT_LT(distance(shorter, W), 4e-3);
  EXPECT_LT(distance(longer, W), 2e-3);
}

TEST(TrackInContact, SmoothPartDoesNotDependOnThePatch)
{
  RailParameters rail;
  rail.model = "periodic";
  rail.contact_at = "support";
  const BodyParameters body = rail_body();
  TrackInContact::Settings settings;
  const TrackInContact small(body, rail, grid_of(7, 5, 2e-3), settings),
      large(body, rail, grid_of(11, 9, 2e-3), settings);
  // waves grow shorter against the patch
  for (const auto &[frequency, limit] : {std::pair(334., 0.005), {1061., 0.015}, {3414., 0.05}})
  {
    const ComplexMatrix one = small.receptance(2 * PI * frequency),
                        other = large.receptance(2 * PI * frequency);
    for (unsigned int d = 0; d < 3; ++d)
    {
      // beyond the rail on its bed, over what the track does as a whole
      const double change = std::abs(one(d, d) - small.on_bed()(d, d) - other(d, d) + large.on_bed()(d, d)) /
                            std::abs(other(d, d));
      std::cout << frequency << " Hz, direction " << d << ": " << change << std::endl;
      EXPECT_LT(change, limit);
    }
    // it takes energy, and what it does is reciprocal
    EXPECT_LT(one(2, 2).imag(), 0);
    EXPECT_LT(std::abs(one(1, 3) - one(3, 1)), 1e-12 * std::abs(one(1, 1)));
  }
}

TEST(TrackInContact, SupportsLaidOneByOneCarryTheContact)
{
  // without scatter they are the periodic track but for the shapes far from the contact; with scatter, on sleepers that bend and
  // on a slab the contact sees the difference
  RailParameters rail;
  rail.model = "periodic";
  rail.section.element_degree = 1;
  const BodyParameters body = rail_body();
  TrackInContact::Settings settings;
  const ContactGrid grid = grid_of(5, 5, 2e-3);
  const TrackInContact even(body, rail, grid, settings);
  RailParameters laid = rail, slab = rail, sleepers = rail;
  laid.track.n_supports = 4;
  RailParameters random = laid;
  random.track.pad_scatter = 0.3;
  slab.track.slab_mass = 1150;
  sleepers.track.sleeper_mass = 150;
  sleepers.track.ballast_stiffness_x = sleepers.track.ballast_stiffness_y = 30e6;
  sleepers.track.ballast_stiffness_z = 50e6;
  sleepers.track.sleeper_model = "beam";
  const std::complex<double> omega(2 * PI * 918, -20);
  const ComplexMatrix R = even.receptance(omega);
  const auto off = [&](const RailParameters &other)
  {
    const TrackInContact track(body, other, grid, settings);
    EXPECT_LT(distance(track.on_bed(), even.on_bed()), 1e-3);
    const ComplexMatrix other_R = track.receptance(omega);
    double worst = 0;
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        worst = std::max(worst, std::abs(other_R(i, j) - R(i, j)) / std::sqrt(std::abs(R(i, i) * R(j, j))));
    std::cout << "at rest " << distance(track.at_rest(), even.at_rest()) << ", moving " << worst << std::endl;
    return std::array<double, 2>{{distance(track.at_rest(), even.at_rest()), worst}};
  };
  const auto without_scatter = off(laid);
  EXPECT_LT(without_scatter[0], 1e-3);
  EXPECT_LT(without_scatter[1], 0.015);
  for (const RailParameters &other : {random, slab, sleepers})
    EXPECT_GT(off(other)[0], 0.01);
}

TEST(TrackInContact, KnownShapesAreTakenForTheSameDofsAlone)
{
  RailParameters rail;
  rail.section.element_degree = 1;
  const TrackInContact::Settings settings;
  const ContactGrid grid = grid_of(3, 3, 5e-3);
  const TrackInContact found(rail_body(), rail, grid, settings);
  SectionShapes known = found.shapes();
  EXPECT_FALSE(known.dofs.empty());
  const TrackInContact taken(rail_body(), rail, grid, settings, &known);
  // shapes of other dofs would be those of another rail
  known.dofs = "others";
  known.shapes *= 2.;
  known.shapes(0, 0) += 1;
  const TrackInContact anew(rail_body(), rail, grid, settings, &known);
  EXPECT_EQ(distance(taken.at_rest(), found.at_rest()), 0);
  EXPECT_EQ(distance(anew.at_rest(), found.at_rest()), 0);
}

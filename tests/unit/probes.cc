// Probes: reading the entry, finding the nearest point of a surface, the rim of a wheel.

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/marching/probes.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  /// A unit square in the plane z = 1 of 2 x 2 quads with two modes: u_z = x + 3 y, u_x = 2 - y.
  SurfaceShapes square()
  {
    SurfaceShapes s;
    s.omega = {1, 2};
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int i = 0; i < 3; ++i)
        s.points.insert(s.points.end(), {i / 2., j / 2., 1.});
    for (const int corner : {0, 1, 3, 4})
      s.quads.insert(s.quads.end(), {corner, corner + 1, corner + 4, corner + 3});
    for (unsigned int i = 0; i < 9; ++i)
      s.shapes.insert(s.shapes.end(), {0.f, 0.f, float(s.point(i)[0] + 3 * s.point(i)[1])});
    for (unsigned int i = 0; i < 9; ++i)
      s.shapes.insert(s.shapes.end(), {float(2 - s.point(i)[1]), 0.f, 0.f});
    return s;
  }
} // namespace

TEST(Probes, NearestPointAndLinearInterpolation)
{
  const SurfaceShapes surface = square();
  ProbeRequest request;
  request.name = "p";
  request.body = "plate";
  request.direction[2] = 1;
  request.place = dealii::Point<3>(0.3, 0.8, 1.05);
  const Probe inside = place_probe(request, surface, 1);
  EXPECT_NEAR(inside.place.distance(dealii::Point<3>(0.3, 0.8, 1)), 0, 1e-14);
  EXPECT_NEAR(inside.shape[0], 0.3 + 3 * 0.8, 1e-6);
  EXPECT_NEAR(inside.shape[1], 0, 1e-6);
  // beyond an edge, and beyond a corner
  request.place = dealii::Point<3>(0.4, -0.05, 1);
  EXPECT_NEAR(place_probe(request, surface, 0).shape[0], 0.4, 1e-6);
  request.place = dealii::Point<3>(1.02, 1.03, 0.97);
  request.direction = dealii::Tensor<1, 3>({0.6, 0, 0.8});
  const Probe corner = place_probe(request, surface, 0);
  EXPECT_NEAR(corner.shape[0], 0.8 * 4, 1e-6);
  EXPECT_NEAR(corner.shape[1], 0.6 * 1, 1e-6);
  // its modes begin behind those of another body
  DynamicState state;
  state.q = {100, 2, 5};
  state.v = {100, -1, 1};
  EXPECT_NEAR(inside.displacement(state), 2 * 2.7, 1e-5);
  EXPECT_NEAR(inside.velocity(state), -2.7, 1e-5);
  request.place = dealii::Point<3>(0.5, 0.5, 1.2);
  EXPECT_THROW(place_probe(request, surface, 0), InputError);
}

TEST(Probes, Reading)
{
  const auto probes = parse_probes(" rim ; head: rail 0.3 -1e-2 0 along z;web:wheel 0 0 .25 along 3 0 4; ");
  ASSERT_EQ(probes.size(), 3u);
  EXPECT_EQ(probes[0].name, "");
  EXPECT_EQ(probes[1].name + "@" + probes[1].body, "head@rail");
  EXPECT_EQ(probes[1].place, dealii::Point<3>(0.3, -0.01, 0));
  EXPECT_EQ(probes[1].direction[2], 1);
  EXPECT_NEAR(probes[2].direction[0], 0.6, 1e-15);
  EXPECT_TRUE(parse_probes("").empty());
  for (const char *const wrong :
       {"head", "head: rail 0 0 along z", "head: rail 0 0 0 along w", "head: rail 0 0 0 along 0 0 0",
        "head: rail a 0 0 along z", "a: rail 0 0 0 along z; a: rail 1 0 0 along z",
        "head: rail 0 0 nan along z"})
    EXPECT_THROW(parse_probes(wrong), InputError) << wrong;
}

TEST(Probes, RimOfAWheel)
{
  // rings of points: field-side face of the rim (radii 0.40 and 0.45, y = 0.06), flange side, web
  SurfaceShapes wheel;
  const double height = 0.46;
  for (const auto &[radius, y] :
       {std::pair(0.40, 0.06), std::pair(0.45, 0.06), std::pair(0.42, -0.08), std::pair(0.2, 0.09)})
    for (unsigned int k = 0; k < 36; ++k)
    {
      const double angle = k * dealii::numbers::PI / 18;
      wheel.points.insert(wheel.points.end(),
                          {radius * std::sin(angle), y, height - radius * std::cos(angle)});
    }
  const auto probes = rim_probes("wheel", wheel, height, 0.385);
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_EQ(probes[0].name, "wheel_rim_axial");
  EXPECT_NEAR(probes[0].place.distance(dealii::Point<3>(0, 0.06, height - 0.425)), 0, 1e-12);
  EXPECT_EQ(probes[0].direction[1], 1);
  EXPECT_EQ(probes[1].direction[2], -1); // away from the axle, below it
}

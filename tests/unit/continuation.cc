// Curves R(x, p) = 0 by pseudo-arc-length. Truth: closed forms of the curve, its folds, kinks and branch points.

#include "plane_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace vibrocontact;

namespace
{
  std::vector<CurvePoint> special(const Curve &curve, const CurvePoint::Kind kind)
  {
    std::vector<CurvePoint> result;
    for (const CurvePoint &point : curve.points)
      if (point.kind == kind)
        result.push_back(point);
    return result;
  }
} // namespace

TEST(Continuation, CircleIsClosedWithTwoFolds)
{
  Plane circle;
  circle.value = [](double x, double p) { return x * x + p * p - 1; };
  circle.by_unknown = [](double x, double) { return 2 * x; };
  circle.by_parameter = [](double, double p) { return 2 * p; };
  circle.event = [](double x, double) { return x - 0.5; };
  for (const int direction : {-1, 1})
  {
    ContinuationSettings settings;
    settings.location_tolerance = 1e-10;
    settings.direction = direction;
    const Curve curve = continue_curve(circle, start_at(0.9, 0.3), settings);
    EXPECT_EQ(curve.end, Curve::End::closed);
    const auto folds = special(curve, CurvePoint::Kind::fold),
               events = special(curve, CurvePoint::Kind::event);
    ASSERT_EQ(folds.size(), 2u);
    EXPECT_NEAR(folds[0].p, direction, 1e-10);
    EXPECT_NEAR(folds[1].p, -direction, 1e-10);
    ASSERT_EQ(events.size(), 2u);
    EXPECT_NEAR(std::abs(events[0].p), std::sqrt(0.75), 1e-9);
    for (const CurvePoint &point : curve.points)
      EXPECT_NEAR(std::hypot(point.x[0], point.p), 1, 1e-9);
  }
}

// What comes back through its begin the other way, or passes close by, is not closed.
TEST(Continuation, OnlyALoopIsClosed)
{
  // x = 0 up to p = 1 and nothing beyond, where the derivatives promise that the way back goes on
  Plane dead_end;
  dead_end.which = [](double, double p) -> std::size_t { return p < 1 ? 0 : 1; };
  dead_end.by_unknown = [](double, double p) { return p < 1 ? 1. : -1.; };
  dead_end.by_parameter = [](double, double) { return 0.; };
  dead_end.value = [](double x, double p) { return p < 1 ? x : 1 + x * x; };
  for (const double p_min : {-1., 0., 0.5})
  {
    ContinuationSettings settings;
    settings.p_min = p_min;
    settings.p_max = 2;
    const Curve curve = continue_curve(dead_end, start_at(0, 0.5), settings);
    EXPECT_EQ(curve.end, Curve::End::turned_back) << curve.reason();
    EXPECT_NEAR(curve.points.back().p, 1, 1e-6);
    for (std::size_t k = 1; k < curve.points.size(); ++k)
      EXPECT_GT(curve.points[k].p, curve.points[k - 1].p);
  }

  // a spiral r = 1 + phi / 1000 passes its begin at 1 % of the radius, a circle with the same kinks is closed
  for (const double pitch : {1e-3, 0.})
  {
    Plane spiral;
    const auto angle = [](double x, double p) { return std::atan2(x, p); };
    double last = 0;
    const auto unwound = [&](double x, double p)
    {
      const double now = angle(x, p);
      return now + 2 * M_PI * std::round((last - now) / (2 * M_PI));
    };
    spiral.value = [&](double x, double p) { return std::hypot(x, p) - 1 - pitch * (last = unwound(x, p)); };
    spiral.by_unknown = [&](double x, double p)
    { return x / std::hypot(x, p) - pitch * p / (x * x + p * p); };
    spiral.by_parameter = [&](double x, double p)
    { return p / std::hypot(x, p) + pitch * x / (x * x + p * p); };
    ContinuationSettings settings;
    settings.max_points = 200;
    const Curve curve = continue_curve(spiral, start_at(0.9, 0.3), settings);
    EXPECT_EQ(curve.end, pitch > 0 ? Curve::End::most_points : Curve::End::closed) << curve.reason();
  }
}

// A begin next to a fold: the fold stands once, the last point is the first.
TEST(Continuation, NothingTwiceInALoop)
{
  Plane circle;
  circle.value = [](double x, double p) { return x * x + p * p - 1; };
  circle.by_unknown = [](double x, double) { return 2 * x; };
  circle.by_parameter = [](double, double p) { return 2 * p; };
  circle.event = [](double x, double) { return x; };
  for (const double ahead : {1e-3, 1e-2, 0.05})
  {
    ContinuationSettings settings;
    const Curve curve = continue_curve(circle, start_at(std::sin(ahead), std::cos(ahead)), settings);
    EXPECT_EQ(curve.end, Curve::End::closed);
    EXPECT_EQ(special(curve, CurvePoint::Kind::fold).size(), 2u) << ahead;
    EXPECT_EQ(special(curve, CurvePoint::Kind::event).size(), 2u) << ahead;
    EXPECT_EQ(curve.points.front().p, curve.points.back().p);
  }
}

TEST(Continuation, CubicFoldsInScaledUnknownsAndFromAnyPoint)
{
  // p = 1e3 (z^3 - z), x = 1e6 z: folds at z = -+1/sqrt(3)
  Plane cubic;
  cubic.value = [](double x, double p) { return p - 1e3 * (std::pow(x / 1e6, 3) - x / 1e6); };
  cubic.by_unknown = [](double x, double) { return -1e3 * (3 * std::pow(x / 1e6, 2) - 1) / 1e6; };
  cubic.by_parameter = [](double, double) { return 1.; };
  ContinuationSettings settings;
  settings.x_scale = 1e6;
  settings.p_scale = settings.residual_scale = 1e3;
  settings.p_min = -6e3;
  settings.p_max = 6e3;
  settings.location_tolerance = 1e-6;
  const Curve curve = continue_curve(cubic, start_at(-2e6, -6e3), settings);
  EXPECT_EQ(curve.end, Curve::End::parameter_limit);
  EXPECT_NEAR(curve.points.back().x[0], 2e6, 1e-2);
  const auto folds = special(curve, CurvePoint::Kind::fold);
  ASSERT_EQ(folds.size(), 2u);
  EXPECT_NEAR(folds[0].p, 2e3 / std::pow(3, 1.5), 2e-6);
  EXPECT_NEAR(folds[1].p, -2e3 / std::pow(3, 1.5), 2e-6);
  // from the middle of the curve on
  const Curve rest = continue_curve(cubic, curve.points[curve.points.size() / 2], settings);
  EXPECT_EQ(rest.end, Curve::End::parameter_limit);
  EXPECT_NEAR(rest.points.back().x[0], 2e6, 1e-2);
}

TEST(Continuation, TurnsSharplyAtKinks)
{
  // p = 10 x up to x = 1, then 20 - 10 x, from x = 2 on 10 (x - 2): the tangent turns by 169 degrees twice
  Plane zigzag;
  zigzag.which = [](double x, double) -> std::size_t { return x < 1 ? 0 : x < 2 ? 1 : 2; };
  const auto g = [](double x) { return x < 1 ? 10 * x : x < 2 ? 20 - 10 * x : 10 * (x - 2); };
  zigzag.value = [g](double x, double p) { return p - g(x); };
  zigzag.by_unknown = [](double x, double) { return x >= 1 && x < 2 ? 10. : -10.; };
  zigzag.by_parameter = [](double, double) { return 1.; };
  ContinuationSettings settings;
  settings.p_max = 25;
  settings.location_tolerance = 1e-3;
  const Curve curve = continue_curve(zigzag, start_at(-1, -10), settings);
  EXPECT_EQ(curve.end, Curve::End::parameter_limit);
  EXPECT_NEAR(curve.points.back().x[0], 4.5, 1e-9);
  const auto folds = special(curve, CurvePoint::Kind::fold);
  ASSERT_EQ(folds.size(), 2u);
  EXPECT_NEAR(folds[0].p, 10, 2e-3);
  EXPECT_NEAR(folds[1].p, 0, 2e-3);
}

TEST(Continuation, PassesBranchPointsStraightOn)
{
  // x (x - p) = 0 from the left on x = 0
  Plane cross;
  cross.value = [](double x, double p) { return x * (x - p); };
  cross.by_unknown = [](double x, double p) { return 2 * x - p; };
  cross.by_parameter = [](double x, double) { return -x; };
  ContinuationSettings settings;
  settings.p_max = 1;
  const Curve curve = continue_curve(cross, start_at(0, -1.003), settings);
  EXPECT_EQ(curve.end, Curve::End::parameter_limit);
  EXPECT_NEAR(curve.points.back().x[0], 0, 1e-12);
  EXPECT_EQ(special(curve, CurvePoint::Kind::fold).size(), 0u);
}

TEST(Continuation, SaysWhyItStops)
{
  Plane none;
  none.value = [](double x, double p) { return x * x + p * p + 1; };
  none.by_unknown = [](double x, double) { return 2 * x; };
  none.by_parameter = [](double, double p) { return 2 * p; };
  EXPECT_EQ(continue_curve(none, start_at(1, 1), {}).end, Curve::End::no_start);

  // the curve ends at x = 1: nothing beyond
  Plane ends;
  ends.value = [](double x, double p) { return x < 1 ? x - p : std::nan(""); };
  ends.by_unknown = [](double, double) { return 1.; };
  ends.by_parameter = [](double, double) { return -1.; };
  const Curve curve = continue_curve(ends, start_at(0, 0), {});
  EXPECT_EQ(curve.end, Curve::End::step_too_small);
  EXPECT_NEAR(curve.points.back().x[0], 1, 1e-6);
  ContinuationSettings few;
  few.max_points = 3;
  EXPECT_EQ(continue_curve(ends, start_at(0, 0), few).end, Curve::End::most_points);
}

// p = a sin(x / a) turns at each half wave and goes nowhere in p. Where the waves are short no step makes way, and the curve is
// given up; longer ones are followed to the end.
TEST(Continuation, CurvesThatMakeNoWayAreGivenUp)
{
  for (const double a : {1e-6, 0.05})
  {
    Plane waves;
    waves.value = [a](double x, double p) { return p - a * std::sin(x / a); };
    waves.by_unknown = [a](double x, double) { return -std::cos(x / a); };
    waves.by_parameter = [](double, double) { return 1.; };
    ContinuationSettings settings;
    settings.max_points = 2000;
    const Curve curve = continue_curve(waves, start_at(0, 0), settings);
    if (a < 1e-3)
    {
      EXPECT_EQ(curve.end, Curve::End::stalled) << curve.reason();
      EXPECT_LT(curve.points.size(), 400u);
    }
    else
      EXPECT_EQ(curve.end, Curve::End::most_points) << curve.reason();
    for (const CurvePoint &fold : special(curve, CurvePoint::Kind::fold))
      EXPECT_NEAR(std::abs(fold.p), a, 1e-6);
  }
}

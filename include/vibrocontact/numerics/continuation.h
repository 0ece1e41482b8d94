#pragma once

#include <vibrocontact/base/dense.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// n equations R(x, p) = 0 in n unknowns and a parameter, as continue_curve() sees them.
  class CurveEquations
  {
  public:
    virtual ~CurveEquations() = default;

    /// R, and unless null dR/dx and dR/dp
    virtual void evaluate(const std::vector<double> &x, double p, std::vector<double> &residual,
                          DenseMatrix *by_x, std::vector<double> *by_p) = 0;
    /// smooth piece of a piecewise smooth R that the last evaluate() met: any number that changes with it
    virtual std::size_t piece() const { return 0; }
    /// functions whose zeros along the curve are wanted
    virtual std::vector<double> events(const std::vector<double> &, double) { return {}; }
  };

  struct CurvePoint
  {
    enum class Kind
    {
      regular,
      fold,
      event,
      branch_point
    } kind = Kind::regular;
    std::vector<double> x;
    double p = 0;
    /// unit vector along y; its last entry dp/ds changes sign at folds. Empty: unknown
    std::vector<double> tangent;
    /// sign of det[dR/dx, dR/dp; tangent], constant along a curve but for branch points
    int orientation = 0;
    std::size_t piece = 0;
    /// which of events()
    unsigned int event = 0;
    /// arc length to this point from the one before, Newton's steps to it
    double step = 0;
    unsigned int iterations = 0;
  };

  /// Lengths are those of y = (x / x_scale, p / p_scale).
  struct ContinuationSettings
  {
    double x_scale = 1, p_scale = 1, residual_scale = 1;
    /// the curve ends on these
    double p_min = -1e300, p_max = 1e300;
    /// arc lengths
    double first_step = 1e-2, min_step = 1e-9, max_step = 0.2;
    /// steps shorter than that may turn by any angle: there is a kink
    double kink_step = 1e-4;
    /// largest angle between tangents of neighbours [rad]
    double max_angle = 0.3;
    /// |R| / residual_scale
    double tolerance = 1e-10;
    unsigned int max_newton = 8, max_points = 5000;
    /// a curve that comes no farther than a tenth of max_step by so many points has lost its way
    unsigned int most_stalled = 300;
    /// of p at folds and events
    double location_tolerance = 1e-6;
    /// sign of dp at the start, unless the start has a tangent
    int direction = 1;
    /// largest change of p on from a point, for what x does not show; null: any
    std::function<double(const CurvePoint &)> longest_change;
  };

  struct Curve
  {
    enum class End
    {
      parameter_limit,
      closed,
      /// it goes back on itself: where nothing was found ahead but the way it came, or through its begin
      turned_back,
      most_points,
      stalled,
      step_too_small,
      no_start
    } end = End::no_start;
    /// in order; folds and events stand where they lie
    std::vector<CurvePoint> points;
    /// steps refused
    unsigned int refused = 0;
    std::string reason() const;
  };

  /// Follows the curve R(x, p) = 0 by pseudo-arc-length (Keller 1977; Allgower & Georg, Introduction to Numerical
  /// Continuation Methods, 2003): from y0 along the unit tangent t, Newton's method on
  ///
  ///   R(y) = 0,  t (y - y0) = ds
  ///
  /// ds grows where few steps of Newton's method were needed, is halved where it fails or where the tangent turns by more than
  /// max_angle. The tangent is oriented along its predecessor. Where R has kinks the curve may turn by more
  /// than a right angle; there no point lies ahead, the step shrinks to kink_step, and the tangent of the smooth piece
  /// ahead is tried instead, oriented so that the sign of det[R_x, R_p; t] stays (the degree of a piecewise
  /// smooth map, ibid. chapter 15). A smooth change of that sign is a branch point and is passed straight on.
  ///
  /// A curve is closed if it comes through its begin in the direction in which it left. One that would pass a point in the
  /// direction it came from (the same smooth piece, where det[R_x, R_p; t] changes its sign with t) is no other part of the curve:
  /// steps that do so are refused, and what ends with them ends as turned_back, without the points of the way back.
  ///
  /// Where R is as rough as its samples the curve may turn at each of them and creep; it then ends as stalled.
  ///
  /// Folds (dp/ds = 0) and zeros of events() between two points are located by bisection and secants on ds. Never throws for
  /// want of convergence: see Curve::end.
  /// @param start corrected at fixed p if it has no tangent; a point of an earlier curve goes on where that was
  Curve continue_curve(CurveEquations &equations, const CurvePoint &start,
                       const ContinuationSettings &settings);
} // namespace vibrocontact

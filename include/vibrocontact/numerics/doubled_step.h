#pragma once

namespace vibrocontact
{
  /// Relative error of a number X(h) that a march in time has found with steps of h, from the same number of a
  /// march with steps of 2 h beside it [-]:
  ///
  ///   X(h) - X = C h^p,   X(2h) - X = C (2h)^p   ->   |X(h) - X| = |X(2h) - X(h)| / (2^p - 1)
  ///
  /// The divisor is 1 for first order and 3 for second; which of them rules a march with impacts and friction
  /// depends on the run. sqrt(3) is right within a factor of sqrt(3) for both. Relative to the larger of both
  /// numbers, 0 if both are 0. Not finite numbers give infinity.
  double doubled_step_error(double fine, double coarse);

  /// The same relative to a size [unit of X] that both numbers may be a small part of; 0 if that is 0.
  double doubled_step_error_of(double fine, double coarse, double size);

  /// The same as the first with a third march in steps of 4 h, of X(h) - X = a h + b h^2, whatever a and b are:
  ///
  ///   X(h) - X = 1/3 [X(2h) - X(4h)] - 5/3 [X(h) - X(2h)]
  ///
  /// but not below half of what the first two tell, where both differences happen to cancel.
  double doubled_step_error(double fine, double coarse, double coarsest);
} // namespace vibrocontact

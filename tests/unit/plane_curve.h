/// One equation in the plane, for tests of continuation.
#pragma once

#include <vibrocontact/numerics/continuation.h>

#include <functional>

namespace vibrocontact
{
  /// One equation by functions of (x, p).
  struct Plane : CurveEquations
  {
    std::function<double(double, double)> value, by_unknown, by_parameter, event;
    std::function<std::size_t(double, double)> which = [](double, double) { return 0; };
    std::size_t met = 0;

    void evaluate(const std::vector<double> &x, double p, std::vector<double> &residual, DenseMatrix *by_x,
                  std::vector<double> *by_p) override
    {
      residual = {value(x[0], p)};
      if (by_x)
      {
        by_x->reinit(1, 1);
        (*by_x)(0, 0) = by_unknown(x[0], p);
      }
      if (by_p)
        *by_p = {by_parameter(x[0], p)};
      met = which(x[0], p);
    }
    std::size_t piece() const override { return met; }
    std::vector<double> events(const std::vector<double> &x, double p) override
    {
      return event ? std::vector<double>{event(x[0], p)} : std::vector<double>{};
    }
  };

  inline CurvePoint start_at(const double x, const double p)
  {
    CurvePoint point;
    point.x = {x};
    point.p = p;
    return point;
  }
} // namespace vibrocontact

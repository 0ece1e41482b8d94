#include <vibrocontact/analyses/limit_cycle/bordered_cycle.h>
#include <vibrocontact/analyses/limit_cycle/cycle_equations.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>

namespace vibrocontact
{
  CycleEquations::CycleEquations(CycleMap &map, const DenseVector &equilibrium, const DenseMatrix &linear,
                                 const double tolerance)
      : map(map), equilibrium(equilibrium), linear(linear), n(map.size()), tolerance(tolerance)
  {
  }

  double CycleEquations::evaluate(const std::vector<double> &x)
  {
    start = DenseVector(x.begin(), x.begin() + n);
    period = x[n];
    failure.clear();
    try
    {
      if (!(period > 0))
        throw ConvergenceError("a step leads to a period below zero");
      rest = map.march(start, period, true);
    }
    catch (const ConvergenceError &error)
    {
      failure = error.what();
      return not_evaluated;
    }
    rest -= start;
    DenseVector motion = start;
    motion -= equilibrium;
    return rest.l2_norm() / motion.l2_norm();
  }

  bool CycleEquations::keep(const std::vector<double> &, const double size)
  {
    return size <= tolerance;
  }

  bool CycleEquations::find_step(bool, std::vector<double> &step)
  {
    // of the last place nothing is known
    if (!failure.empty())
      return false;
    try
    {
      BorderedCycle system{map, {map.by_period()}, {map.rate()}, DenseMatrix(1, 1)};
      system.rows[0] /= system.rows[0].l2_norm();
      DenseVector right(n + 1);
      std::copy(rest.begin(), rest.end(), right.begin());
      const DenseVector x = system.solve(linear, right);
      step.assign(x.begin(), x.end());
    }
    catch (const ConvergenceError &error)
    {
      failure = error.what();
      return false;
    }
    return true;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/period_equations.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>

namespace vibrocontact
{
  PeriodEquations::PeriodEquations(const double tolerance) : tolerance(tolerance) {}

  double PeriodEquations::evaluate(const std::vector<double> &unknowns)
  {
    failure.clear();
    try
    {
      CycleMap &map = take(unknowns);
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
    return rest.l2_norm() / from_rest.l2_norm();
  }

  bool PeriodEquations::keep(const std::vector<double> &, const double size)
  {
    return size <= tolerance;
  }

  bool PeriodEquations::find_step(bool, std::vector<double> &found)
  {
    // of the last place nothing is known
    if (!failure.empty())
      return false;
    try
    {
      const DenseVector x = step();
      found.assign(x.begin(), x.end());
    }
    catch (const ConvergenceError &error)
    {
      failure = error.what();
      return false;
    }
    return true;
  }

  DenseVector PeriodEquations::right_side(const unsigned int n_conditions) const
  {
    DenseVector right(rest.size() + n_conditions);
    std::copy(rest.begin(), rest.end(), right.begin());
    return right;
  }
} // namespace vibrocontact

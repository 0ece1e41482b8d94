#include <vibrocontact/analyses/limit_cycle/bordered_cycle.h>
#include <vibrocontact/analyses/limit_cycle/cycle_equations.h>

namespace vibrocontact
{
  CycleEquations::CycleEquations(CycleMap &map, const DenseVector &equilibrium, const DenseMatrix &linear,
                                 const double tolerance)
      : PeriodEquations(tolerance), map(map), equilibrium(equilibrium), linear(linear)
  {
  }

  CycleMap &CycleEquations::take(const std::vector<double> &x)
  {
    const unsigned int n = map.size();
    start = DenseVector(x.begin(), x.begin() + n);
    from_rest = start;
    from_rest -= equilibrium;
    period = x[n];
    return map;
  }

  DenseVector CycleEquations::step()
  {
    BorderedCycle system{map, {map.by_period()}, {map.rate()}, DenseMatrix(1, 1)};
    system.rows[0] /= system.rows[0].l2_norm();
    return system.solve(linear, right_side(1));
  }
} // namespace vibrocontact

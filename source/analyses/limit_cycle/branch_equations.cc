#include <vibrocontact/analyses/limit_cycle/bordered_cycle.h>
#include <vibrocontact/analyses/limit_cycle/branch_equations.h>

namespace vibrocontact
{
  namespace
  {
    /// products of a linear system from which on its preconditioner is renewed
    constexpr unsigned int many_products = 25;
    /// change of the value over the range that differences are taken over
    constexpr double little_change = 1e-5;
  } // namespace

  BranchEquations::BranchEquations(const CycleFamily &family, const LimitCycle &start, const double value,
                                   const double value_size, const double tolerance)
      : PeriodEquations(tolerance), family(family), value_size(value_size), at(family(value)), value(value),
        n(at->map->size())
  {
    period = start.period;
    renew_preconditioner();
  }

  void BranchEquations::go_along(const BranchPlace &direction, const PlaceSizes &in)
  {
    tangent = direction;
    sizes = in;
    by_value.reinit(0);
  }

  CycleMap &BranchEquations::take(const std::vector<double> &z)
  {
    if (z[n + 1] != value)
    {
      at = family(z[n + 1]);
      value = z[n + 1];
    }
    from_rest = DenseVector(z.begin(), z.begin() + n);
    start = at->equilibrium;
    start += from_rest;
    period = z[n];
    return *at->map;
  }

  DenseVector BranchEquations::step()
  {
    CycleMap &map = *at->map;
    if (by_value.size() == 0)
      by_value = difference_by_value();
    BorderedCycle system{map, {map.by_period(), by_value}, {map.rate(), DenseVector(n)}, DenseMatrix(2, 2)};
    system.rows[0] /= system.rows[0].l2_norm();
    for (unsigned int i = 0; i < n; ++i)
      system.rows[1][i] = tangent[i];
    // the condition in units of the state
    for (unsigned int k = 0; k < 2; ++k)
      system.corner(1, k) = tangent[n + k] * sizes.state / sizes.of(n + k, n);
    const unsigned long products = map.n_products;
    const DenseVector x = system.solve(*linear, right_side(2));
    if (map.n_products - products > many_products)
      renew_preconditioner();
    return x;
  }

  void BranchEquations::renew_preconditioner()
  {
    const unsigned int n_steps = at->map->n_steps();
    linear = linear_cycle(at->map->one_step(at->scene.at_rest, period / n_steps), n_steps);
  }

  DenseVector BranchEquations::difference_by_value() const
  {
    const double change = little_change * value_size;
    const std::shared_ptr<CycleAt> other = family(value + change);
    DenseVector begin = other->equilibrium;
    begin += from_rest;
    DenseVector end = other->map->march(begin, period, false);
    end -= begin;
    end -= rest;
    end /= change;
    return end;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/cycle_equations.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>

#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// GMRES stops at this share of the residual, and gives up after so many products
    constexpr double linear_tolerance = 1e-4;
    constexpr unsigned int most_products = 100;

    // what a preconditioner needs no more of
    using SingleMatrix = dealii::LAPACKFullMatrix<float>;

    /// matrix^exponent by squares, exponent > 0
    SingleMatrix power(const DenseMatrix &matrix, unsigned int exponent)
    {
      SingleMatrix square(matrix.m(), matrix.n()), result;
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int i = 0; i < matrix.m(); ++i)
          square(i, j) = matrix(i, j);
      for (; exponent > 0; exponent /= 2)
      {
        if (exponent % 2 == 1)
          result = result.m() == 0 ? square : product(result, square);
        if (exponent > 1)
          square = product(square, square);
      }
      return result;
    }

    struct Factors
    {
      const DenseMatrix &lu;
      void vmult(DenseVector &to, const DenseVector &from) const
      {
        to = from;
        lu.solve(to);
      }
    };
  } // namespace

  CycleEquations::CycleEquations(CycleMap &map, const DenseVector &equilibrium,
                                 const DenseMatrix &step_at_equilibrium, const double tolerance)
      : map(map), equilibrium(equilibrium), n(map.size()), tolerance(tolerance), linear(n, n)
  {
    const SingleMatrix dynamics = power(step_at_equilibrium, map.n_steps());
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        linear(i, j) = (i == j ? 1. : 0.) - dynamics(i, j);
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
      rest = map.march(start, period, false);
    }
    catch (const ConvergenceError &error)
    {
      failure = error.what();
      return std::numeric_limits<double>::max();
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
    try
    {
      map.march(start, period, true);
      by_period = map.by_period();
    }
    catch (const ConvergenceError &error)
    {
      failure = error.what();
      return false;
    }
    phase = map.rate();
    phase /= phase.l2_norm();
    unit_of_period = 1 / by_period.l2_norm();
    DenseMatrix bordered(n + 1, n + 1);
    add_block(bordered, linear, 0, 0);
    for (unsigned int i = 0; i < n; ++i)
    {
      bordered(i, n) = -unit_of_period * by_period[i];
      bordered(n, i) = phase[i];
    }
    DenseVector right(n + 1), x(n + 1);
    std::copy(rest.begin(), rest.end(), right.begin());
    dealii::SolverControl control(most_products, linear_tolerance * right.l2_norm());
    const dealii::SolverGMRES<DenseVector>::AdditionalData data(most_products + 2, true);
    dealii::SolverGMRES<DenseVector> gmres(control, data);
    try
    {
      bordered.compute_lu_factorization();
      gmres.solve(*this, x, right, Factors{bordered});
    }
    catch (const dealii::LACExceptions::ExcSingular &)
    {
      failure = "the linear dynamics over a period are singular";
      return false;
    }
    catch (const dealii::SolverControl::NoConvergence &)
    {
      // the line search judges what was found
    }
    step.assign(x.begin(), x.end());
    step[n] *= unit_of_period;
    return std::all_of(step.begin(), step.end(), [](const double value) { return std::isfinite(value); });
  }

  void CycleEquations::vmult(DenseVector &to, const DenseVector &from) const
  {
    const DenseVector x(from.begin(), from.begin() + n), end = map.derivative(x);
    for (unsigned int i = 0; i < n; ++i)
      to[i] = x[i] - end[i] - unit_of_period * from[n] * by_period[i];
    to[n] = phase * x;
  }
} // namespace vibrocontact

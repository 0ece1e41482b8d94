#include <vibrocontact/analyses/limit_cycle/bordered_cycle.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>

#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// GMRES stops at this share of the residual, and gives up after so many products
    constexpr double linear_tolerance = 1e-4;
    constexpr unsigned int most_products = 100;
    /// added to I - A^n, so that a motion which nothing moves or damps leaves no pivot of zero
    constexpr double shift = 1e-8;

    /// matrix^exponent by squares, exponent > 0: a preconditioner needs no more than single precision
    SingleMatrix power(const DenseMatrix &matrix, unsigned int exponent)
    {
      SingleMatrix square = in_single_precision(matrix), result;
      for (; exponent > 0; exponent /= 2)
      {
        if (exponent % 2 == 1)
          result = result.m() == 0 ? square : product(result, square);
        if (exponent > 1)
          square = product(square, square);
      }
      return result;
    }

    /// The linear system of a cycle with I - A^n in place of I - Phi_x, by elimination of the state.
    class LinearSystem
    {
    public:
      /// @param factors linear_cycle() @throws ExcSingular
      LinearSystem(const DenseMatrix &factors, const BorderedCycle &cycle)
          : factors(factors), rows(cycle.rows), by_further(factors.m(), rows.size()), left(cycle.corner)
      {
        for (unsigned int k = 0; k < rows.size(); ++k)
          std::copy(cycle.columns[k].begin(), cycle.columns[k].end(), &by_further(0, k));
        factors.solve(by_further);
        for (unsigned int k = 0; k < rows.size(); ++k)
          for (unsigned int l = 0; l < rows.size(); ++l)
            for (unsigned int i = 0; i < factors.m(); ++i)
              left(l, k) += rows[l][i] * by_further(i, k);
        left.compute_lu_factorization();
      }

      void vmult(DenseVector &to, const DenseVector &from) const
      {
        const unsigned int n = factors.m();
        DenseVector x(from.begin(), from.begin() + n), further(from.begin() + n, from.end());
        factors.solve(x);
        for (unsigned int k = 0; k < rows.size(); ++k)
          further[k] -= rows[k] * x;
        left.solve(further);
        for (unsigned int k = 0; k < rows.size(); ++k)
        {
          for (unsigned int i = 0; i < n; ++i)
            x[i] += by_further(i, k) * further[k];
          to[n + k] = further[k];
        }
        std::copy(x.begin(), x.end(), to.begin());
      }

    private:
      const DenseMatrix &factors;
      const std::vector<DenseVector> &rows;
      DenseMatrix by_further, left;
    };
  } // namespace

  std::unique_ptr<const DenseMatrix> linear_cycle(const DenseMatrix &step, const unsigned int n_steps)
  {
    const SingleMatrix dynamics = power(step, n_steps);
    auto linear = std::make_unique<DenseMatrix>(step.m(), step.n());
    for (unsigned int j = 0; j < step.n(); ++j)
      for (unsigned int i = 0; i < step.m(); ++i)
        (*linear)(i, j) = (i == j ? 1. + shift : 0.) - dynamics(i, j);
    if (!factorise_lu(*linear))
      throw ConvergenceError("the linear dynamics over a period are singular");
    return linear;
  }

  DenseVector BorderedCycle::solve(const DenseMatrix &linear, const DenseVector &right)
  {
    const unsigned int n = linear.m(), n_further = columns.size();
    std::vector<double> units;
    for (unsigned int k = 0; k < n_further; ++k)
    {
      units.push_back(1 / columns[k].l2_norm());
      if (!std::isfinite(units[k]))
        throw ConvergenceError(k == 0 ? "the state after a period does not depend on its length"
                                      : "the motion does not depend on the value");
      columns[k] *= units[k];
      for (unsigned int l = 0; l < n_further; ++l)
        corner(l, k) *= units[k];
    }
    DenseVector x(n + n_further);
    dealii::SolverControl control(most_products, linear_tolerance * right.l2_norm());
    const dealii::SolverGMRES<DenseVector>::AdditionalData data(most_products + 2, true);
    dealii::SolverGMRES<DenseVector> gmres(control, data);
    try
    {
      gmres.solve(*this, x, right, LinearSystem(linear, *this));
    }
    catch (const dealii::LACExceptions::ExcSingular &)
    {
      throw ConvergenceError("the linear dynamics over a period leave further unknowns undetermined");
    }
    catch (const dealii::SolverControl::NoConvergence &)
    {
      // the line search judges what was found
    }
    if (!std::all_of(x.begin(), x.end(), [](const double value) { return std::isfinite(value); }))
      throw ConvergenceError("the linear system of a period has no finite solution");
    for (unsigned int k = 0; k < n_further; ++k)
      x[n + k] *= units[k];
    return x;
  }

  void BorderedCycle::vmult(DenseVector &to, const DenseVector &from) const
  {
    const unsigned int n_further = columns.size(), n = from.size() - n_further;
    const DenseVector x(from.begin(), from.begin() + n), end = map.derivative(x);
    for (unsigned int i = 0; i < n; ++i)
      to[i] = x[i] - end[i];
    for (unsigned int k = 0; k < n_further; ++k)
    {
      for (unsigned int i = 0; i < n; ++i)
        to[i] -= columns[k][i] * from[n + k];
      to[n + k] = rows[k] * x;
      for (unsigned int l = 0; l < n_further; ++l)
        to[n + k] += corner(k, l) * from[n + l];
    }
  }
} // namespace vibrocontact

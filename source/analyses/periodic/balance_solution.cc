#include <vibrocontact/analyses/periodic/balance.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/numerics/newton_method.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace vibrocontact
{
  namespace
  {
    constexpr double shortest_gap_step = 1e-3, gentler_projection = 1. / 3;
    constexpr unsigned int n_gentler = 2;
    /// unknowns from which on a factorisation costs several evaluations
    constexpr unsigned int costly_factorisation = 200;
    /// of the coarsest motion that others are refined from
    constexpr unsigned int fewest_functions = 7, fewest_samples = 512;
    /// of the law's stiffness: where it begins over the body's own, steps in the logarithm of its range. Long ones that
    /// double and are halved leave the solution where it folds; even short ones find others.
    constexpr double softest_law = 1e-3, long_stiffness_step = 1. / 16, short_stiffness_step = 1. / 200,
                     shortest_stiffness_step = 1. / 3200;

    /// false if the matrix is singular or not finite
    bool factorise(DenseMatrix &matrix)
    {
      try
      {
        matrix.compute_lu_factorization();
      }
      catch (const dealii::ExceptionBase &)
      {
        return false;
      }
      return true;
    }

    /// x of factors x = rhs; false if it is not finite
    bool solve_dense(const DenseMatrix &factors, const std::vector<double> &rhs, std::vector<double> &x)
    {
      DenseVector b(rhs.begin(), rhs.end());
      factors.solve(b);
      x.assign(b.begin(), b.end());
      return std::all_of(x.begin(), x.end(), [](const double value) { return std::isfinite(value); });
    }
  } // namespace

  /// Semi-smooth: J on the side of the law's branch in force. J is singular at folds.
  class PeriodicBalance::Equations : public NewtonEquations
  {
  public:
    explicit Equations(PeriodicBalance &balance) : balance(balance) {}

    double evaluate(const std::vector<double> &c) override
    {
      balance.evaluate(c, residual, nullptr, nullptr);
      const double size = euclidean_norm(residual);
      if (!is_any_kept)
        relative = size / balance.force_scale(c);
      return size;
    }

    bool keep(const std::vector<double> &c, const double size) override
    {
      is_any_kept = true;
      relative = size / balance.force_scale(c);
      if (balance.progress)
        balance.progress->advance(0, [&] { return "residual " + number_text(relative); });
      return relative <= balance.settings.tolerance;
    }

    bool find_step(const bool renew, std::vector<double> &step) override
    {
      if (renew)
      {
        balance.assemble(factors);
        if (!factorise(factors))
          return false;
      }
      for (double &value : residual)
        value = -value;
      return solve_dense(factors, residual, step);
    }

    /// residual of the last c that was kept, or of the first one
    double relative = 0;

  private:
    PeriodicBalance &balance;
    bool is_any_kept = false;
    std::vector<double> residual;
    DenseMatrix factors;
  };

  bool PeriodicBalance::newton(std::vector<double> &c, PeriodicSolution &solution)
  {
    Equations equations(*this);
    NewtonSettings newton;
    newton.max_iterations = settings.max_iterations;
    newton.keeps_factors = c.size() >= costly_factorisation;
    const NewtonResult result = solve_by_newton(equations, newton, c);
    solution.iterations += result.iterations;
    solution.residual = equations.relative;
    return result.converged;
  }

  PeriodicSolution PeriodicBalance::solve(const std::vector<double> &start)
  {
    PeriodicSolution solution;
    solution.excitation = force;
    std::vector<double> c = start;
    // nobody knows how many of Newton's steps it takes
    Progress steps("periodic motion of " + std::to_string(n_unknowns()) + " unknowns", 1);
    const std::unique_ptr<Progress *, void (*)(Progress **)> until_here(&progress,
                                                                        [](Progress **p) { *p = nullptr; });
    progress = &steps;
    solution.converged = find(c, solution) || follow_gap(c, solution) || follow_stiffness(c, solution);
    solution.force = c;
    solution.displacement = displacement(c);
    return solution;
  }

  /// Newton's method from c, or from what an empty c means in solve().
  bool PeriodicBalance::find(std::vector<double> &c, PeriodicSolution &solution)
  {
    const std::vector<double> start = c.empty() ? std::vector<double>(n_unknowns(), 0.) : c;
    if (c.empty() && (body.n_points() > 1 || massless) && refine_fewer_functions(c, solution))
      return true;
    c = start;
    bool found = newton(c, solution);
    // With a smaller augmentation parameter the force spreads farther over the samples. Such motions are found where
    // those of the usual parameter are not, and differ from them within the error of the functions.
    const double rho = normal_rho;
    for (unsigned int k = 0; k < n_gentler && !found && !spring && !massless && !(fixed_rho > 0); ++k)
    {
      normal_rho *= gentler_projection;
      c = start;
      found = newton(c, solution);
    }
    if (!found)
      normal_rho = rho;
    return found;
  }

  /// From the motion of half as many functions, which is found from that of a quarter and so on. Few functions cannot
  /// follow how the points close one after the other; once they have found when all are closed, every doubling takes a
  /// few of Newton's steps.
  bool PeriodicBalance::refine_fewer_functions(std::vector<double> &c, PeriodicSolution &solution)
  {
    const unsigned int N = settings.n_functions, n = (N - 1) / 2 | 1;
    if (n < fewest_functions || receptances || settings.quadrature_points % n != 0)
      return false;
    if (!fewer)
    {
      BalanceSettings coarse = settings;
      coarse.n_functions = n;
      coarse.n_samples = std::max(settings.n_samples / 2, std::min(settings.n_samples, fewest_samples));
      fewer = std::make_unique<PeriodicBalance>(body, law, coarse);
    }
    fewer->progress = progress;
    fewer->set_force(force);
    fewer->set_gap(body.gap);
    std::vector<double> found;
    if (!fewer->find(found, solution))
      return false;
    // low orders come first in the layout of every basis; n is odd
    c.assign(n_unknowns(), 0.);
    for (unsigned int row = 0; row < body.n_contact_rows(); ++row)
      std::copy_n(&found[row * n], n, &c[row * N]);
    return newton(c, solution);
  }

  /// From no contact at the gap that the linear motion just reaches to the gap asked for: at every `reached` c solves the
  /// balance with the gaps in force. Steps double where Newton's method finds it and are halved where not.
  bool PeriodicBalance::follow_gap(std::vector<double> &c, PeriodicSolution &solution)
  {
    const std::vector<double> gap = body.gap, none(n_unknowns(), 0.), excess = linear_excess();
    c = none;
    double reached = 0, step = 0.25;
    while (reached < 1 && step >= shortest_gap_step)
    {
      const double next = std::min(reached + step, 1.);
      for (unsigned int p = 0; p < gap.size(); ++p)
        body.gap[p] = gap[p] + (1 - next) * excess[p];
      std::vector<double> trial = c;
      ++solution.homotopy_steps;
      if (newton(trial, solution))
      {
        c = trial;
        reached = next;
        step *= 2;
      }
      else
        step /= 2;
    }
    body.gap = gap;
    return reached >= 1;
  }

  /// From a law that hardly moves the body to the one asked for: the law times exp(-range left), left from 1 to 0. Long
  /// steps first; where those lose the branch at a fold, all again in short ones.
  bool PeriodicBalance::follow_stiffness(std::vector<double> &c, PeriodicSolution &solution)
  {
    if (!spring)
      return false;
    const std::vector<double> excess = linear_excess();
    double stiffness = 0, compliance = 0;
    for (unsigned int p = 0; p < body.n_points(); ++p)
    {
      stiffness = std::max(stiffness, over_gap(p, -excess[p]).force_slope);
      compliance = std::max(compliance, largest_compliance(linear, p * body.rows_per_point));
    }
    // the law's stiffness at the deepest penetration of the linear motion, over the body's, is to begin at softest_law
    const double range = std::log(stiffness * compliance / softest_law);
    if (!(range > 0))
      return false;
    double left = 1;
    for (const double longest : {1., short_stiffness_step})
    {
      c.assign(n_unknowns(), 0.);
      left = 1;
      double step = 0;
      while (left > 0 && (step == 0 || step >= shortest_stiffness_step))
      {
        const double next = std::max(left - step, 0.);
        law_factor = std::exp(-range * next);
        std::vector<double> trial = c;
        ++solution.stiffness_steps;
        const bool found = newton(trial, solution);
        if (!found && step == 0)
          break;
        if (found)
        {
          c = trial;
          left = next;
        }
        step = !found ? step / 2 : std::min(step == 0 ? long_stiffness_step : 2 * step, longest);
      }
      if (left == 0)
        break;
    }
    law_factor = 1;
    return left == 0;
  }

  /// Of the motion without contact beyond the gaps; n_points [m].
  std::vector<double> PeriodicBalance::linear_excess() const
  {
    const std::vector<double> u = displacement(std::vector<double>(n_unknowns(), 0.));
    std::vector<double> excess(body.n_points()), values(samples->n_samples());
    for (unsigned int p = 0; p < excess.size(); ++p)
    {
      samples->samples(TimeSampling::Quantity::displacement,
                       &u[p * body.rows_per_point * settings.n_functions], values.data());
      excess[p] = std::max(*std::max_element(values.begin(), values.end()) - body.gap[p], 0.);
    }
    return excess;
  }
} // namespace vibrocontact

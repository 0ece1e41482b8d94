#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/fixed_point.h>
#include <vibrocontact/contact/newton.h>
#include <vibrocontact/contact/newton_factorisation.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    /// unknowns beyond which GMRES with fast products replaces the dense factorisation
    constexpr unsigned int iterative_above = 700;
    /// rho_t of the Newton steps over that of the residual by which solutions are judged
    constexpr double tangential_factor = 0.4;
    constexpr unsigned int fixed_point_steps_in_fallback = 100;
    constexpr unsigned int max_halvings = 6, patience = 8;
    /// largest rounding error of a product as a share of the tolerance, and the relative one of single precision
    constexpr double rounding_of_tolerance = 0.01, single_rounding = 6e-8;

    bool all_finite(const DenseVector &v)
    {
      return std::all_of(v.begin(), v.end(), [](const double x) { return std::isfinite(x); });
    }

    double merit(const ContactProblem &problem, const double residual, const DenseVector &R)
    {
      if (!problem.force_given())
        return residual;
      return std::max(residual, std::abs(problem.resultant(R) / problem.normal_force - 1));
    }
  } // namespace

  /// A solution by Newton's steps: its state and what the strategy remembers of the way; vectors are kept.
  class NewtonSolver::Steps
  {
  public:
    explicit Steps(const ContactSolverParameters &parameters) : parameters(parameters) {}

    void forget() { kept.forget(); }

    void solve(const ContactProblem &of, ContactSolution &state)
    {
      problem = &of;
      n = of.n_points();
      components = of.n_components();
      check_finite(of);
      residual.emplace(of, tangential_factor);
      judge.emplace(of);
      kept.begin_problem();
      std::swap(s, state);
      try
      {
        find();
      }
      catch (...)
      {
        std::swap(s, state);
        throw;
      }
      std::swap(s, state);
    }

  private:
    void find()
    {
      begin();
      bool goes_on = true;
      while (goes_on)
      {
        while (goes_on && s.residual > parameters.tolerance &&
               s.iterations < parameters.max_newton_iterations)
        {
          ++s.iterations;
          const bool improves = find_step() && take_step();
          goes_on = improves || begin_again() || fall_back();
        }
        finish();
        // what long steps left of rounding in y was found out: once more, from there
        goes_on = goes_on && !s.converged && s.iterations < parameters.max_newton_iterations;
        if (goes_on)
        {
          judge_state();
          best = s;
        }
      }
    }

    void begin()
    {
      if (!problem->force_given() || s.empty())
        s.approach = problem->approach;
      if (!s.is_finite())
      {
        s = ContactSolution();
        s.approach = problem->approach;
      }
      s.cost() = {};
      s.converged = false;
      if (s.empty())
        frictionless_start(*problem, 1e-3, s);
      if (!s.response_known)
        contact_response(*problem, s.R, s.approach, s.y);
      judge_state();
      if (!std::isfinite(s.residual) || !std::isfinite(current))
        throw ConvergenceError("The operator of the contact problem '" + problem->title +
                               "' holds numbers that are not finite; check the bodies that it is made of.");
      best = s;
    }

    /// residuals of the state that s holds, both Newton's own and the one that counts; forgets the way here
    void judge_state()
    {
      s.residual = merit(*problem, judge->evaluate(s.R, s.y, judged, trial_status), s.R);
      current = merit(*problem, residual->evaluate(s.R, s.y, projected, s.status), s.R);
      history = {current};
      since_best = 0;
      // a matrix of an earlier problem is tried once
      last_gain = 0;
    }

    /// Newton's direction into dR and d_approach; false if there is none
    bool find_step()
    {
      J.linearise(*problem, *residual, s.R, s.y);
      const std::vector<unsigned int> &points = J.points();
      const unsigned int m = points.size();
      if (m == 0)
        kept.leave_direction();
      if (problem->force_given() && m == 0)
        return false; // nothing touches: no force answers to the approach

      // Points that leave the contact lose their forces; what this does to the others enters the
      // right-hand side.
      dR.reinit(components * n);
      is_active.assign(n, false);
      for (const unsigned int i : points)
        is_active[i] = true;
      changed.clear();
      for (unsigned int i = 0; i < n; ++i)
      {
        const auto force = at_point(s.R, n, components, i);
        if (is_active[i] || (force[0] == 0 && force[1] == 0 && force[2] == 0))
          continue;
        changed.push_back(i);
        for (unsigned int c = 0; c < components; ++c)
          dR[c * n + i] = -force[c];
      }
      // of a direction alone: take_step() multiplies again, as exactly as the tolerance asks for
      problem->A->vmult_change(dy, dR, changed);
      rhs.reinit(J.size());
      double sum = 0;
      for (unsigned int k = 0; k < m; ++k)
      {
        const unsigned int i = points[k];
        const auto force = at_point(s.R, n, components, i), moved = at_point(dy, n, components, i);
        const auto known = J.apply(k, 0, 0, 0, moved[0], moved[1], moved[2]);
        for (unsigned int c = 0; c < components; ++c)
          rhs[c * m + k] = projected[c * n + i] - force[c] - known[c];
        const std::array<double, 3> l = problem->share_of(i);
        sum += l[0] * force[0] + l[1] * force[1] + l[2] * force[2];
      }
      if (problem->force_given())
        rhs[components * m] = problem->normal_force - sum;

      if (m > 0 && !(problem->A->fast_product() && J.size() > iterative_above ? solve_iteratively()
                                                                              : solve_directly()))
        return false;
      J.scatter(rhs, dR);
      d_approach = problem->force_given() ? rhs[components * m] * J.approach_scale() : 0;
      changed.insert(changed.begin(), points.begin(), points.end());
      return true;
    }

    bool solve_iteratively()
    {
      kept.leave_direction();
      dealii::SolverControl control(400, std::clamp(0.1 * current, 1e-4, 3e-2) * rhs.l2_norm());
      dealii::SolverGMRES<DenseVector>::AdditionalData data(102);
      dealii::SolverGMRES<DenseVector> gmres(control, data);
      DenseVector step(J.size());
      try
      {
        gmres.solve(J, step, rhs, dealii::PreconditionIdentity());
      }
      catch (const dealii::SolverControl::NoConvergence &)
      {
        // an inexact direction is still judged by the line search
      }
      s.linear_iterations += control.last_step();
      rhs = step;
      return all_finite(rhs);
    }

    bool solve_directly()
    {
      return kept.prepare(*problem, J, s.status, last_gain, s.factorisations) && kept.solve(rhs) &&
             all_finite(rhs);
    }

    /// Goes along the direction, halving the step until the residual is below the largest of the last four;
    /// false if that fails or nothing has improved for a while
    bool take_step()
    {
      if (single_rounding * dR.l2_norm() <= rounding_of_tolerance * parameters.tolerance * s.R.l2_norm())
        problem->A->vmult_change(dy, dR, changed);
      else
        problem->A->vmult(dy, dR, changed);
      const double bound =
          *std::max_element(history.end() - std::min<std::size_t>(4, history.size()), history.end());
      double step = 1, trial = 0;
      bool falls = false;
      for (unsigned int halving = 0; halving <= max_halvings && !falls; ++halving)
      {
        step = std::pow(0.5, halving);
        trial_R = s.R;
        trial_R.add(step, dR);
        trial_y = s.y;
        trial_y.add(step, dy);
        problem->move(trial_y, step * d_approach);
        trial = merit(*problem, residual->evaluate(trial_R, trial_y, projected, trial_status), trial_R);
        falls = trial < bound || trial <= 0.1 * parameters.tolerance;
      }
      if (!std::isfinite(trial))
        return false;
      if (step == 1)
        kept.took_direction();
      last_gain = trial / current;
      current = trial;
      s.R = trial_R;
      s.y = trial_y;
      s.status = trial_status;
      s.approach += step * d_approach;
      s.residual = merit(*problem, judge->evaluate(s.R, s.y, judged, trial_status), s.R);
      history.push_back(trial);
      since_best = s.residual < best.residual ? 0 : since_best + 1;
      if (s.residual < best.residual)
        best = s;
      return falls && since_best <= patience;
    }

    /// s <- best, with what the way has cost so far
    void go_back_to_best()
    {
      best.cost() = s.cost();
      s = best;
    }

    /// From the best state with another matrix; false if the matrix is not to blame
    bool begin_again()
    {
      if (!kept.distrust())
        return false;
      go_back_to_best();
      judge_state();
      return true;
    }

    /// Fixed-point iterations from the best state; false if they lead nowhere
    bool fall_back()
    {
      ++s.fallbacks;
      ContactSolverParameters limited = parameters;
      limited.max_fixed_point_iterations = fixed_point_steps_in_fallback * s.fallbacks;
      ContactSolution moved = best;
      try
      {
        FixedPointSolver(limited).solve(*problem, moved);
      }
      catch (const ConvergenceError &)
      {
        return false; // the best state stands, marked as not converged
      }
      s.R = moved.R;
      s.y = moved.y;
      s.approach = moved.approach;
      judge_state();
      kept.forget();
      if (s.residual < best.residual)
        best = s;
      return true;
    }

    void finish()
    {
      if (!(s.residual <= best.residual))
        go_back_to_best();
      // round-off collected in y over the steps is removed before the final judgement; who knew the
      // response of the start cares for it
      if (!s.response_known)
        contact_response(*problem, s.R, s.approach, s.y);
      s.response_known = false;
      s.residual = merit(*problem, judge->evaluate(s.R, s.y, judged, s.status), s.R);
      s.converged = s.residual <= parameters.tolerance;
    }

    const ContactSolverParameters parameters;
    NewtonFactorisation kept;
    NewtonJacobian J;
    const ContactProblem *problem = nullptr;
    unsigned int n = 0, components = 3;
    std::optional<ContactResidual> residual, judge;
    ContactSolution s, best;
    /// merit of s by Newton's own residual, now and in the steps so far
    double current = 0, last_gain = 1;
    std::vector<double> history;
    unsigned int since_best = 0;
    /// the direction, and the points at which it changes forces
    DenseVector dR, dy, rhs;
    double d_approach = 0;
    std::vector<unsigned int> changed;
    std::vector<bool> is_active;
    DenseVector projected, judged, trial_R, trial_y;
    std::vector<ContactStatus> trial_status;
  };

  NewtonSolver::NewtonSolver(const ContactSolverParameters &parameters)
      : steps(std::make_unique<Steps>(parameters))
  {
  }

  NewtonSolver::~NewtonSolver() = default;

  void NewtonSolver::solve(const ContactProblem &problem, ContactSolution &state)
  {
    steps->solve(problem, state);
  }

  void NewtonSolver::renew()
  {
    steps->forget();
  }
} // namespace vibrocontact

#include <vibrocontact/contact/fixed_point.h>
#include <vibrocontact/contact/newton.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// The generalised Jacobian of R - projections at the active points; rows scaled like forces.
    class Jacobian
    {
    public:
      Jacobian(const ContactProblem &problem, const ContactResidual &residual, const DenseVector &R,
               const DenseVector &y)
          : problem(problem), n(problem.n_points()), rho_t(residual.rho_tangential), dR(3 * n), dy(3 * n)
      {
        for (unsigned int i = 0; i < n; ++i)
        {
          const NormalLaw::Projection normal = problem.normal_law->project(R[i], y[i], residual.rho_normal);
          if (normal.by_force == 0 && normal.by_gap == 0)
            continue;
          const CoulombLaw::Projection friction =
              CoulombLaw::project({{R[n + i] - rho_t * y[n + i], R[2 * n + i] - rho_t * y[2 * n + i]}},
                                  problem.mu[i] * normal.force);
          points.push_back(i);
          rows.push_back({normal.by_force,
                          normal.by_gap,
                          friction.by_trial,
                          {{problem.mu[i] * friction.by_radius[0], problem.mu[i] * friction.by_radius[1]}}});
        }
      }

      unsigned int m() const { return points.size(); }
      unsigned int size() const { return 3 * m() + (problem.force_given() ? 1 : 0); }

      /// J at point k for a change (dR, dy) of its forces and responses: one normal, two tangential rows
      std::array<double, 3> apply(const unsigned int k, const double dN, const double dTx, const double dTy,
                                  const double dgap, const double dsx, const double dsy) const
      {
        const Row &r = rows[k];
        const double dP = r.by_force * dN + r.by_gap * dgap;
        const double tx = dTx - rho_t * dsx, ty = dTy - rho_t * dsy;
        return {{dN - dP, dTx - r.by_trial[0][0] * tx - r.by_trial[0][1] * ty - r.by_radius[0] * dP,
                 dTy - r.by_trial[1][0] * tx - r.by_trial[1][1] * ty - r.by_radius[1] * dP}};
      }

      /// dst = J src without forming J
      void vmult(DenseVector &dst, const DenseVector &src) const
      {
        dR = 0;
        scatter(src, dR);
        problem.A->vmult_among(dy, dR, points);
        const double d_approach = problem.force_given() ? src[3 * m()] * approach_scale() : 0;
        double sum = 0;
        for (unsigned int k = 0; k < m(); ++k)
        {
          const unsigned int i = points[k];
          const auto value =
              apply(k, dR[i], dR[n + i], dR[2 * n + i], dy[i] - d_approach, dy[n + i], dy[2 * n + i]);
          for (unsigned int c = 0; c < 3; ++c)
            dst[c * m() + k] = value[c];
          sum += dR[i];
        }
        if (problem.force_given())
          dst[3 * m()] = sum;
      }

      void assemble(DenseMatrix &J) const
      {
        const unsigned int m = this->m();
        DenseMatrix A;
        problem.A->extract(points, A);
        J.reinit(size());
        for (unsigned int column = 0; column < 3 * m; ++column)
        {
          const double *const a = &A(0, column);
          double *const out = &J(0, column);
          const unsigned int c = column / m, own = column % m;
          for (unsigned int k = 0; k < m; ++k)
          {
            const Row &r = rows[k];
            const double dP = r.by_gap * a[k], tx = rho_t * a[m + k], ty = rho_t * a[2 * m + k];
            out[k] = -dP;
            out[m + k] = r.by_trial[0][0] * tx + r.by_trial[0][1] * ty - r.by_radius[0] * dP;
            out[2 * m + k] = r.by_trial[1][0] * tx + r.by_trial[1][1] * ty - r.by_radius[1] * dP;
          }
          const std::array<double, 3> diagonal = apply(own, c == 0, c == 1, c == 2, 0, 0, 0);
          for (unsigned int row = 0; row < 3; ++row)
            out[row * m + own] += diagonal[row];
          if (problem.force_given())
            J(3 * m, column) = c == 0 ? 1 : 0;
        }
        if (problem.force_given())
          for (unsigned int k = 0; k < m; ++k)
          {
            const std::array<double, 3> value = apply(k, 0, 0, 0, -approach_scale(), 0, 0);
            for (unsigned int row = 0; row < 3; ++row)
              J(row * m + k, 3 * m) = value[row];
          }
      }

      /// values at the active points into a full vector of 3 n
      void scatter(const DenseVector &active, DenseVector &full) const
      {
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int k = 0; k < m(); ++k)
            full[c * n + points[k]] = active[c * m() + k];
      }

      /// the unknown that stands for the approach is a force: approach = value * scale
      double approach_scale() const { return rows.empty() || rows[0].by_gap == 0 ? 1 : -1 / rows[0].by_gap; }

      std::vector<unsigned int> points;

    private:
      struct Row
      {
        double by_force, by_gap;
        std::array<CoulombLaw::Vector2, 2> by_trial;
        CoulombLaw::Vector2 by_radius;
      };
      const ContactProblem &problem;
      const unsigned int n;
      const double rho_t;
      std::vector<Row> rows;
      mutable DenseVector dR, dy;
    };

    /// unknowns beyond which GMRES with fast products replaces the dense factorisation
    constexpr unsigned int iterative_above = 700;
    /// rho_t of the Newton steps over that of the residual by which solutions are judged
    constexpr double tangential_factor = 0.4;
    constexpr unsigned int fixed_point_steps_in_fallback = 100;

    double merit(const ContactProblem &problem, const double residual, const DenseVector &R)
    {
      if (!problem.force_given())
        return residual;
      double sum = 0;
      for (unsigned int i = 0; i < problem.n_points(); ++i)
        sum += R[i];
      return std::max(residual, std::abs(sum / problem.normal_force - 1));
    }
  } // namespace

  ContactSolution NewtonSolver::solve(const ContactProblem &problem, const ContactSolution &start)
  {
    const auto begin = std::chrono::steady_clock::now();
    const unsigned int n = problem.n_points();
    ContactSolution s = start;
    if (!problem.force_given() || s.empty())
      s.approach = problem.approach;
    s.iterations = s.factorisations = s.linear_iterations = s.fallbacks = 0;
    s.converged = false;
    if (s.empty())
      frictionless_start(problem, 1e-3, s);

    const ContactResidual residual(problem, tangential_factor), judge(problem);
    DenseVector projected, judged, dR(3 * n), dy(3 * n), trial_R, trial_y, rhs;
    DenseMatrix lu;
    std::vector<ContactStatus> status, factorised_status;
    contact_response(problem, s.R, s.approach, s.y);
    s.residual = merit(problem, judge.evaluate(s.R, s.y, judged, status), s.R);
    double current = merit(problem, residual.evaluate(s.R, s.y, projected, s.status), s.R);
    ContactSolution best = s;
    std::vector<double> history = {current};
    double last_gain = 1;
    unsigned int since_best = 0;

    while (s.residual > parameters.tolerance && s.iterations < parameters.max_newton_iterations)
    {
      ++s.iterations;
      Jacobian J(problem, residual, s.R, s.y);
      const unsigned int m = J.m();

      // Points that leave the contact lose their forces; what this does to the others enters the right-hand
      // side.
      dR = 0;
      std::vector<bool> active(n, false);
      for (const unsigned int i : J.points)
        active[i] = true;
      std::vector<unsigned int> leaving;
      for (unsigned int i = 0; i < n; ++i)
        if (!active[i] && (s.R[i] != 0 || s.R[n + i] != 0 || s.R[2 * n + i] != 0))
        {
          leaving.push_back(i);
          for (unsigned int c = 0; c < 3; ++c)
            dR[c * n + i] = -s.R[c * n + i];
        }
      problem.A->vmult(dy, dR, leaving);
      rhs.reinit(J.size());
      double sum = 0;
      for (unsigned int k = 0; k < m; ++k)
      {
        const unsigned int i = J.points[k];
        const auto known = J.apply(k, 0, 0, 0, dy[i], dy[n + i], dy[2 * n + i]);
        for (unsigned int c = 0; c < 3; ++c)
          rhs[c * m + k] = projected[c * n + i] - s.R[c * n + i] - known[c];
        sum += s.R[i];
      }
      if (problem.force_given())
        rhs[3 * m] = problem.normal_force - sum;
      AssertThrow(!problem.force_given() || m > 0, dealii::ExcInternalError());

      if (problem.A->fast_product() && J.size() > iterative_above)
      {
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
          // an inexact direction is still judged by the line search below
        }
        s.linear_iterations += control.last_step();
        rhs = step;
      }
      else if (m > 0)
      {
        // A factorisation is kept while no status changes and it still reduces the residual by ten at a
        // stroke.
        const bool keep = s.status == factorised_status && lu.m() == J.size() && last_gain < 0.1;
        if (!keep)
        {
          J.assemble(lu);
          lu.compute_lu_factorization();
          factorised_status = s.status;
          ++s.factorisations;
        }
        lu.solve(rhs);
      }
      J.scatter(rhs, dR);
      const double d_approach = problem.force_given() ? rhs[3 * m] * J.approach_scale() : 0;

      std::vector<unsigned int> changed = J.points;
      changed.insert(changed.end(), leaving.begin(), leaving.end());
      problem.A->vmult(dy, dR, changed);
      const double bound =
          *std::max_element(history.end() - std::min<std::size_t>(4, history.size()), history.end());
      double step = 1, trial = 0;
      for (unsigned int halving = 0; halving <= 6; ++halving, step *= 0.5)
      {
        trial_R = s.R;
        trial_R.add(step, dR);
        trial_y = s.y;
        trial_y.add(step, dy);
        for (unsigned int i = 0; i < n; ++i)
          trial_y[i] -= step * d_approach;
        trial = merit(problem, residual.evaluate(trial_R, trial_y, projected, status), trial_R);
        if (trial < bound || trial <= 0.1 * parameters.tolerance)
          break;
      }
      last_gain = trial / current;
      current = trial;
      s.R = trial_R;
      s.y = trial_y;
      s.status = status;
      s.approach += step * d_approach;
      s.residual = merit(problem, judge.evaluate(s.R, s.y, judged, status), s.R);
      history.push_back(trial);
      since_best = s.residual < best.residual ? 0 : since_best + 1;
      if (s.residual < best.residual)
        best = s;

      if (trial >= bound || since_best > 8)
      {
        ++s.fallbacks;
        ContactSolverParameters limited = parameters;
        limited.max_fixed_point_iterations = fixed_point_steps_in_fallback * s.fallbacks;
        const ContactSolution moved = FixedPointSolver(limited).solve(problem, best);
        s.R = moved.R;
        s.y = moved.y;
        s.approach = moved.approach;
        s.residual = merit(problem, judge.evaluate(s.R, s.y, judged, status), s.R);
        current = merit(problem, residual.evaluate(s.R, s.y, projected, s.status), s.R);
        history = {current};
        since_best = 0;
        last_gain = 1;
      }
    }
    if (s.residual > best.residual)
    {
      best.iterations = s.iterations;
      best.factorisations = s.factorisations;
      best.linear_iterations = s.linear_iterations;
      best.fallbacks = s.fallbacks;
      s = best;
    }
    // round-off collected in y over the steps is removed before the final judgement
    contact_response(problem, s.R, s.approach, s.y);
    s.residual = merit(problem, judge.evaluate(s.R, s.y, judged, s.status), s.R);
    s.converged = s.residual <= parameters.tolerance;
    s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return s;
  }
} // namespace vibrocontact

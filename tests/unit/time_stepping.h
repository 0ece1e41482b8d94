#pragma once

#include <vibrocontact/analyses/periodic/balance.h>
#include <vibrocontact/analyses/periodic/force_step.h>
#include <vibrocontact/analyses/periodic/time_sampling.h>
#include <vibrocontact/contact/laws/friction_law.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  /// A body against rigid stops by equal steps in time, with Coulomb friction: modes answer forces that are linear over the
  /// step exactly; Signorini's law holds for gap and force at the end of the step, Coulomb's for the force there and the
  /// slip over the step, by projections point after point (Gauss-Seidel).
  class TimeStepping
  {
  public:
    TimeStepping(const ForcedBody &body, const double friction, const HarmonicForce &force,
                 const unsigned int n_steps)
        : body(body), friction(friction), force(force), n_steps(n_steps), h(1 / force.frequency / n_steps),
          q(body.n_modes(), 0.), v(q), p(body.n_contact_rows(), 0.), u(p), history(body.n_points())
    {
      const unsigned int n = body.n_contact_rows();
      compliance.reinit(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          compliance(i, j) = body.residual(i, j);
      for (unsigned int k = 0; k < body.n_modes(); ++k)
      {
        free.push_back(free_mode(body.omega[k], body.damping_ratio[k], h));
        const double answer = stepped(k, 0, 0, 0, 1).first;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            compliance(i, j) += body.trace(i, k) * answer * body.trace(j, k);
      }
    }

    /// From the state of a periodic motion where its force rises through zero.
    void start(const PeriodicBalance &balance, const PeriodicSolution &solution)
    {
      const double f = force.frequency;
      const DenseMatrix coefficients = modal_coefficients(body, balance.integrals(), solution.excitation,
                                                          balance.body_forces(solution.force)),
                        values = sampled(balance.trial(), {0.}, 0),
                        slopes = sampled(balance.trial(), {0.}, 1);
      for (unsigned int k = 0; k < body.n_modes(); ++k)
      {
        q[k] = v[k] = 0;
        for (unsigned int i = 0; i < values.n(); ++i)
        {
          q[k] += values(0, i) * coefficients(i, k);
          v[k] += f * slopes(0, i) * coefficients(i, k);
        }
      }
      u = points(0);
    }

    /// One period; its motion is kept.
    void advance()
    {
      for (unsigned int p = 0; p < body.n_points(); ++p)
        history[p].clear();
      tip.clear();
      for (unsigned int step = 0; step < n_steps; ++step)
      {
        for (unsigned int point = 0; point < body.n_points(); ++point)
          history[point].push_back(u[point * body.rows_per_point]);
        double deflection = 0;
        for (unsigned int k = 0; k < body.n_modes(); ++k)
          deflection += body.modal_force(k) * q[k];
        tip.push_back(deflection);
        make_step(step);
      }
    }

    /// Of the modes: w q, q'. A state to go on from at the beginning of a period, in flight.
    std::vector<double> state() const
    {
      std::vector<double> result = v;
      for (unsigned int k = 0; k < q.size(); ++k)
        result.insert(result.begin() + k, body.omega[k] * q[k]);
      return result;
    }
    void set_state(const std::vector<double> &state)
    {
      for (unsigned int k = 0; k < q.size(); ++k)
      {
        q[k] = state[k] / body.omega[k];
        v[k] = state[q.size() + k];
      }
      std::fill(p.begin(), p.end(), 0.);
      u = points(0);
    }

    /// of a contact point into the stop, of the modes at the exciting force; over the last period, n_steps
    const std::vector<double> &displacement(const unsigned int point) const { return history[point]; }
    const std::vector<double> &deflection() const { return tip; }

  private:
    /// Displacement and velocity of a mode after a step under a force that goes from f0 to f1.
    std::pair<double, double> stepped(const unsigned int k, const double q0, const double v0, const double f0,
                                      const double f1) const
    {
      const double w = body.omega[k], slope = (f1 - f0) / (h * w * w),
                   mean = (f0 - 2 * body.damping_ratio[k] * w * slope) / (w * w);
      return {free[k].qq * (q0 - mean) + free[k].qv * (v0 - slope) + mean + slope * h,
              free[k].vq * (q0 - mean) + free[k].vv * (v0 - slope) + slope};
    }

    double exciting(const double step) const
    {
      return force.amplitude * std::sin(2 * M_PI * step / n_steps + force.phase);
    }

    /// Motion of the rows without residual answer to contact forces.
    std::vector<double> points(const double step) const
    {
      std::vector<double> result(body.n_contact_rows());
      for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
      {
        result[i] = body.residual_load[i] + body.residual_force(i) * exciting(step);
        for (unsigned int k = 0; k < body.n_modes(); ++k)
          result[i] += body.trace(i, k) * q[k];
      }
      return result;
    }

    double load(const unsigned int k, const double step, const std::vector<double> &forces) const
    {
      double result = body.modal_load[k] + body.modal_force(k) * exciting(step);
      for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
        result += body.trace(i, k) * forces[i];
      return result;
    }

    void make_step(const unsigned int step)
    {
      const std::vector<double> before = u, q0 = q, v0 = v, p0 = p;
      const std::vector<double> none(body.n_contact_rows(), 0.);
      for (unsigned int k = 0; k < body.n_modes(); ++k)
        q[k] = stepped(k, q0[k], v0[k], load(k, step, p0), load(k, step + 1, none)).first;
      solve_contact(points(step + 1), before);
      for (unsigned int k = 0; k < body.n_modes(); ++k)
        std::tie(q[k], v[k]) = stepped(k, q0[k], v0[k], load(k, step, p0), load(k, step + 1, p));
    }

    void solve_contact(const std::vector<double> &open, const std::vector<double> &before)
    {
      const unsigned int n = body.n_contact_rows(), rows = body.rows_per_point;
      const auto motion = [&](const unsigned int i)
      {
        double result = open[i];
        for (unsigned int j = 0; j < n; ++j)
          result += compliance(i, j) * p[j];
        return result;
      };
      double change = 1, size = 1;
      unsigned int sweep = 0;
      for (; change > 1e-9 * size && sweep < 20000; ++sweep)
      {
        change = 0;
        size = 1e-3 * force.amplitude;
        for (unsigned int i = 0; i < n; i += rows)
        {
          const double normal = std::max(-p[i] + (motion(i) - body.gap[i / rows]) / compliance(i, i), 0.);
          change = std::max(change, std::abs(normal + p[i]));
          p[i] = -normal;
          size = std::max(size, normal);
          if (rows == 1)
            continue;
          const double rho = 1 / std::max(compliance(i + 1, i + 1), compliance(i + 2, i + 2));
          const auto friction_force = project_on_disc({{p[i + 1] - rho * (motion(i + 1) - before[i + 1]),
                                                        p[i + 2] - rho * (motion(i + 2) - before[i + 2])}},
                                                      friction * normal)
                                          .force;
          for (unsigned int a = 0; a < 2; ++a)
          {
            change = std::max(change, std::abs(friction_force[a] - p[i + 1 + a]));
            p[i + 1 + a] = friction_force[a];
          }
        }
      }
      EXPECT_LT(sweep, 20000u) << change << " of " << size;
      for (unsigned int i = 0; i < n; ++i)
        u[i] = motion(i);
    }

    const ForcedBody body;
    const double friction;
    const HarmonicForce force;
    const unsigned int n_steps;
    const double h;
    std::vector<FreeMode> free;
    /// of the rows at the end of a step to forces there [m/N]
    DenseMatrix compliance;
    std::vector<double> q, v, p, u, tip;
    std::vector<std::vector<double>> history;
  };
} // namespace vibrocontact

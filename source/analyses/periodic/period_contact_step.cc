// PeriodMap in contact: its steps, the force in them, and the variation of both.
#include <vibrocontact/analyses/periodic/period_map.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>

#include <boost/math/special_functions/legendre.hpp>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  /// The matrices of doc/theory.md, "References in time": by_state is R_i and by_force is G + S_d. S_d is S unless the
  /// residual is a state that is not slaved: such a residual answers to the force with delay only.
  std::unique_ptr<PeriodMap::Step> PeriodMap::make_step(const double length) const
  {
    auto step = std::make_unique<Step>();
    const unsigned int s = rule.s;
    const double rate_share = slaved ? beta : 0;
    step->length = length;
    step->by_state.reinit(s, n_states());
    step->by_force.reinit(s, s);
    for (unsigned int i = 0; i < s; ++i)
    {
      step->nodes.push_back(answer_to_force(body, rule, length, rule.node[i], beta));
      const ForceAnswer &at = step->nodes.back();
      std::vector<double> sum(s, 0.);
      for (unsigned int k = 0; k < n; ++k)
      {
        const double b = body.trace(0, k);
        step->by_state(i, k) = b * (at.free[k].qq + rate_share * at.free[k].vq);
        step->by_state(i, n + k) = b * (at.free[k].qv + rate_share * at.free[k].vv);
        for (unsigned int j = 0; j < s; ++j)
          sum[j] += b * b * (at.displacement[k * s + j] + rate_share * at.velocity[k * s + j]);
      }
      if (relaxed && !slaved)
        step->by_state(i, 2 * n) = at.relaxation;
      for (unsigned int j = 0; j < s; ++j)
        step->by_force(i, j) = sum[j] + (relaxed && !slaved ? S * at.residual[j] : 0.) +
                               (i == j && (!relaxed || slaved) ? S : 0.);
    }
    step->end = answer_to_force(body, rule, length, 1, beta);
    step->state_by_force.reinit(n_states(), s);
    for (unsigned int j = 0; j < s; ++j)
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        step->state_by_force(k, j) = body.trace(0, k) * step->end.displacement[k * s + j];
        step->state_by_force(n + k, j) = body.trace(0, k) * step->end.velocity[k * s + j];
      }
      if (relaxed)
        step->state_by_force(2 * n, j) = S * step->end.residual[j];
    }
    if (law->is_linear())
    {
      // (G + S_d + d') f = e without f
      step->inverse = step->by_force;
      for (unsigned int i = 0; i < s; ++i)
        step->inverse(i, i) += touch_compliance;
      step->inverse.invert();
    }
    return step;
  }

  /// The force f with S_d f + d(f) = e: where the law's graph meets this line.
  double PeriodMap::force_of_drive(const double e) const
  {
    const double direct = relaxed && !slaved ? 0. : S;
    return law->graph(law->parameter_at(direct, 1, e)).force;
  }

  /// G f + S_d f + d(f) = e at the Gauss points, e the drive without f; then the state at the end of the step.
  void PeriodMap::contact_step(const Step &step, const double t, State &x, State &f) const
  {
    const unsigned int s = rule.s;
    State e(s), residual(s);
    double scale = 0;
    for (unsigned int i = 0; i < s; ++i)
    {
      const double at = rule.node[i] * step.length;
      e[i] = (E * std::polar(1., Omega * (t + at))).imag() + e_load - gap +
             rigid_load * at * (0.5 * at + (slaved ? beta : 0.));
    }
    for (unsigned int k = 0; k < n_states(); ++k)
      for (unsigned int i = 0; i < s; ++i)
        e[i] += step.by_state(i, k) * x[k];
    for (unsigned int i = 0; i < s; ++i)
      scale = std::max(scale, std::abs(e[i]));
    if (law->is_linear())
    {
      f.assign(s, 0.);
      for (unsigned int j = 0; j < s; ++j)
        for (unsigned int i = 0; i < s; ++i)
          f[i] += step.inverse(i, j) * e[j];
    }
    else
    {
      // the unknowns are the places on the law's graph at the Gauss points, f = N(along) and d = d(along): a steep law is
      // no harder than a soft one. They start where the stop would be if the modes did not answer to f.
      const double direct = relaxed && !slaved ? 0. : S;
      State along(s);
      for (unsigned int i = 0; i < s; ++i)
        along[i] = law->parameter_at(direct, 1, e[i]);
      std::vector<NormalLaw::GraphPoint> at(s);
      const auto follow_graph = [&]
      {
        for (unsigned int i = 0; i < s; ++i)
          at[i] = law->graph(along[i]);
      };
      follow_graph();
      DenseVector change(s);
      DenseMatrix jacobian(s, s);
      bool converged = false;
      for (unsigned int iteration = 0; iteration < 40 && !converged; ++iteration)
      {
        for (unsigned int i = 0; i < s; ++i)
        {
          change[i] = e[i] - at[i].penetration;
          for (unsigned int j = 0; j < s; ++j)
          {
            change[i] -= step.by_force(i, j) * at[j].force;
            jacobian(i, j) = step.by_force(i, j) * at[j].force_slope;
          }
          jacobian(i, i) += at[i].penetration_slope;
        }
        DenseMatrix lu = jacobian;
        lu.compute_lu_factorization();
        lu.solve(change);
        double largest = 0, farthest = 0;
        for (unsigned int i = 0; i < s; ++i)
        {
          along[i] += change[i];
          largest = std::max(largest, std::abs(change[i]));
          farthest = std::max(farthest, std::abs(along[i]));
        }
        follow_graph();
        // quadratic: what is left is the square of it
        converged = largest <= 1e-9 * farthest;
      }
      f.resize(s);
      for (unsigned int i = 0; i < s; ++i)
        f[i] = at[i].force;
      if (!converged)
        throw ConvergenceError("The contact force of a step of the time reference did not converge: take "
                               "more steps per period.");
    }
    move_free(step.end.free, step.end.relaxation, step.length, x);
    for (unsigned int j = 0; j < s; ++j)
      for (unsigned int k = 0; k < n_states(); ++k)
        x[k] -= step.state_by_force(k, j) * f[j];
  }

  const PeriodMap::Step &PeriodMap::step_of_level(const unsigned int level) const
  {
    while (level > 0 && finer.size() < level)
      finer.push_back(make_step(std::ldexp(full->length, -static_cast<int>(finer.size()) - 1)));
    return level > 0 ? *finer[level - 1] : *full;
  }

  double PeriodMap::roughness(const State &f) const
  {
    double largest = 0, rest = 0;
    for (const double value : f)
      largest = std::max(largest, std::abs(value));
    // f = sum a_k P_k(2 y - 1), a_k = (2 k + 1) int f P_k dy: they fall geometrically once the polynomial follows the
    // force
    for (unsigned int k = rule.s - 2; k < rule.s; ++k)
    {
      double coefficient = 0;
      for (unsigned int i = 0; i < rule.s; ++i)
        coefficient += (2 * k + 1) * rule.weight[i] * boost::math::legendre_p(k, 2 * rule.node[i] - 1) * f[i];
      rest = std::max(rest, std::abs(coefficient));
    }
    // below it the force is the rounding of displacements
    const double direct = touch_compliance + (relaxed && !slaved ? 0. : S);
    const double rounding = 1e-14 * (std::abs(U) + std::abs(gap)) / direct;
    return rest > rounding ? rest / largest : 0.;
  }

  void PeriodMap::vary_free(const double t, DenseMatrix &M) const
  {
    const unsigned int m = n_states();
    std::vector<FreeMode> modes(n);
    for (unsigned int k = 0; k < n; ++k)
      modes[k] = free_mode(body.omega[k], body.damping_ratio[k], t);
    for (unsigned int j = 0; j < m; ++j)
    {
      double *const column = &M(0, j);
      for (unsigned int k = 0; k < n; ++k)
      {
        const double q = column[k], v = column[n + k];
        column[k] = modes[k].qq * q + modes[k].qv * v;
        column[n + k] = modes[k].vq * q + modes[k].vv * v;
      }
      if (relaxed)
        column[2 * n] *= std::exp(-t / beta);
    }
  }

  /// (G + S_d + d'(f)) df = by_state dx, then dx at the end: the derivative of what contact_step() has solved.
  void PeriodMap::vary_contact(const Step &step, const State &f, DenseMatrix &M) const
  {
    const unsigned int m = n_states();
    DenseMatrix inverse = step.inverse;
    if (!law->is_linear())
    {
      inverse = step.by_force;
      for (unsigned int i = 0; i < rule.s; ++i)
        inverse(i, i) += law->compression(f[i]).compliance;
      inverse.invert();
    }
    const DenseMatrix forces = product(inverse, product(step.by_state, M));
    for (unsigned int j = 0; j < m; ++j)
    {
      double *const column = &M(0, j);
      for (unsigned int k = 0; k < n; ++k)
      {
        const FreeMode &mode = step.end.free[k];
        const double q = column[k], v = column[n + k];
        column[k] = mode.qq * q + mode.qv * v;
        column[n + k] = mode.vq * q + mode.vv * v;
      }
      if (relaxed)
        column[2 * n] *= step.end.relaxation;
      for (unsigned int i = 0; i < rule.s; ++i)
      {
        const double df = forces(i, j);
        const double *const by = &step.state_by_force(0, i);
        for (unsigned int k = 0; k < m; ++k)
          column[k] -= by[k] * df;
      }
    }
  }
} // namespace vibrocontact

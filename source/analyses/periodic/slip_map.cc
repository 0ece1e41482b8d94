#include <vibrocontact/analyses/periodic/shooting.h>
#include <vibrocontact/analyses/periodic/slip_map.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// samples beside a contact at which it may begin or end otherwise, one in so many of a period
    constexpr unsigned int margin_part = 256, least_margin = 4;
    /// of Newton's method: steps, where it ends, and the largest correction that is one
    constexpr unsigned int most_corrections = 20;
    constexpr double closed = 1e-8, largest_correction = 0.03;
  } // namespace

  SlipMap::SlipMap(const ForcedBody &body, const std::vector<double> &friction, const HarmonicForce &force,
                   const unsigned int n_samples, const double phase, const unsigned int first,
                   const unsigned int parts)
      : body(body), force(force), n(body.n_modes()), rows(body.n_contact_rows()), n_points(body.n_points()),
        count(n_samples), first(first), parts(parts), phase(phase),
        points(body.contact_residual(), body.rows_per_point, friction),
        status(n_points * n_samples, ContactStatus::open), here(n_points), w(rows), p(rows),
        rates(rows * rows), by_w(rows, n_states()), by_p(rows, n_states())
  {
    if (!resolves(body, force.frequency, count))
      throw ConvergenceError(
          "The modes move a contact point by more than its residual flexibility between two "
          "samples of the period: give more samples or fewer modes.");
    const double Omega = 2 * M_PI * force.frequency;
    for (unsigned int m = 0; m < n; ++m)
    {
      const double omega = body.omega[m];
      mode_answer.push_back(
          force.amplitude * body.modal_force(m) /
          Complex(omega * omega - Omega * Omega, 2 * body.damping_ratio[m] * omega * Omega));
      mode_rest.push_back(body.modal_load[m] == 0 ? 0. : body.modal_load[m] / (omega * omega));
    }
    for (unsigned int i = 0; i < rows; ++i)
    {
      row_answer.emplace_back(body.residual_force(i) * force.amplitude);
      row_rest.push_back(body.residual_load[i]);
      for (unsigned int m = 0; m < n; ++m)
      {
        row_answer[i] += body.trace(i, m) * mode_answer[m];
        row_rest[i] += body.trace(i, m) * mode_rest[m];
      }
    }
  }

  bool SlipMap::resolves(const ForcedBody &body, const double frequency, const unsigned int n_samples)
  {
    const double dt = 1 / (frequency * n_samples);
    bool result = true;
    for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
    {
      double mobility = 0;
      for (unsigned int m = 0; m < body.n_modes(); ++m)
        mobility += body.trace(i, m) * body.trace(i, m);
      result = result && mobility * dt * dt <= body.residual(i, i);
    }
    return result;
  }

  std::vector<double> SlipMap::without_contact(const double at_phase) const
  {
    const double Omega = 2 * M_PI * force.frequency;
    const Complex turn = std::polar(1., 2 * M_PI * at_phase + force.phase);
    std::vector<double> x(2 * n);
    for (unsigned int m = 0; m < n; ++m)
    {
      x[m] = mode_rest[m] + (mode_answer[m] * turn).imag();
      x[n + m] = Omega * (mode_answer[m] * turn).real();
    }
    return x;
  }

  double SlipMap::size(const std::vector<double> &x) const
  {
    double squares = 0;
    for (unsigned int m = 0; m < n; ++m)
      squares += std::pow(body.omega[m] * x[m], 2) + std::pow(x[n + m], 2);
    return std::sqrt(squares);
  }

  void SlipMap::fly(const double t, std::vector<double> &x, DenseMatrix *const X)
  {
    std::vector<FreeMode> &free = flights[t];
    for (unsigned int m = free.size(); m < n; ++m)
      free.push_back(free_mode(body.omega[m], body.damping_ratio[m], t));
    const auto move = [&](double *const column)
    {
      for (unsigned int m = 0; m < n; ++m)
      {
        const double q = column[m], v = column[n + m];
        column[m] = free[m].qq * q + free[m].qv * v;
        column[n + m] = free[m].vq * q + free[m].vv * v;
      }
    };
    move(x.data());
    for (unsigned int j = 0; X && j < n_states(); ++j)
      move(&(*X)(0, j));
  }

  bool SlipMap::meet(const double at_phase, const double interval, std::vector<double> &x,
                     DenseMatrix *const X)
  {
    const Complex turn = std::polar(1., 2 * M_PI * at_phase + force.phase);
    bool touches = false, solved = true;
    for (unsigned int i = 0; i < rows; ++i)
    {
      w[i] = row_rest[i] + (row_answer[i] * turn).imag();
      for (unsigned int m = 0; m < n; ++m)
        w[i] += body.trace(i, m) * x[m];
      touches = touches || (points.is_normal(i) && w[i] > body.gap[i / body.rows_per_point]);
    }
    if (touches)
    {
      solved = points.solve(w, &x[2 * n], body.gap, p) && (!X || points.rates(rates.data()));
      here = points.status();
    }
    else
    {
      std::fill(here.begin(), here.end(), ContactStatus::open);
      std::fill(rates.begin(), rates.end(), 0.);
      std::fill(p.begin(), p.end(), 0.);
    }
    for (unsigned int i = 0; i < rows; ++i)
    {
      x[2 * n + i] = w[i];
      for (unsigned int l = 0; l < rows; ++l)
        x[2 * n + i] += points.S(i, l) * p[l];
      for (unsigned int m = 0; m < n; ++m)
        x[n + m] += body.trace(i, m) * interval * p[i];
    }
    if (X)
      vary(interval, *X);
    return solved;
  }

  /// The derivative through a node, with the rates of its forces.
  void SlipMap::vary(const double interval, DenseMatrix &X)
  {
    for (unsigned int j = 0; j < n_states(); ++j)
    {
      double *const column = &X(0, j), *const dw = &by_w(0, j), *const dp = &by_p(0, j);
      for (unsigned int i = 0; i < rows; ++i)
        dw[i] = dp[i] = 0;
      for (unsigned int m = 0; m < n; ++m)
        for (unsigned int i = 0; i < rows; ++i)
          dw[i] += body.trace(i, m) * column[m];
      for (unsigned int i = 0; i < rows; ++i)
        for (unsigned int l = 0; l < rows; ++l)
          dp[i] += rates[i * rows + l] * (dw[l] - (points.is_normal(l) ? 0. : column[2 * n + l]));
      for (unsigned int i = 0; i < rows; ++i)
      {
        column[2 * n + i] = dw[i];
        for (unsigned int l = 0; l < rows; ++l)
          column[2 * n + i] += points.S(i, l) * dp[l];
      }
      for (unsigned int m = 0; m < n; ++m)
        for (unsigned int i = 0; i < rows; ++i)
          column[n + m] += body.trace(i, m) * interval * dp[i];
    }
  }

  bool SlipMap::advance(std::vector<double> &x, DenseMatrix *const X)
  {
    const double dt = 1 / (force.frequency * count);
    const auto sample = [&](const unsigned int k) { return (first + k) % count; };
    const unsigned int margin = std::max(count / margin_part, least_margin);
    // samples near a contact; intervals behind them that are to be divided
    std::vector<char> near(count, 0), changes(count, 0);
    for (unsigned int k = 0; k < count; ++k)
      for (unsigned int i = 0; i < n_points; ++i)
      {
        if (status[i * count + k] != ContactStatus::open)
          for (unsigned int j = 0; j <= 2 * margin; ++j)
            near[(k + count - margin + j) % count] = 1;
        if (status[i * count + k] != status[i * count + (k + 1) % count])
          for (const unsigned int j : {k + count - 1, k, k + 1})
            changes[j % count] = 1;
      }
    if (X)
    {
      X->reinit(n_states(), n_states());
      for (unsigned int i = 0; i < n_states(); ++i)
        (*X)(i, i) = 1;
    }
    std::fill(p.begin(), p.end(), 0.);
    bool solved = true;
    as_expected = true;
    std::vector<ContactStatus> found(status.size(), ContactStatus::open), last(n_points, ContactStatus::open);
    double behind = 0.5, before = 1;
    for (unsigned int k = 0; k < count; ++k)
    {
      if (!near[sample(k)])
      {
        behind += 1;
        before = 1;
        std::fill(last.begin(), last.end(), ContactStatus::open);
        continue;
      }
      const bool is_divided = changes[sample(k)] && k + 1 < count;
      const unsigned int nodes = is_divided ? parts : 1;
      const double after = 1. / nodes;
      for (unsigned int node = 0; node < nodes; ++node)
      {
        fly(behind * dt, x, X);
        solved =
            meet(phase + (first + k + node * after) / count, 0.5 * (before + after) * dt, x, X) && solved;
        if (before == 1 && node == 0 && k > 0)
          as_expected = as_expected && here == last;
        last = here;
        if (node == 0)
          for (unsigned int i = 0; i < n_points; ++i)
            found[i * count + sample(k)] = here[i];
        behind = before = after;
      }
    }
    fly((behind - 0.5) * dt, x, X);
    status = found;
    return solved;
  }

  SlipMultipliers slip_multipliers(SlipMap &map, std::vector<double> state)
  {
    const unsigned int n = map.n_states();
    SlipMultipliers result;
    DenseMatrix monodromy, factors(n, n);
    std::vector<double> x = state;
    const double scale = map.size(map.without_contact(map.begin())) + map.size(state);
    bool solved = map.advance(x, &monodromy);
    result.values = floquet_multipliers(monodromy);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        factors(i, j) = (i == j) - monodromy(i, j);
    try
    {
      factors.compute_lu_factorization();
    }
    catch (const dealii::ExceptionBase &)
    {
      return result;
    }
    double moved = 0, step = 1;
    for (unsigned int correction = 0; correction < most_corrections && solved; ++correction)
    {
      DenseVector change(n);
      for (unsigned int j = 0; j < n; ++j)
        change[j] = x[j] - state[j];
      factors.solve(change);
      for (unsigned int j = 0; j < n; ++j)
        state[j] += change[j];
      step = map.size(std::vector<double>(change.begin(), change.end())) / scale;
      moved += step;
      if (!(moved < largest_correction))
        return result;
      x = state;
      if (step < closed && map.was_expected())
      {
        if (map.advance(x, &monodromy))
          result = {floquet_multipliers(monodromy), moved};
        return result;
      }
      solved = map.advance(x, nullptr);
    }
    return result;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/periodic/period_map.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>

#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
    /// halvings of a step
    constexpr unsigned int deepest_level = 40;

    /// zero of a function between places where it has different signs
    template <typename Function>
    double root(const Function &f, const double a, const double b, const double fa, const double fb)
    {
      if (fa == 0 || fb == 0)
        return fa == 0 ? a : b;
      boost::uintmax_t iterations = 200;
      const auto bracket = boost::math::tools::toms748_solve(
          f, a, b, fa, fb, boost::math::tools::eps_tolerance<double>(52), iterations);
      return 0.5 * (bracket.first + bracket.second);
    }
  } // namespace

  /// Answers over a contact step of one length.
  struct PeriodMap::Step
  {
    double length;
    /// at the Gauss points
    std::vector<ForceAnswer> nodes;
    ForceAnswer end;
    /// drive at the Gauss points by state, s x n_states [1]; by force, s square [m/N]; for linear laws the forces by
    /// the drive
    DenseMatrix by_state, by_force, inverse;
    /// state at the end by force (subtracted), n_states x s
    DenseMatrix state_by_force;
  };

  PeriodMap::~PeriodMap() = default;

  PeriodMap::PeriodMap(const ForcedBody &body, std::shared_ptr<const NormalLaw> law,
                       const HarmonicForce &force, const unsigned int n_steps, const unsigned int n_nodes,
                       const double accuracy)
      : body(body), law(law), touch_compliance(law->compression(0).compliance), force(force),
        n(body.n_modes()), steps(n_steps), accuracy(accuracy), rule(n_nodes), T(1 / force.frequency),
        Omega(2 * std::acos(-1.) * force.frequency), gap(body.gap.at(0)), S(body.residual(0, 0))
  {
    if (body.n_contact_rows() != 1)
      throw InputError(
          "References in time by shooting take one contact point without friction, but the body has " +
          std::to_string(body.n_contact_rows()) + " contact rows: keep one point, friction 0.");
    const bool has_residual = S != 0 || body.residual_force(0) != 0 || body.residual_load[0] != 0;
    relaxed = has_residual && body.relaxation > 0;
    if (relaxed)
      beta = body.relaxation;
    if (law->is_rigid() && !(S > 0))
      throw InputError("The exact law needs a massless contact node, which this body has not: give it one or "
                       "take a penalty law.");
    slaved = relaxed && law->is_rigid();
    // the steady motion under F sin(Omega t) = Im F e^(j Omega t): residual R, modes Q, contact point U = sum b Q + R,
    // drive E, which at the rigid stop has sum b (q + beta q') and the residual without its delay
    R = body.residual_force(0) * force.amplitude / Complex(1, Omega * beta);
    r_load = body.residual_load[0];
    U = R;
    E = slaved ? body.residual_force(0) * force.amplitude : R;
    u_load = e_load = r_load;
    for (unsigned int k = 0; k < n; ++k)
    {
      const double w = body.omega[k], b = body.trace(0, k);
      const Complex stiffness(w * w - Omega * Omega, 2 * body.damping_ratio[k] * w * Omega);
      const double p = body.modal_force(k) * force.amplitude;
      if (p != 0 && std::abs(stiffness) < 1e-12 * Omega * Omega)
        throw InputError("An undamped mode is excited at its own frequency: damp it or move the force.");
      Q.push_back(p == 0 ? Complex(0) : p / stiffness);
      q_load.push_back(w > 0 ? body.modal_load[k] / (w * w) : 0.);
      if (w == 0)
        rigid_load += b * body.modal_load[k];
      U += b * Q[k];
      E += b * Q[k] * (slaved ? Complex(1, Omega * beta) : Complex(1));
      u_load += b * q_load[k];
      e_load += b * q_load[k];
    }
    full = make_step(T / steps);
  }

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

  std::vector<double> PeriodMap::steady_off_resonance(const double phase) const
  {
    constexpr double nearest = 1e-4;
    std::vector<double> x = steady(phase);
    for (unsigned int k = 0; k < n; ++k)
    {
      const double w = body.omega[k];
      const Complex stiffness(w * w - Omega * Omega, 2 * body.damping_ratio[k] * w * Omega);
      if (std::abs(stiffness) < nearest * Omega * Omega)
        x[k] = x[n + k] = 0;
    }
    return x;
  }

  std::vector<double> PeriodMap::steady(const double phase) const
  {
    std::vector<double> x(n_states());
    const Complex turn = std::polar(1., 2 * std::acos(-1.) * (phase - std::floor(phase)));
    for (unsigned int k = 0; k < n; ++k)
    {
      x[k] = (Q[k] * turn).imag() + q_load[k];
      x[n + k] = Omega * (Q[k] * turn).real();
    }
    if (relaxed)
      x[2 * n] = (R * turn).imag() + r_load;
    return x;
  }

  double PeriodMap::norm(const std::vector<double> &x) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < n; ++k)
      sum += std::pow(std::max(body.omega[k], Omega) * x[k], 2) + x[n + k] * x[n + k];
    if (relaxed && S > 0)
      sum += x[2 * n] * x[2 * n] / S;
    return std::sqrt(sum);
  }

  void PeriodMap::move_free(const std::vector<FreeMode> &modes, const double relaxation, const double t,
                            State &x) const
  {
    for (unsigned int k = 0; k < n; ++k)
    {
      const double q = x[k], v = x[n + k];
      x[k] = modes[k].qq * q + modes[k].qv * v;
      x[n + k] = modes[k].vq * q + modes[k].vv * v;
      if (body.omega[k] == 0)
      {
        x[k] += 0.5 * body.modal_load[k] * t * t;
        x[n + k] += body.modal_load[k] * t;
      }
    }
    if (relaxed)
      x[2 * n] *= relaxation;
  }

  void PeriodMap::free_flight(const double t, State &x) const
  {
    std::vector<FreeMode> modes(n);
    for (unsigned int k = 0; k < n; ++k)
      modes[k] = free_mode(body.omega[k], body.damping_ratio[k], t);
    move_free(modes, relaxed ? std::exp(-t / beta) : 0., t, x);
  }

  double PeriodMap::tip(const State &x, const double t) const
  {
    double u = (U * std::polar(1., Omega * t)).imag() + u_load - gap + (relaxed ? x[2 * n] : 0.);
    for (unsigned int k = 0; k < n; ++k)
      u += body.trace(0, k) * x[k];
    return u;
  }

  double PeriodMap::tip_rate(const State &x, const double t) const
  {
    double v = Omega * (U * std::polar(1., Omega * t)).real() - (relaxed ? x[2 * n] / beta : 0.);
    for (unsigned int k = 0; k < n; ++k)
      v += body.trace(0, k) * x[n + k];
    return v;
  }

  double PeriodMap::drive(const State &x, const double t) const
  {
    if (!slaved)
      return tip(x, t);
    double e = (E * std::polar(1., Omega * t)).imag() + e_load - gap;
    for (unsigned int k = 0; k < n; ++k)
      e += body.trace(0, k) * (x[k] + beta * x[n + k]);
    return e;
  }

  // without contact force
  double PeriodMap::drive_rate(const State &x, const double t) const
  {
    if (!slaved)
      return tip_rate(x, t);
    double rate = Omega * (E * std::polar(1., Omega * t)).real();
    for (unsigned int k = 0; k < n; ++k)
    {
      const double w = body.omega[k];
      const double acceleration =
          -w * (w * x[k] + 2 * body.damping_ratio[k] * x[n + k]) + (w == 0 ? body.modal_load[k] : 0.);
      rate += body.trace(0, k) * (x[n + k] + beta * acceleration);
    }
    return rate;
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

  /// The residual that keeps the contact point on the rigid stop, r = gap - sum b q: x is corrected to tip(x, t) = 0.
  void PeriodMap::follow_stop(const double t, State &x) const
  {
    x[2 * n] = 0;
    x[2 * n] = -tip(x, t);
  }

  /// dr = -sum b dq
  void PeriodMap::vary_follow_stop(DenseMatrix &M) const
  {
    for (unsigned int j = 0; j < n_states(); ++j)
    {
      M(2 * n, j) = 0;
      for (unsigned int k = 0; k < n; ++k)
        M(2 * n, j) -= body.trace(0, k) * M(k, j);
    }
  }

  /// Flies in steps of T / n_steps until the gap closes or `end`; x and t are those of the touch then. A touch is
  /// bracketed by a step that ends beyond the stop, or by one with a peak beyond it between its ends. `fresh`: just
  /// released, so that the gap at t is zero to rounding and no sign can be had from it.
  /// @return whether it touched
  bool PeriodMap::flight(double &t, const double end, bool fresh, State &x, Orbit *orbit) const
  {
    const double rounding = 1e-14 * (std::abs(U) + std::abs(u_load) + std::abs(gap));
    double a = t;
    while (a < end)
    {
      const bool whole = a + full->length <= end;
      const double length = whole ? full->length : end - a, b = whole ? a + length : end;
      State next = x;
      if (whole)
        move_free(full->end.free, full->end.relaxation, length, next);
      else
        free_flight(length, next);
      const auto moved = [&](const double tau)
      {
        State y = x;
        free_flight(tau, y);
        return y;
      };
      const auto g = [&](const double tau) { return tip(moved(tau), a + tau); };
      const auto rate = [&](const double tau) { return tip_rate(moved(tau), a + tau); };
      const double ga = tip(x, a), gb = tip(next, b), va = tip_rate(x, a), vb = tip_rate(next, b);
      double open = fresh ? -1 : 0, touch = gb > rounding ? length : -1;
      // a peak reaches the stop only from an end that is within about this distance of it
      const double span = std::max(std::abs(va), std::abs(vb)) * length;
      if (touch < 0 && va > 0 && vb < 0 && std::min(-ga, -gb) < 2 * span)
      {
        const double top = root(rate, 0., length, va, vb);
        if (g(top) > rounding)
          touch = top;
      }
      if (touch > 0)
      {
        // after a release the gap begins with zero: the bracket begins where it is open, sought by halving towards t
        for (unsigned int j = 1; j < 45 && open < 0; ++j)
          if (g(std::ldexp(touch, -static_cast<int>(j))) < 0)
            open = std::ldexp(touch, -static_cast<int>(j));
        const double tau =
            open < 0 || (open == 0 && ga >= 0) ? 0 : root(g, open, touch, open == 0 ? ga : g(open), g(touch));
        if (orbit)
          orbit->pieces.push_back({a, tau, false, x, {}});
        free_flight(tau, x);
        t = a + tau;
        return true;
      }
      if (orbit)
        orbit->pieces.push_back({a, length, false, x, {}});
      x = next;
      a = b;
      fresh = false;
    }
    t = end;
    return false;
  }

  /// One step in contact, of T / n_steps / 2^level: the level rises until the polynomial follows the force
  /// (roughness()), and falls by one where it does so with much to spare. If force or drive change their sign in it the
  /// step ends there.
  /// @return whether it released
  bool PeriodMap::contact(double &t, const double end, unsigned int &level, State &x, DenseMatrix *variation,
                          Orbit *orbit) const
  {
    std::unique_ptr<Step> own;
    const Step *step = nullptr;
    State next, f;
    bool whole = true;
    for (bool smooth = false; !smooth; level += !smooth)
    {
      whole = t + std::ldexp(full->length, -static_cast<int>(level)) <= end;
      if (!whole)
        own = make_step(end - t);
      step = whole ? &step_of_level(level) : own.get();
      next = x;
      contact_step(*step, t, next, f);
      const double rest = roughness(f);
      smooth = rest <= accuracy || level == deepest_level;
      if (smooth && level > 0 && rest < 1e-3 * accuracy)
      {
        --level;
        break;
      }
    }
    const double first = drive(x, t);
    double e = drive(next, t + step->length);
    bool released = false;
    if (e < 0 || *std::min_element(f.begin(), f.end()) < 0)
    {
      // First zero crossing of the polynomial of the force, as a part of the step's length. Beyond the release the force
      // should be none, so the polynomial is right only on a step that ends there: shortened to the crossing and solved
      // again until its length has settled. Then Newton's method on drive(length) = 0 finds the release to round-off.
      const unsigned int n_places = 4 * rule.s;
      const auto value = [&](const double y)
      {
        double sum = 0;
        const std::vector<double> l = rule.lagrange(y);
        for (unsigned int j = 0; j < rule.s; ++j)
          sum += l[j] * f[j];
        return sum;
      };
      double length = step->length;
      for (unsigned int pass = 0; pass < 60 && !released; ++pass)
      {
        double high = -1, fall = 1;
        if (value(0) > 0)
          high = 0;
        for (unsigned int k = 1; k <= n_places; ++k)
        {
          const double y = double(k) / n_places, here = value(y);
          if (here > 0)
            high = y;
          else if (high >= 0)
          {
            fall = root(value, high, y, value(high), here);
            break;
          }
        }
        // negative throughout: the contact is too short for this polynomial
        if (high < 0)
          fall = 1. / 16;
        const double before = length;
        length *= fall;
        if (length < 1e-13 * T || (first <= 0 && high < 0 && pass > 40))
        {
          length = 0;
          break;
        }
        next = x;
        own = make_step(length);
        contact_step(*own, t, next, f);
        step = own.get();
        released = high >= 0 && std::abs(length - before) < 1e-3 * length;
      }
      if (!released)
      {
        // it lasts less than time can tell: released where it touched
        if (orbit)
          orbit->releases.push_back(t);
        return true;
      }
      double size = 0;
      for (const double value : f)
        size = std::max(size, std::abs(value) * (S + touch_compliance));
      for (unsigned int pass = 0; pass < 8; ++pass)
      {
        e = drive(next, t + length);
        const double change = -e / drive_rate(next, t + length);
        if (std::abs(change) < 2e-16 * T || !(std::abs(change) < 0.5 * length) || std::abs(e) < 1e-16 * size)
          break;
        length += change;
        own = make_step(length);
        next = x;
        contact_step(*own, t, next, f);
        step = own.get();
      }
    }
    if (orbit)
    {
      orbit->pieces.push_back({t, step->length, true, x, f});
      for (unsigned int i = 0; i < rule.s; ++i)
        orbit->impulse += rule.weight[i] * step->length * f[i];
    }
    if (variation)
      vary_contact(*step, f, *variation);
    x = next;
    t = whole || released ? t + step->length : end;
    if (slaved)
    {
      follow_stop(t, x);
      if (variation)
        vary_follow_stop(*variation);
    }
    if (released && orbit)
      orbit->releases.push_back(t);
    return released;
  }

  std::vector<double> PeriodMap::advance(const std::vector<double> &start, const double phase,
                                         const double periods, DenseMatrix *variation, Orbit *orbit) const
  {
    // x is the deviation from the steady motion without contact, which moves freely in flight; its variation is that of
    // the state
    State x = start;
    const unsigned int m = n_states();
    const State from = steady(phase);
    for (unsigned int k = 0; k < m; ++k)
      x[k] -= from[k];
    if (variation)
    {
      variation->reinit(m, m);
      for (unsigned int k = 0; k < m; ++k)
        (*variation)(k, k) = 1;
    }
    double t = phase * T;
    const double end = t + periods * T;
    const double rounding = 1e-12 * (std::abs(U) + std::abs(gap));
    bool closed = slaved ? tip(x, t) >= -rounding && drive(x, t) > 0 : drive(x, t) > 0;
    if (closed && slaved)
    {
      follow_stop(t, x);
      if (variation)
        vary_follow_stop(*variation);
    }
    bool fresh = false;
    unsigned int n_events = 0, level = 0;
    while (t < end && end - t > 1e-15 * T)
    {
      if (!closed)
      {
        const double begin = t;
        closed = flight(t, end, fresh, x, orbit);
        if (variation)
          vary_free(t - begin, *variation);
        level = 0;
        if (closed && orbit)
          orbit->touches.push_back(t);
        if (closed && slaved)
        {
          // The force jumps to beta u' / S. A variation touches earlier or later by dt = -(sum b dq + dr) / u', and this
          // jump acts on the modes for that long: dq' += b (beta u' / S) dt.
          if (variation)
            for (unsigned int j = 0; j < m; ++j)
            {
              double tip_variation = (*variation)(2 * n, j);
              for (unsigned int k = 0; k < n; ++k)
                tip_variation += body.trace(0, k) * (*variation)(k, j);
              for (unsigned int k = 0; k < n; ++k)
                (*variation)(n + k, j) -= body.trace(0, k) * beta / S * tip_variation;
            }
          follow_stop(t, x);
          if (variation)
            vary_follow_stop(*variation);
        }
        ++n_events;
      }
      else
      {
        fresh = contact(t, end, level, x, variation, orbit);
        closed = !fresh;
        n_events += fresh;
      }
      if (n_events > 10000 * (1 + periods) || !std::isfinite(x[0]))
        throw ConvergenceError("The motion of the time reference is not finite or its contacts do not stop "
                               "following each other.");
    }
    const State to = steady(phase + periods);
    for (unsigned int k = 0; k < m; ++k)
      x[k] += to[k];
    return x;
  }

  MotionSample PeriodMap::sample(const double t, const State &x, const double f, const bool in_contact) const
  {
    MotionSample s;
    const Complex turn = std::polar(1., Omega * t);
    s.force = f;
    s.q.resize(n);
    s.v.resize(n);
    double modal = 0, modal_rate = 0;
    for (unsigned int k = 0; k < n; ++k)
    {
      s.q[k] = x[k] + (Q[k] * turn).imag() + q_load[k];
      s.v[k] = x[n + k] + Omega * (Q[k] * turn).real();
      s.energy += 0.5 * (s.v[k] * s.v[k] + std::pow(body.omega[k] * s.q[k], 2));
      modal += body.trace(0, k) * s.q[k];
      modal_rate += body.trace(0, k) * s.v[k];
    }
    const double forced = body.residual_force(0) * force.amplitude, without = forced * turn.imag() + r_load;
    double rate = 0;
    if (slaved && in_contact)
    {
      s.residual = gap - modal;
      rate = -modal_rate;
    }
    else if (relaxed)
    {
      s.residual = x[2 * n] + (R * turn).imag() + r_load;
      rate = (without - s.residual - S * f) / beta;
    }
    else
    {
      s.residual = without - S * f;
      rate = forced * Omega * turn.real();
      // (S + d'(f)) f' = velocity of the drive
      if (f > 0)
        rate -= S * (modal_rate + rate) / (S + law->compression(f).compliance);
    }
    s.displacement = modal + s.residual;
    s.velocity = modal_rate + rate;
    if (S > 0)
      s.energy += 0.5 * s.residual * s.residual / S;
    if (f > 0)
      s.energy += law->potential(-law->compression(f).depth);
    return s;
  }

  MotionSample PeriodMap::at(const Orbit &orbit, const double phase) const
  {
    const double begin = orbit.pieces.front().begin;
    double t = (phase - std::floor(phase)) * T;
    t += T * std::ceil((begin - t) / T);
    auto piece = std::upper_bound(orbit.pieces.begin(), orbit.pieces.end(), t,
                                  [](const double time, const OrbitPiece &p) { return time < p.begin; });
    if (piece != orbit.pieces.begin())
      --piece;
    const double tau = std::min(t - piece->begin, piece->length);
    State x = piece->state;
    if (!piece->contact)
    {
      free_flight(tau, x);
      return sample(t, x, 0., false);
    }
    const double y = piece->length > 0 ? tau / piece->length : 0.;
    const ForceAnswer at = answer_to_force(body, rule, piece->length, y, beta);
    move_free(at.free, at.relaxation, tau, x);
    const unsigned int s = rule.s;
    for (unsigned int j = 0; j < s; ++j)
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        x[k] -= body.trace(0, k) * at.displacement[k * s + j] * piece->force[j];
        x[n + k] -= body.trace(0, k) * at.velocity[k * s + j] * piece->force[j];
      }
      if (relaxed)
        x[2 * n] -= S * at.residual[j] * piece->force[j];
    }
    return sample(t, x, std::max(0., force_of_drive(drive(x, t))), true);
  }

  void PeriodMap::integrate(const Orbit &orbit,
                            const std::function<void(double, const MotionSample &)> &add) const
  {
    const unsigned int s = rule.s;
    for (const OrbitPiece &piece : orbit.pieces)
    {
      const Step *known = piece.length == full->length ? full.get() : nullptr;
      for (const std::unique_ptr<Step> &level : finer)
        if (level->length == piece.length)
          known = level.get();
      std::unique_ptr<Step> own;
      if (!known && piece.length > 0)
        own = make_step(piece.length);
      const Step &step = known ? *known : *own;
      for (unsigned int i = 0; i < s && piece.length > 0; ++i)
      {
        State x = piece.state;
        const ForceAnswer &at = step.nodes[i];
        const double tau = rule.node[i] * piece.length;
        move_free(at.free, at.relaxation, tau, x);
        for (unsigned int j = 0; j < s && piece.contact; ++j)
        {
          for (unsigned int k = 0; k < n; ++k)
          {
            x[k] -= body.trace(0, k) * at.displacement[k * s + j] * piece.force[j];
            x[n + k] -= body.trace(0, k) * at.velocity[k * s + j] * piece.force[j];
          }
          if (relaxed)
            x[2 * n] -= S * at.residual[j] * piece.force[j];
        }
        add(rule.weight[i] * piece.length,
            sample(piece.begin + tau, x, piece.contact ? piece.force[i] : 0., piece.contact));
      }
    }
  }
} // namespace vibrocontact

// PeriodMap between touch and release: where these lie, and how far the stop leads.
#include <vibrocontact/analyses/periodic/period_map.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
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
} // namespace vibrocontact

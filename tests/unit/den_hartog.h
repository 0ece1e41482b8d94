#pragma once

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  /// One mass on a spring with Coulomb friction under a harmonic force (Den Hartog 1931), with or without elastic stops,
  ///
  ///   m x'' + k x + R sign(x') + k_s max(x - g, 0) [- k_s max(-x - g, 0)] = F sin(2 pi f t)
  ///
  /// [kg], [N/m], [N], [Hz], [m]. Exact motion: linear between changes of slip, stick and contact, which are located
  /// to round-off.
  struct DenHartog
  {
    double mass = 1, stiffness = 1, friction = 0, force = 1, frequency = 1;
    double gap = std::numeric_limits<double>::infinity(), stop_stiffness = 0;
    /// a stop at -g as well
    bool both_sides = false;

    /// Amplitude of the motion without stops and without sticking, closed form:
    /// F/k sqrt(V^2 - (R/F)^2 U^2), V = 1/(1 - r^2), U = sin(pi/r)/(r (1 + cos(pi/r))), r = Omega/sqrt(k/m).
    double closed_form() const
    {
      const double pi = std::acos(-1.), r = 2 * pi * frequency / std::sqrt(stiffness / mass);
      const double V = 1 / (1 - r * r), U = std::sin(pi / r) / (r * (1 + std::cos(pi / r)));
      return force / stiffness * std::sqrt(V * V - std::pow(friction / force * U, 2));
    }

    /// What the last period of the settled motion does: extremes [m]; work of the force, loss by friction [J]; time in
    /// stick over the period; change of the state over the period, relative.
    struct Settled
    {
      double largest, smallest, work, loss, sticking, change;
    };

    /// From rest at 0 over so many periods.
    Settled settle(const unsigned int n_periods) const
    {
      double t = 0, x = 0, v = 0;
      // -1, 0, 1: direction of slip, side of contact
      int slip = 0, side = 0;
      Settled s{};
      const double T = 1 / frequency;
      for (unsigned int period = 0; period < n_periods; ++period)
      {
        const double x0 = x, v0 = v;
        s = {x, x, 0, 0, 0, 0};
        for (unsigned int k = 0; k < n_samples; ++k)
          move(t, (period + double(k + 1) / n_samples) * T, x, v, slip, side, s);
        s.change = std::hypot(x - x0, (v - v0) * T) / std::max(s.largest - s.smallest, 1e-300);
      }
      return s;
    }

  private:
    static constexpr unsigned int n_samples = 200;

    double Omega() const { return 2 * std::acos(-1.) * frequency; }
    /// force on the mass without friction
    double driving(const double t, const double x, const int side) const
    {
      return force * std::sin(Omega() * t) - stiffness * x -
             (side == 0 ? 0. : stop_stiffness * (x - side * gap));
    }

    void move(double &t, const double end, double &x, double &v, int &slip, int &side, Settled &s) const
    {
      const auto zero = [](const auto &f, const double a, const double b)
      {
        const double fa = f(a), fb = f(b);
        if (fa == 0 || fb == 0 || (fa < 0) == (fb < 0))
          return fb == 0 ? b : a;
        boost::uintmax_t n = 200;
        const auto at = boost::math::tools::toms748_solve(f, a, b, fa, fb,
                                                          boost::math::tools::eps_tolerance<double>(52), n);
        return 0.5 * (at.first + at.second);
      };
      for (unsigned int events = 0; t < end && events < 100; ++events)
      {
        if (slip == 0)
        {
          const auto excess = [&](const double at) { return std::abs(driving(at, x, side)) - friction; };
          if (excess(t) <= 0)
          {
            const double until = excess(end) > 0 ? zero(excess, t, end) : end;
            s.sticking += (until - t) * frequency;
            t = until;
            if (t >= end)
              return;
          }
          slip = driving(t + 1e-9 / frequency, x, side) > 0 ? 1 : -1;
        }
        const double k = stiffness + (side == 0 ? 0. : stop_stiffness), w = std::sqrt(k / mass), W = Omega();
        const double rest = (-friction * slip + (side == 0 ? 0. : stop_stiffness * side * gap)) / k;
        const double a = force / (k - mass * W * W);
        const double c = x - rest - a * std::sin(W * t), d = (v - a * W * std::cos(W * t)) / w, from = t;
        const auto place = [&](const double at) {
          return rest + a * std::sin(W * at) + c * std::cos(w * (at - from)) + d * std::sin(w * (at - from));
        };
        const auto speed = [&](const double at) {
          return a * W * std::cos(W * at) +
                 w * (d * std::cos(w * (at - from)) - c * std::sin(w * (at - from)));
        };
        double until = end;
        int what = 0;
        // speeds and places at the beginning of a stretch are zero but for rounding
        const double little = 1e-7 * (end - t);
        if (slip * speed(until) < 0)
        {
          until = zero(speed, from + little, until);
          what = 1;
        }
        const auto crossing = [&](const int of, const double sign)
        {
          const auto depth = [&](const double at) { return sign * (of * place(at) - gap); };
          if (depth(until) > 0)
          {
            until = depth(from + little) > 0 ? from + little : zero(depth, from + little, until);
            what = 2;
          }
        };
        if (stop_stiffness > 0 && side == 0)
        {
          crossing(1, 1);
          if (both_sides)
            crossing(-1, 1);
        }
        else if (stop_stiffness > 0)
          crossing(side, -1);
        // Simpson's rule on many intervals: work of the force, and what friction takes on the way
        const unsigned int n = 16;
        for (unsigned int i = 0; i <= n; ++i)
        {
          const double at = from + i * (until - from) / n;
          s.work += (i == 0 || i == n ? 1
                     : i % 2          ? 4
                                      : 2) *
                    (until - from) / (3 * n) * force * std::sin(W * at) * speed(at);
        }
        s.loss += friction * std::abs(place(until) - x);
        x = place(until);
        v = speed(until);
        t = until;
        s.largest = std::max(s.largest, x);
        s.smallest = std::min(s.smallest, x);
        if (what == 1)
        {
          v = 0;
          slip = 0;
        }
        if (what == 2)
          side = side != 0 ? 0 : x > 0 || !both_sides ? 1 : -1;
      }
    }
  };
} // namespace vibrocontact

#include <vibrocontact/analyses/periodic/period_map.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
  } // namespace

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
} // namespace vibrocontact

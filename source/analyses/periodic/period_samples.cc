// PeriodMap told at places of an orbit.
#include <vibrocontact/analyses/periodic/period_map.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
  } // namespace

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

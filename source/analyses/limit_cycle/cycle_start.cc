#include <vibrocontact/analyses/limit_cycle/cycle_start.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// periods before growth is measured, and those over which it is
    constexpr unsigned int settling = 2, measured = 2;
    constexpr double least_share_of_mean = 0.2;
    /// of a motion, over the least slip
    constexpr double rest = 1e-6;
    /// First velocity over the least slip: a little beyond, so that points stick. Factor to the next one if it grows there, and how
    /// many are tried at most, some 50 times the first.
    constexpr double first_velocity = 1.2, next_velocity = 1.4;
    constexpr unsigned int most_trials = 12;
    /// Newton's method begins where this share of the root's growth is left. Where nothing sticks all of it is left: from there it
    /// would go back to rest. A motion that decays has stuck; there a small change over a period is enough.
    constexpr double little_growth = 0.3, little_decay = 2e-3;
    /// Of starts by harmonics: how many, one first, whose basin is the largest; to what the laws have to be met, in so many iterations;
    /// velocities that are tried, and the factor between them. A motion of another size or period than tried belongs to another root, or is rest.
    constexpr unsigned int iterations_of_start = 12, trials_by_harmonics = 4;
    constexpr unsigned int harmonics_of_start[] = {1, 5};
    constexpr double tolerance_of_start = 1e-4, next_by_harmonics = 1.6, largest_change_of_velocity = 3,
                     largest_change_of_period = 0.2;
  } // namespace

  RootMotion::RootMotion(const CycleMap &map, const ContactPair &pair, const DynamicState &at_rest,
                         const StabilityRoot &root)
      : least_slip(std::numeric_limits<double>::max()), n_motion(map.n_motion()),
        equilibrium(map.pack(at_rest))
  {
    const unsigned int n = pair.n_points(), n_modes = pair.n_modes(), n_poles = pair.n_poles();
    const std::complex<double> lambda(root.growth, 2 * dealii::numbers::PI * root.frequency);
    double fastest = 0, weight = 0, mean_slip = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      if (!(at_rest.R[i] > 0))
        continue;
      const double slip = std::hypot(at_rest.contact.y[n + i], at_rest.contact.y[2 * n + i]);
      least_slip = std::min(least_slip, slip);
      weight += at_rest.R[i];
      mean_slip += at_rest.R[i] * slip;
      for (unsigned int c = 1; c < 3; ++c)
      {
        std::complex<double> velocity = 0;
        for (unsigned int k = 0; k < n_modes; ++k)
          velocity += pair.trace(contact_row(n, c, i), k) * lambda * root.shape[k];
        for (unsigned int k = 0; k < n_poles; ++k)
        {
          const std::complex<double> right = pair.right(contact_row(n, c, i), k);
          velocity += 2. * lambda * (right.real() * root.states[k] - right.imag() * root.states[n_poles + k]);
        }
        fastest = std::max(fastest, std::abs(velocity));
      }
    }
    // single points beside a centre of rotation hardly slip, and say little
    least_slip = std::max(least_slip, least_share_of_mean * mean_slip / weight);
    if (!(fastest > 0))
      throw ConvergenceError("the root does not move the contact along its surface");
    const auto moved = [&](const std::complex<double> factor)
    {
      DynamicState state = at_rest;
      for (unsigned int k = 0; k < n_modes; ++k)
      {
        state.q[k] += (factor * root.shape[k]).real() / fastest;
        state.v[k] += (factor * lambda * root.shape[k]).real() / fastest;
      }
      for (unsigned int k = 0; k < n_poles; ++k)
        state.z[k] += std::complex<double>((factor * root.states[k]).real(),
                                           (factor * root.states[n_poles + k]).real()) /
                      fastest;
      DenseVector change = map.pack(state);
      change -= equilibrium;
      return change;
    };
    shape = moved(1);
    later = moved({0, 1});
  }

  DenseVector RootMotion::state(const double velocity) const
  {
    DenseVector x = equilibrium;
    x.add(velocity, shape);
    return x;
  }

  void RootMotion::scale(DenseVector &state, const double velocity) const
  {
    const double factor = velocity / velocity_in(state);
    state.sadd(factor, 1 - factor, equilibrium);
  }

  std::complex<double> RootMotion::amplitude_in(const DenseVector &state) const
  {
    DenseVector change = state;
    change -= equilibrium;
    // forces are no part of the shape
    std::fill(change.begin() + n_motion, change.end(), 0.);
    return {change * shape / shape.norm_sqr(), change * later / later.norm_sqr()};
  }

  void let_go_on(CycleMap &map, const RootMotion &motion, const unsigned int n_periods, CycleStart &start)
  {
    constexpr double turn = 2 * dealii::numbers::PI;
    start.velocity = motion.velocity_in(start.state);
    double phases = 0;
    for (unsigned int p = 0; p < n_periods; ++p)
    {
      const double before = motion.phase_of(start.state);
      start.state = map.march(start.state, start.period, false);
      // beyond a whole turn, to the nearest
      phases += std::remainder(motion.phase_of(start.state) - before, turn);
    }
    const double time = n_periods * start.period;
    start.growth = std::log(motion.velocity_in(start.state) / start.velocity) / time;
    start.period = time / (n_periods + phases / turn);
  }

  namespace
  {
    /// The motion of few harmonics that a period leads to; nothing: Newton's method does not converge, or to one of another size or
    /// frequency.
    std::optional<CycleStart> balanced_from(CycleMap &map, const RootMotion &motion,
                                            const StabilityRoot &root, const DynamicState &at_rest,
                                            const CycleStart &now)
    {
      const CycleForces forces = forces_of_period(map, now.state, now.period);
      NewtonSettings settings;
      settings.max_iterations = iterations_of_start;
      std::vector<double> x;
      std::unique_ptr<CycleBalance> balance;
      for (const unsigned int n_harmonics : harmonics_of_start)
      {
        auto finer = std::make_unique<CycleBalance>(map.balance(at_rest, n_harmonics, tolerance_of_start));
        x = balance ? finer->extended(x, *balance)
                    : finer->unknowns(forces.forces, forces.approaches, now.period);
        balance = std::move(finer);
        if (!solve_by_newton(*balance, settings, x).converged)
          return {};
      }
      CycleStart found;
      found.state = map.pack(balance->motion(x, map.n_steps()).back());
      found.period = balance->period(x);
      found.velocity = motion.velocity_in(found.state);
      if (found.velocity > now.velocity / largest_change_of_velocity &&
          found.velocity < now.velocity * largest_change_of_velocity &&
          std::abs(found.period * root.frequency - 1) < largest_change_of_period)
        return found;
      return {};
    }
  } // namespace

  std::optional<CycleStart> start_by_harmonics(CycleMap &map, const RootMotion &motion,
                                               const StabilityRoot &root, const DynamicState &at_rest)
  {
    double velocity = first_velocity * motion.least_slip;
    CycleStart now;
    now.state = motion.state(velocity);
    for (unsigned int trial = 0; trial < trials_by_harmonics; ++trial, velocity *= next_by_harmonics)
      try
      {
        now.period = 1 / root.frequency;
        motion.scale(now.state, velocity);
        let_go_on(map, motion, settling, now);
        if (const std::optional<CycleStart> found = balanced_from(map, motion, root, at_rest, now))
          return found;
      }
      catch (const ConvergenceError &)
      {
        return {}; // a larger motion would fare no better: start_of_cycle() says why
      }
    return {};
  }

  CycleStart start_at(CycleMap &map, const RootMotion &motion, const StabilityRoot &root,
                      const DynamicState &state)
  {
    CycleStart now;
    now.state = map.pack(state);
    now.period = 1 / root.frequency;
    if (motion.velocity_in(now.state) < rest * motion.least_slip)
      throw ConvergenceError("the motion to start from has hardly left the equilibrium");
    let_go_on(map, motion, settling, now);
    return now;
  }

  std::optional<CycleStart> start_by_harmonics_of(CycleMap &map, const RootMotion &motion,
                                                  const StabilityRoot &root, const DynamicState &at_rest,
                                                  const CycleStart &start)
  {
    try
    {
      return balanced_from(map, motion, root, at_rest, start);
    }
    catch (const ConvergenceError &)
    {
      return {}; // the motion itself is left
    }
  }

  StabilityRoot nearest_root(const CycleMap &map, const ContactPair &pair, const DynamicState &equilibrium,
                             const std::vector<StabilityRoot> &roots, const DynamicState &state)
  {
    const DenseVector packed = map.pack(state);
    const StabilityRoot *nearest = nullptr;
    double most = -1;
    for (const StabilityRoot &root : roots)
      if (root.frequency > 0)
        try
        {
          const double energy = RootMotion(map, pair, equilibrium, root).energy_in(packed);
          if (energy > most)
          {
            most = energy;
            nearest = &root;
          }
        }
        catch (const ConvergenceError &)
        {
          // it does not move the contact along its surface: no cycle of friction belongs to it
        }
    if (!nearest)
      throw ConvergenceError("no root of the equilibrium oscillates along the contact");
    return *nearest;
  }

  CycleStart start_of_cycle(CycleMap &map, const RootMotion &motion, const StabilityRoot &root)
  {
    CycleStart now;
    now.state = motion.state(first_velocity * motion.least_slip);
    now.period = 1 / root.frequency;
    // what is tried next begins as the last motion, larger or smaller: what dies out does so once
    const auto grown = [&](const double velocity)
    {
      motion.scale(now.state, velocity);
      let_go_on(map, motion, settling, now);
      let_go_on(map, motion, measured, now);
      return now;
    };
    // it grows at `low`, decays at `high`
    CycleStart low, high;
    double velocity = first_velocity * motion.least_slip;
    for (unsigned int trial = 0; trial < most_trials; ++trial)
    {
      const CycleStart start = grown(velocity);
      if (std::abs(start.growth) < little_growth * root.growth ||
          (start.growth < 0 && -start.growth * start.period < little_decay))
        return start;
      (start.growth > 0 ? low : high) = start;
      (start.growth > 0 ? low : high).velocity = velocity;
      if (high.velocity == 0)
        velocity *= next_velocity;
      else if (low.velocity == 0)
        velocity = 0.7 * high.velocity;
      else
      {
        // growth is that of the root up to the first stick, and falls along a straight line beyond
        const double share = low.growth < 0.9 * root.growth ? low.growth / (low.growth - high.growth) : 0.5;
        velocity = low.velocity + std::clamp(share, 0.1, 0.9) * (high.velocity - low.velocity);
      }
    }
    // growth may jump where points begin to stick: Newton's method begins from the motion that grows
    if (low.velocity > 0 && high.velocity > 0)
      return low;
    throw ConvergenceError("no velocity up to " + number_text(std::max(low.velocity, high.velocity)) +
                           " m/s in the contact was found at which the growth of the root ends");
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/periodic/shooting.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/newton_method.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    std::vector<double> difference(const std::vector<double> &a, const std::vector<double> &b)
    {
      std::vector<double> d(a.size());
      for (std::size_t k = 0; k < a.size(); ++k)
        d[k] = a[k] - b[k];
      return d;
    }

    /// steps that follow the slower of the modes and their vibration on the stop
    unsigned int first_steps(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law,
                             const HarmonicForce &force)
    {
      double fastest = 0, mobility = 0;
      for (unsigned int k = 0; k < body.n_modes(); ++k)
        if (body.damping_ratio[k] < 1)
        {
          fastest = std::max(fastest, body.omega[k]);
          mobility += body.trace(0, k) * body.trace(0, k);
        }
      const double S = body.residual(0, 0), compliance = law->compression(0).compliance + S;
      const double top = std::sqrt(fastest * fastest + (compliance > 0 ? mobility / compliance : 0.));
      return std::clamp(static_cast<unsigned int>(std::min(1e6, 0.25 * top / force.frequency)), 32u,
                        1u << 16);
    }

    double longest_flight(const Orbit &orbit, const double T, const double otherwise)
    {
      double best = 0, middle = otherwise * T;
      for (const double release : orbit.releases)
      {
        double touch = 1e300;
        for (const double t : orbit.touches)
          touch = std::min(touch, t > release ? t : t + T);
        if (touch < 1e300 && touch - release > best)
        {
          best = touch - release;
          middle = release + 0.5 * best;
        }
      }
      return middle / T;
    }

    /// rms change of the tip's displacement over its rms
    double tip_change(const ShootingSolution &a, const ShootingSolution &b)
    {
      constexpr unsigned int n_samples = 64;
      double changes = 0, squares = 0;
      for (unsigned int k = 0; k < n_samples; ++k)
      {
        const double u = b.at(double(k) / n_samples).displacement;
        changes += std::pow(u - a.at(double(k) / n_samples).displacement, 2);
        squares += u * u;
      }
      return squares > 0 ? std::sqrt(changes / squares) : 0.;
    }

    std::vector<ContactInterval> contact_intervals(const Orbit &orbit, const double T)
    {
      std::vector<ContactInterval> contacts;
      if (orbit.touches.empty() && orbit.releases.empty())
      {
        if (orbit.pieces.front().contact)
          contacts.push_back({0, 1});
        return contacts;
      }
      for (const double touch : orbit.touches)
      {
        const auto release = std::lower_bound(orbit.releases.begin(), orbit.releases.end(), touch);
        const double end = release == orbit.releases.end() ? orbit.releases.front() + T : *release;
        const double turns = std::floor(touch / T);
        contacts.push_back({touch / T - turns, end / T - turns});
      }
      return contacts;
    }
  } // namespace

  namespace
  {
    /// P(x) - x = 0, relative to the state.
    class ShootingEquations : public NewtonEquations
    {
    public:
      ShootingEquations(const PeriodMap &map, const double phase, const double tolerance)
          : map(map), phase(phase), tolerance(tolerance), least(map.norm(map.steady(phase)) * 1e-12)
      {
      }

      double evaluate(const std::vector<double> &x) override
      {
        orbit = Orbit();
        defect = difference(map.advance(x, phase, 1, &monodromy, &orbit), x);
        return map.norm(defect) / std::max({map.norm(x), least, 1e-300});
      }

      /// As far as rounding lets it fall.
      bool keep(const std::vector<double> &, const double size) override
      {
        const bool stagnates = size > 0.1 * last && size < tolerance;
        last = size;
        kept_orbit = std::move(orbit);
        kept_monodromy = monodromy;
        return size < 1e-14 || stagnates;
      }

      bool find_step(bool, std::vector<double> &step) override
      {
        DenseMatrix A = kept_monodromy;
        A *= -1;
        for (unsigned int k = 0; k < A.m(); ++k)
          A(k, k) += 1;
        DenseVector change(defect.begin(), defect.end());
        try
        {
          A.compute_lu_factorization();
          A.solve(change);
        }
        catch (const dealii::ExceptionBase &)
        {
          return false;
        }
        step.assign(change.begin(), change.end());
        return true;
      }

      /// of the last state that was kept
      Orbit kept_orbit;
      DenseMatrix kept_monodromy;

    private:
      const PeriodMap &map;
      const double phase, tolerance, least;
      double last = std::numeric_limits<double>::infinity();
      Orbit orbit;
      DenseMatrix monodromy;
      std::vector<double> defect;
    };
  } // namespace

  ShootingSolution shoot(std::shared_ptr<const PeriodMap> map, const double phase,
                         const std::vector<double> &start, const double tolerance,
                         const unsigned int max_iterations)
  {
    const WallClock::time_point begin = WallClock::now();
    ShootingSolution solution;
    solution.phase = phase;
    solution.state = start;
    ShootingEquations equations(*map, phase, tolerance);
    NewtonSettings newton;
    newton.max_iterations = max_iterations;
    newton.shortest_length = 1. / 256;
    newton.decrease = 0;
    newton.enough = tolerance;
    const NewtonResult found = solve_by_newton(equations, newton, solution.state);
    solution.iterations = found.iterations;
    solution.periodicity = found.size;
    solution.orbit = std::move(equations.kept_orbit);
    solution.monodromy = equations.kept_monodromy;
    if (!(found.size < tolerance))
    {
      std::ostringstream text;
      text << "Shooting at " << 1 / map->period() << " Hz did not find a periodic motion: after "
           << solution.iterations << " iterations the state still changes by " << found.size
           << " of itself over a period.";
      throw ConvergenceError(text.str());
    }
    solution.map = map;
    solution.impulse = solution.orbit.impulse;
    solution.contacts = contact_intervals(solution.orbit, map->period());
    double squares = 0;
    map->integrate(solution.orbit, [&](const double weight, const MotionSample &s)
                   { squares += weight * s.energy * s.energy; });
    solution.energy_norm = std::sqrt(squares / map->period());
    solution.seconds = seconds_since(begin);
    return solution;
  }

  ShootingSolution shoot(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law,
                         const HarmonicForce &force, const ShootingSettings &settings,
                         const ShootingStart &start)
  {
    const WallClock::time_point begin = WallClock::now();
    const bool doubles = settings.n_steps == 0;
    unsigned int n_steps = doubles ? first_steps(body, law, force) : settings.n_steps;
    double accuracy = 1e-9;
    const auto make_map = [&]()
    { return std::make_shared<const PeriodMap>(body, law, force, n_steps, settings.n_nodes, accuracy); };
    auto map = make_map();
    double phase = start.phase;
    std::vector<double> x = start.state.empty() ? map->steady_off_resonance(phase) : start.state;
    ShootingSolution solution;
    // the nearer to the motion, the fewer periods it takes
    for (unsigned int n_settling = settings.n_settling;; n_settling = 4 * n_settling + 4)
    {
      std::vector<double> y = map->advance(x, phase, n_settling);
      Orbit orbit;
      map->advance(y, phase, 1, nullptr, &orbit);
      const double section =
          settings.phase >= 0 ? settings.phase : longest_flight(orbit, map->period(), phase);
      const double ahead = section - phase - std::floor(section - phase);
      y = map->advance(y, phase, ahead);
      try
      {
        solution = shoot(map, section - std::floor(section), y, settings.tolerance, settings.max_iterations);
        break;
      }
      catch (const ConvergenceError &)
      {
        if (n_settling > 50)
          throw;
      }
    }
    while (doubles)
    {
      n_steps *= 2;
      accuracy = std::max(1e-12, 0.01 * accuracy);
      const ShootingSolution coarse = solution;
      map = make_map();
      solution = shoot(map, solution.phase, coarse.state, settings.tolerance, settings.max_iterations);
      solution.iterations += coarse.iterations;
      solution.refinement = std::max(map->norm(difference(solution.state, coarse.state)) /
                                         std::max(map->norm(solution.state), 1e-300),
                                     tip_change(coarse, solution));
      const double impulse = std::max(solution.impulse, 0.01 * std::abs(force.amplitude) / force.frequency);
      if (impulse > 0)
        solution.refinement =
            std::max(solution.refinement, std::abs(coarse.impulse - solution.impulse) / impulse);
      if (solution.refinement <= settings.refinement)
        break;
      if (n_steps > 1u << 18)
        throw ConvergenceError("The time reference did not converge under refinement of its steps.");
    }
    solution.seconds = seconds_since(begin);
    return solution;
  }

  std::vector<std::complex<double>> floquet_multipliers(const DenseMatrix &monodromy)
  {
    std::vector<std::complex<double>> multipliers = general_eigenvalues(monodromy);
    std::sort(multipliers.begin(), multipliers.end(),
              [](const auto &a, const auto &b) { return std::abs(a) > std::abs(b); });
    return multipliers;
  }

  ShootingResidual shooting_residual(const ForcedBody &body, const std::shared_ptr<const NormalLaw> &law,
                                     const HarmonicForce &force, const unsigned int n_steps,
                                     const double phase, const std::vector<double> &x)
  {
    ShootingResidual residual;
    residual.value =
        difference(PeriodMap(body, law, force, n_steps).advance(x, phase, 1, &residual.by_state), x);
    for (unsigned int k = 0; k < x.size(); ++k)
      residual.by_state(k, k) -= 1;
    const double change = 1e-6 * force.frequency;
    const auto at = [&](const double f) {
      return PeriodMap(body, law, {force.amplitude, f}, n_steps).advance(x, phase);
    };
    residual.by_frequency = difference(at(force.frequency + change), at(force.frequency - change));
    for (double &value : residual.by_frequency)
      value /= 2 * change;
    return residual;
  }

  SettledMotion settle(const ShootingSolution &solution, const double stop, const unsigned int most_periods)
  {
    constexpr unsigned int n_samples = 256;
    const PeriodMap &map = *solution.map;
    std::vector<double> exact, before(n_samples, 0.), x(map.n_states(), 0.);
    double exact_squares = 0;
    for (unsigned int k = 0; k < n_samples; ++k)
    {
      exact.push_back(solution.at(double(k) / n_samples).displacement);
      exact_squares += exact[k] * exact[k];
    }
    SettledMotion settled;
    while (settled.n_periods < most_periods)
    {
      Orbit orbit;
      x = map.advance(x, 0, 1, nullptr, &orbit);
      ++settled.n_periods;
      double changes = 0, errors = 0, squares = 0;
      for (unsigned int k = 0; k < n_samples; ++k)
      {
        const double u = map.at(orbit, double(k) / n_samples).displacement;
        changes += (u - before[k]) * (u - before[k]);
        errors += (u - exact[k]) * (u - exact[k]);
        squares += u * u;
        before[k] = u;
      }
      settled.change = std::sqrt(changes / std::max(squares, 1e-300));
      settled.error = std::sqrt(errors / std::max(exact_squares, 1e-300));
      if (settled.change < stop)
        return settled;
    }
    throw ConvergenceError("Integrating in time did not settle within " + std::to_string(most_periods) +
                           " periods.");
  }
} // namespace vibrocontact

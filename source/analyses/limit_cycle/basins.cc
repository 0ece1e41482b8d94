#include <vibrocontact/analyses/limit_cycle/basins.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/wall_clock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace vibrocontact
{
  namespace
  {
    constexpr double turn = 2 * dealii::numbers::PI;
    /// of the slowest cycle in a window
    constexpr unsigned int periods_of_window = 20;
    /// which a decision needs
    constexpr unsigned int least_windows = 2;
    constexpr double most_steps = 1e7;
    /// What the frequency of a cycle has of its motion: 1, or 0.7 if it is along one line; half of that if the frequency is off by one
    /// over the window.
    constexpr double least_at_frequency = 0.6;
    /// How far the parts of a motion may be from those of the cycle that has won, and from where on they need come no closer.
    constexpr double close = 0.05, there = 0.005;
  } // namespace

  void check_basins(const std::vector<StabilityRoot> &roots, const BasinParameters &parameters)
  {
    if (roots.empty())
      return;
    const auto [slowest, fastest] = std::minmax_element(roots.begin(), roots.end(),
                                                        [](const StabilityRoot &a, const StabilityRoot &b)
                                                        { return a.frequency < b.frequency; });
    // a cycle is somewhat faster or slower than its root
    const double windows = least_windows * periods_of_window / slowest->frequency;
    if (parameters.longest_time < 1.1 * windows)
      throw InputError("Limit cycle/Basins/Longest time is " + number_text(parameters.longest_time) +
                       " s, but a winner is known after " +
                       std::to_string(least_windows * periods_of_window) +
                       " periods of the slowest cycle at the earliest, " + number_text(windows) +
                       " s: give a longer one.");
    if (parameters.time_step * least_steps_of_period * fastest->frequency > 1)
      throw InputError("Limit cycle/Basins/Time step is " + number_text(parameters.time_step) +
                       " s, more than an eighth of a period of the root at " +
                       number_text(fastest->frequency) + " Hz: give a shorter one.");
    if (periods_of_window / slowest->frequency > most_steps * parameters.time_step)
      throw InputError("Limit cycle/Basins/Time step is " + number_text(parameters.time_step) +
                       " s, but 20 periods of the root at " + number_text(slowest->frequency) +
                       " Hz would be more than " + number_text(most_steps) + " steps: give a longer one.");
  }

  double window_of(const std::vector<CycleOfBasin> &cycles)
  {
    double slowest = 0;
    for (const CycleOfBasin &cycle : cycles)
      slowest = std::max(slowest, cycle.period);
    return periods_of_window * slowest;
  }

  unsigned int steps_of_window(const double length, const BasinParameters &parameters)
  {
    return std::ceil(length / parameters.time_step - 1e-9);
  }

  BasinMarch::BasinMarch(CycleMap &window, const ContactPair &pair, const DynamicState &at_rest,
                         const std::vector<CycleOfBasin> &cycles, const BasinParameters &parameters)
      : window(window), parameters(parameters), cycles(cycles), length(window_of(cycles)),
        equilibrium(window.pack(at_rest))
  {
    for (const CycleOfBasin &cycle : cycles)
    {
      motions.push_back(window.pack(cycle.state));
      motions.back() -= equilibrium;
      roots.emplace_back(window, pair, at_rest, cycle.root);
    }
    for (unsigned int k = 0; k < cycles.size(); ++k)
    {
      DenseVector state = window.pack(cycles[k].state);
      const Velocities own = velocities_over_window(state);
      // in other steps than those it was found with, a cycle may have another frequency
      if (own.at_frequency[k] < least_at_frequency * own.rms[k])
        throw ConvergenceError(
            "the steps of Limit cycle/Basins/Time step change the frequency of the cycle at " +
            number_text(1 / cycles[k].period) + " Hz: take shorter ones");
      own_parts.push_back(own.at_frequency);
      velocities.push_back(own.at_frequency[k]);
    }
    for (std::vector<double> &parts : own_parts)
      make_relative(parts);
    for (unsigned int k = 0; k < cycles.size(); ++k)
      for (unsigned int other = 0; other < k; ++other)
        if (distance_from(other, own_parts[k]) < 2 * close)
          throw ConvergenceError("the cycles at " + number_text(1 / cycles[other].period) + " and " +
                                 number_text(1 / cycles[k].period) +
                                 " Hz are too much alike to be told apart");
  }

  void BasinMarch::make_relative(std::vector<double> &parts) const
  {
    for (unsigned int k = 0; k < parts.size(); ++k)
      parts[k] /= velocities[k];
  }

  BasinMarch::Velocities BasinMarch::velocities_over_window(DenseVector &state)
  {
    std::vector<std::complex<double>> sums(cycles.size());
    std::vector<double> squares(cycles.size());
    double weights = 0;
    unsigned int n_steps = 0;
    state = window.march(
        state, length, false,
        [&](const DynamicState &now)
        {
          const double share = double(++n_steps) / window.n_steps(), weight = 1 - std::cos(turn * share);
          weights += weight;
          const DenseVector packed = window.pack(now);
          for (unsigned int k = 0; k < cycles.size(); ++k)
          {
            const std::complex<double> amplitude = roots[k].amplitude_in(packed);
            sums[k] += weight * amplitude * std::polar(1., -turn * share * length / cycles[k].period);
            squares[k] += weight * std::norm(amplitude);
          }
        });
    Velocities result;
    for (unsigned int k = 0; k < cycles.size(); ++k)
    {
      result.at_frequency.push_back(std::abs(sums[k]) / weights);
      result.rms.push_back(std::sqrt(squares[k] / weights));
    }
    return result;
  }

  double BasinMarch::distance_from(const unsigned int cycle, const std::vector<double> &parts) const
  {
    double largest = 0;
    for (unsigned int k = 0; k < parts.size(); ++k)
      largest = std::max(largest, std::abs(parts[k] - own_parts[cycle][k]));
    return largest;
  }

  std::optional<unsigned int> BasinMarch::winner_of(const BasinPath &path) const
  {
    if (path.parts.size() < least_windows)
      return {};
    for (unsigned int k = 0; k < cycles.size(); ++k)
    {
      const double now = distance_from(k, path.parts.back()),
                   before = distance_from(k, path.parts[path.parts.size() - 2]);
      if (cycles[k].is_stable != false && now < close && (now <= before || now < there))
        return k;
    }
    return {};
  }

  BasinPath BasinMarch::follow(const std::array<unsigned int, 2> &between, const double share)
  {
    const auto begin = WallClock::now();
    BasinPath path;
    path.between = between;
    path.share = share;
    Progress progress("motion from " + number_text(share) + " of the way",
                      std::floor(parameters.longest_time / length));
    DenseVector state = equilibrium;
    state.add(parameters.size * (1 - share), motions[between[0]], parameters.size * share,
              motions[between[1]]);
    try
    {
      while (!path.winner && (path.time.size() + 1) * length <= parameters.longest_time)
      {
        std::vector<double> parts = velocities_over_window(state).at_frequency;
        make_relative(parts);
        path.parts.push_back(parts);
        path.time.push_back((path.time.size() + 1) * length);
        path.winner = winner_of(path);
        progress.advance();
      }
    }
    catch (const ConvergenceError &error)
    {
      path.message = error.what();
    }
    path.seconds = seconds_since(begin);
    return path;
  }

  namespace
  {
    /// how many times their first distance apart paths have parted
    constexpr double parted = 2;

    double distance(const std::vector<double> &a, const std::vector<double> &b)
    {
      double square = 0;
      for (std::size_t k = 0; k < a.size(); ++k)
        square += (a[k] - b[k]) * (a[k] - b[k]);
      return std::sqrt(square);
    }

    /// BasinBorder::dividing between two shares
    std::vector<double> dividing_motion(const std::map<double, BasinPath> &paths, const double low,
                                        const double high)
    {
      if (paths.count(low) == 0 || paths.count(high) == 0)
        return {};
      const BasinPath &a = paths.at(low), &b = paths.at(high);
      std::vector<double> result;
      double least = std::numeric_limits<double>::max();
      for (std::size_t w = 0; w + 1 < std::min(a.parts.size(), b.parts.size()); ++w)
      {
        if (distance(a.parts[w], b.parts[w]) > parted * distance(a.parts[0], b.parts[0]))
          break;
        const double change = distance(a.parts[w], a.parts[w + 1]) + distance(b.parts[w], b.parts[w + 1]);
        if (change >= least)
          continue;
        least = change;
        result = a.parts[w];
        for (std::size_t k = 0; k < result.size(); ++k)
          result[k] = (result[k] + b.parts[w][k]) / 2;
      }
      return result;
    }
  } // namespace

  BasinsBetween basins_between(BasinMarch &march, const std::array<unsigned int, 2> &between,
                               const BasinParameters &parameters)
  {
    std::map<double, BasinPath> paths;
    std::map<double, std::optional<unsigned int>> winners;
    const auto follow = [&](const double share)
    {
      paths[share] = march.follow(between, share);
      winners[share] = paths[share].winner;
    };
    for (const unsigned int k : {0u, 1u})
      if (parameters.size != 1 || !march.is_stable(between[k]))
        follow(k);
      else if (*march.is_stable(between[k]))
        winners[k] = between[k];
    for (unsigned int k = 1; k <= parameters.n_starts; ++k)
      follow(k / (parameters.n_starts + 1.));
    BasinsBetween result;
    for (auto low = winners.begin(); low != winners.end();)
    {
      // where none has won, the border lies between the neighbours that are decided
      const auto high = std::find_if(std::next(low), winners.end(),
                                     [](const auto &start) { return start.second.has_value(); });
      const bool differ = low->second && high != winners.end() && *low->second != *high->second;
      if (differ && high == std::next(low) && high->first - low->first > parameters.border)
      {
        follow((low->first + high->first) / 2);
        continue;
      }
      if (differ)
        result.borders.push_back({between,
                                  low->first,
                                  high->first,
                                  {{*low->second, *high->second}},
                                  dividing_motion(paths, low->first, high->first)});
      low = high;
    }
    for (const auto &[share, path] : paths)
      result.paths.push_back(path);
    return result;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/limit_cycle/branch_equations.h>
#include <vibrocontact/analyses/limit_cycle/cycle_branch.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/numerics/newton_method.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// arc lengths: the first, the shortest, and that below which the first stick is located well enough
    constexpr double first_step = 0.02, shortest_step = 1e-4, stick_step = 0.01;
    /// the longest where the contact stays as it is at rest: motions of any amplitude are nearly alike
    constexpr double linear_step = 0.5;
    /// a secant that turns by more than this [cosine] is tried with half the step
    constexpr double least_turn_cosine = 0.8;
    /// of the first cycle's motion: nothing is left of a smaller one
    constexpr double vanished = 0.02;
    /// change of the value over the range from which on it is more than rounding
    constexpr double least_change = 1e-6;

    /// What the contact of a cycle does.
    void look_at(CycleAt &at, CycleBranchPoint &point)
    {
      const std::vector<ContactStatus> &at_rest = at.scene.at_rest.contact.status;
      at.map->march(point.cycle.state, point.cycle.period, true);
      for (const std::vector<ContactStatus> &status : at.map->statuses())
      {
        point.sticks = point.sticks || std::count(status.begin(), status.end(), ContactStatus::stick) > 0;
        point.changes = point.changes || status != at_rest;
      }
    }

    double norm(const BranchPlace &z, const unsigned int n)
    {
      return DenseVector(z.begin(), z.begin() + n).l2_norm();
    }

    /// One way along a branch.
    class OneWay
    {
    public:
      OneWay(BranchEquations &equations, const LimitCycleParameters &parameters,
             const CycleBranchPoint &start, const BranchPlace &place)
          : equations(equations), parameters(parameters), start(start), last(place),
            n(start.cycle.state.size()), first_motion(norm(place, n)), last_motion(first_motion)
      {
      }

      /// Adds its points, the start is none of them, and values at which it turns round. @param direction of the value, 1 or -1
      CycleBranchEnd follow(const int direction,
                            const std::function<void(CycleBranchPoint &, CycleAt &)> &found,
                            std::vector<CycleBranchPoint> &points, std::vector<double> &folds)
      {
        const CycleBranchParameters &branch = parameters.branch;
        // by the value alone, until two points give a secant
        way.assign(n + 2, 0.);
        way[n + 1] = direction;
        if (last[n + 1] == (direction > 0 ? branch.to() : branch.from()))
          return {CycleBranchEnd::Kind::range, "", 0};
        double step = std::min(first_step, branch.largest_step);
        bool did_stick = start.sticks;
        std::string reason;
        while (points.size() < branch.most_points)
        {
          CycleBranchPoint point;
          BranchPlace place;
          bool at_limit = false;
          unsigned int iterations = 0;
          bool is_found = correct(step, point, place, at_limit, iterations, reason);
          if (is_found && (point.value < branch.from() || point.value > branch.to()))
          {
            is_found = false;
            reason = "the next cycle lies beyond the range";
          }
          const bool stops_sticking = is_found && did_stick && !point.sticks;
          if (!is_found || turns(place, step) || (stops_sticking && step > stick_step))
          {
            step /= 2;
            if (step >= shortest_step)
              continue;
            return {CycleBranchEnd::Kind::lost, reason, 0};
          }
          reason.clear();
          judge_cycle(*equations.last().map, parameters, point.cycle);
          if (!point.cycle.converged)
            return {CycleBranchEnd::Kind::lost, point.cycle.message, 0};
          const double motion = equations.motion();
          point.size = motion;
          try
          {
            found(point, equations.last());
          }
          catch (const ConvergenceError &error)
          {
            return {CycleBranchEnd::Kind::lost, error.what(), 0};
          }
          note_fold(place, folds);
          advance_to(place, motion);
          points.push_back(point);
          did_stick = point.sticks;
          if (motion < vanished * first_motion)
            return {CycleBranchEnd::Kind::vanishes, "", onset_of(points)};
          if (at_limit)
            return {CycleBranchEnd::Kind::range, "", 0};
          step *= iterations <= 2 ? 2. : iterations == 3 ? 1.4 : iterations > 4 ? 0.7 : 1.;
          step = std::min(step,
                          point.changes ? branch.largest_step : std::max(branch.largest_step, linear_step));
        }
        return {CycleBranchEnd::Kind::most_points, "Limit cycle/Branch/Most points are found: allow more", 0};
      }

    private:
      /// The value at which the amplitude is zero, from the last three points: beyond an onset amplitudes grow with the root of the
      /// value, where the equilibrium is about to stick with the value itself. The law that fits better counts.
      static double onset_of(const std::vector<CycleBranchPoint> &points)
      {
        const CycleBranchPoint &last = points[points.size() - 1];
        if (points.size() < 3)
          return last.value;
        const CycleBranchPoint &second = points[points.size() - 2], &third = points[points.size() - 3];
        double onset = last.value, smallest = std::numeric_limits<double>::max();
        for (const int exponent : {1, 2})
        {
          const auto power = [&](const CycleBranchPoint &point) { return std::pow(point.size, exponent); };
          const double slope = (second.value - last.value) / (power(second) - power(last)),
                       error = std::abs(last.value + slope * (power(third) - power(last)) - third.value);
          if (error < smallest)
          {
            smallest = error;
            onset = last.value - slope * power(last);
          }
        }
        return onset;
      }

      PlaceSizes sizes() const
      {
        return {last_motion, last[n], parameters.branch.to() - parameters.branch.from()};
      }

      /// A cycle a step ahead.
      bool correct(const double step, CycleBranchPoint &point, BranchPlace &z, bool &at_limit,
                   unsigned int &iterations, std::string &reason)
      {
        const auto begin = WallClock::now();
        const PlaceSizes in = sizes();
        z = last;
        const BranchPlace secant = in_sizes(way);
        BranchPlace tangent = secant;
        double length = step;
        const double ahead = last[n + 1] + step * secant[n + 1] * in.value,
                     limit = secant[n + 1] > 0 ? parameters.branch.to() : parameters.branch.from();
        at_limit = secant[n + 1] > 0 ? ahead >= limit : secant[n + 1] < 0 && ahead <= limit;
        if (at_limit)
        {
          length = (limit - last[n + 1]) / (secant[n + 1] * in.value);
          tangent.assign(n + 2, 0.);
          tangent[n + 1] = 1;
        }
        for (unsigned int k = 0; k < n + 2; ++k)
          z[k] += length * secant[k] * in.of(k, n);
        if (at_limit)
          z[n + 1] = limit;
        equations.go_along(tangent, in);
        NewtonSettings settings;
        settings.max_iterations = 8;
        settings.shortest_length = 1. / 8;
        const NewtonResult result = solve_by_newton(equations, settings, z);
        iterations = result.iterations;
        if (!result.converged)
        {
          reason = equations.failure.empty()
                       ? "Newton's method ended at a change over a period of " + number_text(result.size) +
                             " of the motion: a shorter Limit cycle/Time step may help"
                       : equations.failure;
          return false;
        }
        LimitCycle &cycle = point.cycle;
        cycle.root = start.cycle.root;
        cycle.converged = true;
        cycle.n_steps = start.cycle.n_steps;
        cycle.state = equations.state();
        cycle.period = z[n];
        cycle.residual = result.size;
        cycle.newton_iterations = result.iterations;
        point.value = z[n + 1];
        look_at(equations.last(), point);
        cycle.seconds = seconds_since(begin);
        return true;
      }

      BranchPlace way_to(const BranchPlace &z) const
      {
        BranchPlace result(n + 2);
        for (unsigned int k = 0; k < n + 2; ++k)
          result[k] = z[k] - last[k];
        return result;
      }

      /// A direction in the sizes, of unit length.
      BranchPlace in_sizes(const BranchPlace &direction) const
      {
        const PlaceSizes in = sizes();
        BranchPlace result(n + 2);
        double square = 0;
        for (unsigned int k = 0; k < n + 2; ++k)
        {
          result[k] = direction[k] / in.of(k, n);
          square += result[k] * result[k];
        }
        for (double &part : result)
          part /= std::sqrt(square);
        return result;
      }

      bool turns(const BranchPlace &z, const double step) const
      {
        if (!has_secant || step <= 10 * shortest_step)
          return false;
        const BranchPlace before = in_sizes(way), next = in_sizes(way_to(z));
        double cosine = 0;
        for (unsigned int k = 0; k < n + 2; ++k)
          cosine += next[k] * before[k];
        return cosine < least_turn_cosine;
      }

      /// The value at which the branch turned round, by the parabola through the last three places.
      void note_fold(const BranchPlace &z, std::vector<double> &folds) const
      {
        const BranchPlace next = way_to(z);
        const double before = way[n + 1], after = next[n + 1], range = sizes().value;
        if (!has_secant || before * after >= 0 ||
            std::min(std::abs(before), std::abs(after)) < least_change * range)
          return;
        const auto length = [&](const BranchPlace &direction)
        {
          const PlaceSizes in = sizes();
          double square = 0;
          for (unsigned int k = 0; k < n + 2; ++k)
            square += std::pow(direction[k] / in.of(k, n), 2);
          return std::sqrt(square);
        };
        const double a = length(way), b = length(next), slope = (before / a * b + after / b * a) / (a + b),
                     curvature = 2 * (after / b - before / a) / (a + b);
        folds.push_back(last[n + 1] - slope * slope / (2 * curvature));
      }

      void advance_to(const BranchPlace &z, const double motion)
      {
        way = way_to(z);
        // on the cycle itself every place of it is as good: the branch does not go along it
        const DenseVector &along = equations.last().map->rate();
        double share = 0;
        for (unsigned int k = 0; k < n; ++k)
          share += way[k] * along[k];
        share /= along.norm_sqr();
        for (unsigned int k = 0; k < n; ++k)
          way[k] -= share * along[k];
        has_secant = true;
        last = z;
        last_motion = motion;
      }

      BranchEquations &equations;
      const LimitCycleParameters &parameters;
      const CycleBranchPoint &start;
      BranchPlace last;
      const unsigned int n;
      const double first_motion;
      double last_motion;
      /// from the place before it, or the first direction
      BranchPlace way;
      bool has_secant = false;
    };
  } // namespace

  CycleBranch follow_cycle(const CycleFamily &family, const LimitCycle &start, const double value,
                           const LimitCycleParameters &parameters,
                           const std::function<void(const CycleBranchPoint &, CycleAt &)> &found)
  {
    const double range = parameters.branch.to() - parameters.branch.from();
    BranchEquations equations(family, start, value, range, parameters.tolerance);
    CycleBranchPoint first;
    first.value = value;
    first.cycle = start;
    look_at(equations.last(), first);
    DenseVector from_rest = start.state;
    from_rest -= equations.last().equilibrium;
    BranchPlace place(from_rest.begin(), from_rest.end());
    place.push_back(start.period);
    place.push_back(value);
    CycleBranch branch;
    unsigned int n_found = 0;
    const auto count = [&](CycleBranchPoint &point, CycleAt &at)
    {
      point.number = n_found;
      found(point, at);
      ++n_found;
    };
    count(first, equations.last());
    for (const int direction : {-1, 1})
    {
      std::vector<CycleBranchPoint> points;
      branch.ends[direction > 0] =
          OneWay(equations, parameters, first, place).follow(direction, count, points, branch.folds);
      branch.ends[direction > 0].left_its_points = equations.last().map->left_its_points;
      if (direction < 0)
      {
        branch.points.assign(points.rbegin(), points.rend());
        branch.points.push_back(first);
      }
      else
        branch.points.insert(branch.points.end(), points.begin(), points.end());
    }
    return branch;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/transient/proximity.h>
#include <vibrocontact/contact/point_rows.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// no choice among so few points
    constexpr unsigned int always_nearby = 16;
    /// points are nearby below this share of the median gap, until they are beyond twice that
    constexpr double nearby_share = 0.1;
    /// of the points that are nearby, those that a search finds again; fewer: the others are let go
    constexpr double worn_share = 0.75;
    /// steps after which W~ R is computed anew: the round-off of its changes grows with the steps^(3/2)
    constexpr unsigned int longest_without_search = 64;
    /// that a look at the points that are not nearby stands for: where it is needed often, a search finds more to be nearby
    constexpr unsigned int steps_of_a_look = 8;
  } // namespace

  double Proximity::gap_speed(const DenseVector &shape_velocities) const
  {
    const unsigned int n = pair.n_points();
    if (n <= always_nearby)
      return 0;
    DenseVector speed(n);
    for (unsigned int k = 0; k < shape_velocities.size(); ++k)
      for (unsigned int i = 0; i < n; ++i)
        speed[i] += matrices.shapes.basis(i, k) * shape_velocities[k];
    return speed.linfty_norm();
  }

  bool Proximity::another_within(const DynamicState &state, const double distance) const
  {
    auto nearby = state.nearby.begin();
    for (unsigned int i = 0; i < pair.n_points(); ++i)
      if (nearby != state.nearby.end() && *nearby == i)
        ++nearby;
      else if (state.contact.y[i] <= distance)
        return true;
    return false;
  }

  bool Proximity::search_is_due(const DynamicState &state) const
  {
    return state.nearby.empty() || state.steps_since_search >= longest_without_search;
  }

  double Proximity::gap_at(const unsigned int point, const DynamicState &state, const double residual,
                           const DenseVector &shapes, const double approach, const double force) const
  {
    double gap = constant_response[point] + residual + pair.force_response(point) * force -
                 approach * by_approach[point];
    if (!state.roughness.empty())
      gap += state.roughness[point];
    for (unsigned int k = 0; k < shapes.size(); ++k)
      gap += matrices.shapes.basis(point, k) * shapes[k];
    return gap;
  }

  void Proximity::look_at_others(DynamicState &state, const StepOperator &nearby,
                                 const DenseVector &shapes) const
  {
    const std::vector<unsigned int> &others = nearby.other_points();
    DenseVector residual;
    nearby.residual_gaps_of_others(on_points(state.R, nearby.points()), residual);
    for (unsigned int i = 0; i < others.size(); ++i)
      state.contact.y[others[i]] =
          gap_at(others[i], state, residual[i], shapes, state.contact.approach, state.force);
    state.moved_since_search = 0;
    state.steps_since_search += steps_of_a_look;
  }

  void Proximity::search(DynamicState &state, const DenseVector &shapes) const
  {
    const unsigned int n = pair.n_points();
    set_residual_displacement(pair, state);
    const auto set_change = [&](const DenseVector &of_forces, DenseVector &change)
    {
      change = 0;
      add_residual_displacement(pair.residual, pair.half_spaces.get(), of_forces, change);
    };
    set_change(state.force_change, state.residual_change);
    set_change(state.force_change_before, state.residual_change_before);
    // rows that were not nearby have no rate yet: theirs begins with a backward difference
    for (unsigned int i = n; i < 3 * n; ++i)
      if (state.residual_rate[i] == 0)
        state.residual_rate[i] = state.residual_change[i] / matrices.step;
    std::vector<double> gap(n);
    for (unsigned int i = 0; i < n; ++i)
      gap[i] = gap_at(i, state, state.residual_displacement[i], shapes, state.contact.approach, state.force);

    std::vector<double> sorted(gap);
    std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
    const double least = std::max(0., *std::min_element(gap.begin(), gap.end())),
                 threshold = least + nearby_share * std::max(0., sorted[n / 2] - least);
    std::vector<bool> was_nearby(n, false);
    for (const unsigned int i : state.nearby)
      was_nearby[i] = true;
    const auto is_nearby = [&](const unsigned int i)
    {
      return n <= always_nearby || state.R[i] != 0 || state.force_change[i] != 0 ||
             state.force_change_before[i] != 0 ||
             gap[i] <= (was_nearby[i] ? 2 * threshold - least : threshold);
    };
    std::vector<unsigned int> found;
    for (unsigned int i = 0; i < n; ++i)
    {
      state.contact.y[i] = gap[i];
      if (is_nearby(i))
        found.push_back(i);
    }
    // a few points more cost less than another matrix
    std::vector<unsigned int> with_known;
    std::set_union(state.nearby.begin(), state.nearby.end(), found.begin(), found.end(),
                   std::back_inserter(with_known));
    state.nearby = found.size() < worn_share * with_known.size() ? found : with_known;
    auto next = state.nearby.begin();
    for (unsigned int i = 0; i < n; ++i)
      if (next != state.nearby.end() && *next == i)
        ++next;
      else
        state.contact.y[n + i] = state.contact.y[2 * n + i] = 0;
    state.moved_since_search = 0;
    state.steps_since_search = 0;
  }

  std::vector<unsigned int> Proximity::closed_others(const DynamicState &state, const StepOperator &nearby,
                                                     const DenseVector &residual, const DenseVector &shapes,
                                                     const double approach, const double force) const
  {
    const std::vector<unsigned int> &others = nearby.other_points();
    std::vector<unsigned int> closed;
    for (unsigned int i = 0; i < others.size(); ++i)
      if (gap_at(others[i], state, residual[i], shapes, approach, force) < 0)
        closed.push_back(others[i]);
    return closed;
  }

  double Proximity::motion_of_open_points(const DynamicState &state, const StepOperator &nearby,
                                          const ContactSolution &solution) const
  {
    const std::vector<unsigned int> &points = nearby.points();
    double motion = 0;
    bool any_open = points.size() == pair.n_points();
    for (unsigned int i = 0; i < points.size(); ++i)
      if (solution.R[i] == 0)
      {
        any_open = true;
        motion = std::max(motion, std::abs(solution.y[i] - state.contact.y[points[i]]));
      }
    return any_open ? motion : std::numeric_limits<double>::infinity();
  }

  double Proximity::motion_of_others(const DynamicState &state, const StepOperator &nearby,
                                     const ContactSolution &solution, const double gap_speed) const
  {
    // what W~ R and the approach add is not much more than where points are nearby
    return 2 * motion_of_open_points(state, nearby, solution) + 2 * matrices.step * gap_speed;
  }

  void Proximity::end_step(DynamicState &state, const StepOperator &nearby, const ContactSolution &solution,
                           const double gap_speed) const
  {
    const double motion = motion_of_others(state, nearby, solution, std::max(state.gap_speed, gap_speed));
    // without open points nobody knows how gaps change; a fallback computes W~ R anew, but not its change
    const bool unknown = !std::isfinite(motion) || solution.fallbacks > 0;
    state.gap_speed = gap_speed;
    state.moved_since_search += unknown ? 0 : motion;
    state.steps_since_search = unknown ? longest_without_search : state.steps_since_search + 1;
  }
} // namespace vibrocontact

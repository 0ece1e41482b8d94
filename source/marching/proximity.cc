#include <vibrocontact/contact/point_rows.h>
#include <vibrocontact/marching/proximity.h>

#include <deal.II/lac/lapack_templates.h>

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
    /// steps that one look at the points that are not nearby counts as: where it is needed often, a search finds more to be nearby
    constexpr unsigned int steps_of_a_look = 8;
  } // namespace

  bool Proximity::search_is_due(const DynamicState &state) const
  {
    return state.nearby.empty() || state.steps_since_search >= longest_without_search;
  }

  void Proximity::set_gaps(const DynamicState &state, const DenseVector &shapes, const double approach,
                           const double force, DenseVector &gaps) const
  {
    const DenseMatrix &basis = matrices.shapes.basis;
    gaps.reinit(pair.n_points());
    for (unsigned int i = 0; i < gaps.size(); ++i)
      gaps[i] = constant_response[i] + state.residual_displacement[i] + pair.force_response(i) * force -
                approach * by_approach[i] + (state.roughness.empty() ? 0. : state.roughness[i]);
    const dealii::types::blas_int n_points = gaps.size(), n_rows = basis.m(), n_shapes = shapes.size(),
                                  one = 1;
    const double unit = 1;
    if (n_shapes > 0)
      dealii::gemv("N", &n_points, &n_shapes, &unit, &basis(0, 0), &n_rows, shapes.data(), &one, &unit,
                   gaps.data(), &one);
  }

  void Proximity::search(DynamicState &state, const DenseVector &shapes) const
  {
    const unsigned int n = pair.n_points();
    set_residual_displacement_and_changes(pair, state);
    // rows that were not nearby have no rate yet: theirs begins with a backward difference
    for (unsigned int i = n; i < 3 * n && state.last_step > 0; ++i)
      if (state.residual_rate[i] == 0)
        state.residual_rate[i] = state.residual_change[i] / state.last_step;
    DenseVector gap;
    set_gaps(state, shapes, state.contact.approach, state.force, gap);

    std::vector<double> sorted(gap.begin(), gap.end());
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
    state.moved_since_look = 0;
    state.steps_since_search = 0;
  }

  void Proximity::note_motion(DynamicState &state, const StepOperator &nearby,
                              const ContactSolution &solution) const
  {
    const std::vector<unsigned int> &rows = nearby.residual_rows();
    const unsigned int n = nearby.n_points();
    // forces are at the nearby points, where their own displacement is largest; that of closed ones is what modes leave it, so that
    // without open ones nobody knows
    double motion = n == pair.n_points() ? 0 : std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < n; ++i)
      if (solution.R[i] == 0)
        motion = 0;
    for (unsigned int k = 0; k < rows.size(); ++k)
      motion = std::max(motion, std::abs(solution.y[3 * n + k] - state.residual_displacement[rows[k]]));
    state.moved_since_look += 2 * motion;
  }

  bool Proximity::may_close_another(const DynamicState &state, const StepOperator &nearby,
                                    const DenseVector &gaps) const
  {
    const std::vector<unsigned int> &others = nearby.other_points();
    return std::any_of(others.begin(), others.end(),
                       [&](const unsigned int i) { return gaps[i] <= state.moved_since_look; });
  }

  std::vector<unsigned int> Proximity::look_at_others(DynamicState &state, const StepOperator &nearby,
                                                      const DenseVector &residual, DenseVector &gaps) const
  {
    const std::vector<unsigned int> &others = nearby.other_points();
    std::vector<unsigned int> closed;
    for (unsigned int i = 0; i < others.size(); ++i)
    {
      gaps[others[i]] += residual[i] - state.residual_displacement[others[i]];
      state.residual_displacement[others[i]] = residual[i];
      if (gaps[others[i]] < 0)
        closed.push_back(others[i]);
    }
    state.moved_since_look = 0;
    state.steps_since_search += steps_of_a_look;
    return closed;
  }

  void Proximity::end_step(DynamicState &state, const StepOperator &nearby, const ContactSolution &solution,
                           const DenseVector &gaps) const
  {
    for (const unsigned int i : nearby.other_points())
      state.contact.y[i] = gaps[i];
    // a fallback computes W~ R anew, but not its change
    state.steps_since_search = solution.fallbacks > 0 ? longest_without_search : state.steps_since_search + 1;
  }
} // namespace vibrocontact

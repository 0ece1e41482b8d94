#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/propagators/event_located.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// rates below it are rounding, in parts of the largest so far
    constexpr double rate_rounding = 1e-12;

    DenseMatrix block_of(const DenseMatrix &full, const std::vector<unsigned int> &points)
    {
      DenseMatrix block(points.size(), points.size());
      for (unsigned int i = 0; i < points.size(); ++i)
        for (unsigned int j = 0; j < points.size(); ++j)
          block(i, j) = full(points[i], points[j]);
      return block;
    }

    /// 0 <= q perp gap + M q >= 0 over some points; gap holds the result
    void solve_contact(const DenseMatrix &matrix, const std::vector<unsigned int> &points,
                       std::vector<double> &gap, std::vector<double> &q)
    {
      if (points.size() == 1)
      {
        q[0] = rigid_force(-gap[0] / matrix(points[0], points[0]));
        gap[0] = q[0] > 0 ? 0. : gap[0];
        return;
      }
      ContactProblem problem;
      problem.title = "points at an impact";
      problem.A = std::make_shared<DenseContactOperator>(block_of(matrix, points), 1);
      problem.b = DenseVector(gap.begin(), gap.end());
      ContactSolution found;
      ActiveSetSolver().solve(problem, found);
      std::copy(found.R.begin(), found.R.end(), q.begin());
      std::copy(found.y.begin(), found.y.end(), gap.begin());
    }
  } // namespace

  void EventLocated::pass_jump()
  {
    // what a profile is known to, where its pieces meet, in parts of the largest height and rate so far
    constexpr double height_rounding = 1e-9, kink_rounding = 1e-8;
    std::vector<unsigned int> touching;
    bool bent = false;
    for (unsigned int i = 0; i < n; ++i)
    {
      const PiecewisePolynomial::Value before = road.before(i, now), after = road.after(i, now);
      height_scale = std::max(height_scale, std::abs(after.value));
      const double step = after.value - before.value, rounding = height_rounding * height_scale,
                   gap = displacement(i, 0) - after.value;
      if (step > rounding && (is_closed[i] || gap < -rounding))
      {
        std::ostringstream text;
        text << "The road steps up by " << (is_closed[i] ? step : -gap) << " m into contact point " << i
             << " at t = " << now << " s (" << road.distance(now)
             << " m), which is rigid, so that no finite impulse follows it: give the step a ramp, or the "
                "body a "
                "tread and a stepping method.";
        throw InputError(text.str());
      }
      if (is_closed[i] && step < -rounding)
      {
        releases.push_back({now, i});
        is_closed[i] = just_open[i] = 0;
        closed.erase(std::find(closed.begin(), closed.end(), i));
      }
      else if (is_closed[i])
        bent = bent || before.first != after.first || before.second != after.second;
      else if (!just_open[i] && gap <= smallest_gap() && displacement(i, 1) < after.first)
        touching.push_back(i);
    }
    invert_closed();
    if (bent || !touching.empty())
      touch(touching, kink_rounding * rate_scale);
    else
      project();
  }

  void EventLocated::touch(const std::vector<unsigned int> &touching, const double least_rate)
  {
    std::vector<unsigned int> points = closed;
    points.insert(points.end(), touching.begin(), touching.end());
    std::sort(points.begin(), points.end());
    const unsigned int m = points.size();
    std::vector<double> approach(m), jump(m);
    for (unsigned int i = 0; i < m; ++i)
    {
      const double rate = displacement(points[i], 1), road_rate = road.after(points[i], now).first;
      approach[i] = rate - road_rate;
      rate_scale = std::max({rate_scale, std::abs(rate), std::abs(road_rate)});
    }
    // points that rock bounce ever more often in a finite time; once their flights are too short to be seen, they rest
    const double rounding =
        std::max(least_rate, std::pow(10., std::min(stuck, 8u)) * rate_rounding * rate_scale);
    const std::vector<double> before = approach;
    solve_contact(first, points, approach, jump);
    std::vector<unsigned int> candidates;
    for (unsigned int i = 0; i < m; ++i)
    {
      const unsigned int point = points[i];
      if (jump[i] > 0)
      {
        // what is left of a point's rate after its last impact is none
        if (jump[i] * first(point, point) > rounding)
          impacts.push_back({now, point, jump[i]});
        impulse[point] += jump[i];
        account_so_far.add_power(jump[i] * road.after(point, now).first);
        account_so_far.impacts -= 0.5 * jump[i] * (before[i] + approach[i]);
        for (unsigned int k = 0; k < n_poles; ++k)
          z[k] += model.left(point, k) * jump[i];
      }
      if (jump[i] > 0 || approach[i] <= rounding)
        candidates.push_back(point);
      else
      {
        if (is_closed[point])
          releases.push_back({now, point});
        is_closed[point] = 0;
        just_open[point] = 1;
      }
    }
    closed.clear();
    find_closed_forces(candidates);
  }

  void EventLocated::find_closed_forces(const std::vector<unsigned int> &candidates)
  {
    const unsigned int m = candidates.size();
    if (m > 0)
    {
      std::vector<double> acceleration(m), force(m);
      for (unsigned int i = 0; i < m; ++i)
        acceleration[i] = displacement(candidates[i], 2) - road.after(candidates[i], now).second;
      solve_contact(first, candidates, acceleration, force);
      for (unsigned int i = 0; i < m; ++i)
      {
        const unsigned int point = candidates[i];
        is_closed[point] = force[i] > 0;
        just_open[point] = force[i] <= 0;
        if (force[i] > 0)
          closed.push_back(point);
        else
          releases.push_back({now, point});
      }
    }
    invert_closed();
    project();
  }

  void EventLocated::invert_closed()
  {
    const unsigned int m = closed.size();
    closed_inverse.assign(m * m, 0.);
    if (m == 1)
      closed_inverse[0] = 1 / first(closed[0], closed[0]);
    if (m < 2)
      return;
    DenseMatrix inverse = block_of(first, closed);
    inverse.invert();
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        closed_inverse[i * m + j] = inverse(i, j);
  }

  void EventLocated::project()
  {
    const unsigned int m = closed.size();
    std::vector<double> alpha(m, 0.), beta(m, 0.);
    std::vector<PiecewisePolynomial::Value> wanted;
    for (const unsigned int point : closed)
      wanted.push_back(road.after(point, now));
    for (unsigned int pass = 0; pass < 2 && m > 0; ++pass)
    {
      std::fill(alpha.begin(), alpha.end(), 0.);
      std::fill(beta.begin(), beta.end(), 0.);
      for (unsigned int j = 0; j < m; ++j)
      {
        const double left_over = displacement(closed[j], 0) - wanted[j].value;
        for (unsigned int i = 0; i < m; ++i)
          beta[i] += closed_inverse[i * m + j] * left_over;
      }
      for (unsigned int j = 0; j < m; ++j)
      {
        double left_over = displacement(closed[j], 1) - wanted[j].first;
        for (unsigned int i = 0; i < m; ++i)
          left_over -= second(closed[j], closed[i]) * beta[i];
        for (unsigned int i = 0; i < m; ++i)
          alpha[i] += closed_inverse[i * m + j] * left_over;
      }
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int k = 0; k < n_poles; ++k)
          z[k] -= model.left(closed[i], k) * (alpha[i] + beta[i] * model.poles[k]);
    }
  }
} // namespace vibrocontact

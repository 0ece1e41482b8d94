#include <vibrocontact/contact/unilateral_contact.h>
#include <vibrocontact/response/event_located.h>

#include <algorithm>
#include <cmath>

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
      if (points.size() > 1)
        return UnilateralContact(block_of(matrix, points), "at an impact").solve(gap.data(), q.data());
      q[0] = std::max(0., -gap[0] / matrix(points[0], points[0]));
      gap[0] = std::max(0., gap[0]);
    }
  } // namespace

  void EventLocated::touch(const std::vector<unsigned int> &touching)
  {
    std::vector<unsigned int> points = closed;
    points.insert(points.end(), touching.begin(), touching.end());
    std::sort(points.begin(), points.end());
    const unsigned int m = points.size();
    std::vector<double> approach(m), jump(m);
    for (unsigned int i = 0; i < m; ++i)
    {
      const double rate = displacement(points[i], 1), road_rate = road.at(points[i], now).first;
      approach[i] = rate - road_rate;
      rate_scale = std::max({rate_scale, std::abs(rate), std::abs(road_rate)});
    }
    // points that rock bounce ever more often in a finite time; once their flights are too short to be seen, they rest
    const double rounding = std::pow(10., std::min(stuck, 8u)) * rate_rounding * rate_scale;
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
        acceleration[i] = displacement(candidates[i], 2) - road.at(candidates[i], now).second;
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
      wanted.push_back(road.at(point, now));
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

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/unilateral_contact.h>
#include <vibrocontact/numerics/wide_loops.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int few = 4;
    /// rounding that is no violation, relative to the largest gap
    constexpr double slack = 1e-14;
    /// the kept inverse is made anew after so many changes
    constexpr unsigned long changes_of_one_inverse = 5000;

    double largest(const double *values, const unsigned int n)
    {
      double value = 0;
      for (unsigned int i = 0; i < n; ++i)
        value = std::max(value, std::abs(values[i]));
      return value;
    }
  } // namespace

  double definiteness(const DenseMatrix &matrix)
  {
    const unsigned int n = matrix.m();
    DenseMatrix symmetric(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        symmetric(i, j) = 0.5 * (matrix(i, j) + matrix(j, i));
    dealii::Vector<double> values(n);
    dealii::FullMatrix<double> vectors;
    const double bound = std::max(symmetric.linfty_norm(), std::numeric_limits<double>::min());
    symmetric.compute_eigenvalues_symmetric(-2 * bound, 2 * bound, 2 * std::numeric_limits<double>::min(),
                                            values, vectors);
    return values[0] /
           std::max({std::abs(values[0]), std::abs(values[n - 1]), std::numeric_limits<double>::min()});
  }

  void check_unique_forces(const DenseMatrix &matrix, const std::string &where)
  {
    const double smallest = definiteness(matrix);
    if (!(smallest > 0))
    {
      std::ostringstream text;
      text << "The displacements that unit forces at the contact points make in one step are not a positive "
              "definite "
              "matrix "
           << where << " (smallest over largest eigenvalue " << smallest
           << "), so that the contact forces would not be unique: identify the body with g(0) = 0 and g'(0) "
              "positive "
              "definite, add a tread stiffness or take another step.";
      throw InputError(text.str());
    }
  }

  UnilateralContact::UnilateralContact(const DenseMatrix &full, const std::string &where) : n(full.m())
  {
    check_unique_forces(full, where);
    inverse_1 = 1 / full(0, 0);
    if (n <= few)
    {
      matrix.resize(n * n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          matrix[i * n + j] = full(i, j);
      set_inverses.assign((1u << n) * n * n, 0.);
      for (unsigned int set = 1; set < 1u << n; ++set)
      {
        std::vector<unsigned int> points;
        for (unsigned int i = 0; i < n; ++i)
          if (set >> i & 1)
            points.push_back(i);
        DenseMatrix block(points.size(), points.size());
        for (unsigned int i = 0; i < points.size(); ++i)
          for (unsigned int j = 0; j < points.size(); ++j)
            block(i, j) = full(points[i], points[j]);
        block.invert();
        for (unsigned int i = 0; i < points.size(); ++i)
          for (unsigned int j = 0; j < points.size(); ++j)
            set_inverses[(set * n + points[i]) * n + points[j]] = block(i, j);
      }
      return;
    }
    stride = padded(n);
    matrix.assign(n * stride, 0.);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        matrix[j * stride + i] = full(i, j);
    inverse.assign(n * stride, 0.);
    for (auto *work : {&work_1, &work_2, &x, &b, &start, &now})
      work->assign(stride + wide_width, 0.);
    is_closed.assign(n, 0);
  }

  unsigned int UnilateralContact::n_closed() const
  {
    return n <= few ? __builtin_popcount(last_set) : closed.size();
  }

  template <unsigned int N>
  bool UnilateralContact::try_set(const unsigned int set, const double *gap_0, double *gap, double *q)
  {
    const double *const own = set_inverses.data() + set * N * N;
    double worst = 0, scale = 0, largest_closed = 0;
    for (unsigned int i = 0; i < N; ++i)
    {
      double force = 0;
      for (unsigned int j = 0; j < N; ++j)
        force -= own[i * N + j] * gap_0[j];
      worst = std::min(worst, force * matrix[i * N + i]);
      q[i] = std::max(force, 0.);
      scale = std::max(scale, std::abs(gap_0[i]));
    }
    for (unsigned int i = 0; i < N; ++i)
    {
      double value = gap_0[i];
      for (unsigned int j = 0; j < N; ++j)
        value += matrix[i * N + j] * q[j];
      const bool shut = set >> i & 1;
      worst = shut ? worst : std::min(worst, value);
      largest_closed = shut ? std::max(largest_closed, std::abs(value)) : largest_closed;
      gap[i] = shut ? 0. : value;
    }
    if (!(worst >= -slack * scale))
      return false;
    last_residual = std::max(-worst, largest_closed) / std::max(scale, std::numeric_limits<double>::min());
    return true;
  }

  template <unsigned int N>
  void UnilateralContact::solve_few(double *gap, double *q)
  {
    double gap_0[N], next[N], force[N];
    for (unsigned int i = 0; i < N; ++i)
      gap_0[i] = gap[i];
    bool found = try_set<N>(last_set, gap_0, next, force);
    for (unsigned int set = 0; set < 1u << N && !found; ++set)
    {
      found = try_set<N>(set, gap_0, next, force);
      n_corrections += found;
      last_set = set;
    }
    if (!found)
      throw ConvergenceError("The contact of a step has no solution: the motion is no longer finite.");
    for (unsigned int i = 0; i < N; ++i)
    {
      gap[i] = next[i];
      q[i] = force[i];
    }
  }

  void UnilateralContact::add(const unsigned int point)
  {
    const std::size_t m = closed.size();
    for (std::size_t i = 0; i < m; ++i)
      b[i] = matrix[point * stride + closed[i]];
    multiply_inverse(b.data(), work_1.data());
    for (std::size_t j = 0; j < m; ++j)
      b[j] = matrix[closed[j] * stride + point];
    double pivot = matrix[point * stride + point];
    for (std::size_t j = 0; j < m; ++j)
    {
      work_2[j] = wide_dot(b.data(), inverse.data() + j * stride, m);
      pivot -= b[j] * work_1[j];
    }
    work_1[m] = -1;
    work_2[m] = -1;
    const double factor = 1 / pivot;
    for (std::size_t j = 0; j <= m; ++j)
    {
      double *column = inverse.data() + j * stride;
      const double own = factor * work_2[j];
      for (std::size_t i = 0; i <= m; ++i)
        column[i] += own * work_1[i];
    }
    closed.push_back(point);
    is_closed[point] = 1;
    ++since_rebuilt;
  }

  void UnilateralContact::remove(const unsigned int place)
  {
    const std::size_t m = closed.size() - 1;
    is_closed[closed[place]] = 0;
    if (place != m)
    {
      std::swap(closed[place], closed[m]);
      for (std::size_t j = 0; j <= m; ++j)
        std::swap(inverse[j * stride + place], inverse[j * stride + m]);
      std::swap_ranges(inverse.begin() + place * stride, inverse.begin() + place * stride + m + 1,
                       inverse.begin() + m * stride);
    }
    const double *last = inverse.data() + m * stride;
    const double factor = 1 / last[m];
    for (std::size_t j = 0; j < m; ++j)
    {
      double *column = inverse.data() + j * stride;
      const double own = factor * column[m];
      for (std::size_t i = 0; i < m; ++i)
        column[i] -= own * last[i];
      column[m] = 0;
    }
    std::fill_n(inverse.begin() + m * stride, m + 1, 0.);
    closed.pop_back();
    ++since_rebuilt;
  }

  void UnilateralContact::rebuild()
  {
    const std::vector<unsigned int> points = closed;
    closed.clear();
    std::fill(inverse.begin(), inverse.end(), 0.);
    std::fill(is_closed.begin(), is_closed.end(), 0);
    for (const unsigned int point : points)
      add(point);
    since_rebuilt = 0;
  }

  void UnilateralContact::exchange(CheckpointFile &file)
  {
    file("contact/last_set", last_set);
    file("contact/closed", closed);
    file("contact/corrections", n_corrections);
    if (file.reading())
      renew();
  }

  void UnilateralContact::renew()
  {
    if (n > few)
      rebuild();
  }

  void UnilateralContact::multiply_inverse(const double *right, double *result) const
  {
    const std::size_t m = closed.size();
    std::fill_n(result, padded(m), 0.);
    // only the part that is filled
    wide_add_columns(result, inverse.data(), padded(m), stride, right, m);
  }

  void UnilateralContact::response(const double *gap_0, double *gap, const double *forces) const
  {
    std::copy(gap_0, gap_0 + stride, gap);
    wide_add_columns(gap, matrix.data(), stride, closed.data(), forces, closed.size());
  }

  void UnilateralContact::solve_many(double *gap, double *q)
  {
    std::copy(gap, gap + n, start.begin());
    const double scale = largest(gap, n);
    if (!std::isfinite(scale))
      throw ConvergenceError("The motion is no longer finite.");
    if (since_rebuilt > changes_of_one_inverse)
      rebuild();
    unsigned int fewest = n + 1, in_vain = 0;
    for (unsigned int k = 0;; ++k)
    {
      const std::size_t m = closed.size();
      for (std::size_t i = 0; i < m; ++i)
        b[i] = -start[closed[i]];
      multiply_inverse(b.data(), x.data());
      response(start.data(), now.data(), x.data());
      for (unsigned int again = 0; again < 3; ++again)
      {
        double worst = 0;
        for (std::size_t i = 0; i < m; ++i)
        {
          b[i] = -now[closed[i]];
          worst = std::max(worst, std::abs(b[i]));
        }
        last_residual = worst / std::max(scale, std::numeric_limits<double>::min());
        if (last_residual <= 1e-13)
          break;
        multiply_inverse(b.data(), work_1.data());
        for (std::size_t i = 0; i < m; ++i)
          x[i] += work_1[i];
        response(start.data(), now.data(), x.data());
      }
      wrong.clear();
      for (std::size_t i = 0; i < m; ++i)
        if (x[i] < 0)
          wrong.push_back(closed[i]);
      for (unsigned int i = 0; i < n; ++i)
        if (!is_closed[i] && now[i] < -slack * scale)
          wrong.push_back(i);
      if (wrong.empty())
        break;
      if (k > 50 * n)
        throw ConvergenceError("The contact of a step was not found in " + std::to_string(k) +
                               " corrections.");
      ++n_corrections;
      if (wrong.size() < fewest)
      {
        fewest = wrong.size();
        in_vain = 0;
      }
      else
        ++in_vain;
      if (in_vain > 3)
        wrong = {*std::max_element(wrong.begin(), wrong.end())};
      for (const unsigned int point : wrong)
        if (is_closed[point])
          remove(std::find(closed.begin(), closed.end(), point) - closed.begin());
        else
          add(point);
    }
    std::fill(q, q + n, 0.);
    std::copy(now.begin(), now.begin() + n, gap);
    for (std::size_t i = 0; i < closed.size(); ++i)
    {
      q[closed[i]] = x[i];
      gap[closed[i]] = 0;
    }
  }

  void UnilateralContact::solve(double *gap, double *q)
  {
    if (n == 1)
    {
      const double force = -gap[0] * inverse_1;
      if (!std::isfinite(force))
        throw ConvergenceError("The motion is no longer finite.");
      last_set = force > 0;
      q[0] = force > 0 ? force : 0.;
      gap[0] = force > 0 ? 0. : gap[0];
      return;
    }
    switch (n)
    {
    case 2:
      return solve_few<2>(gap, q);
    case 3:
      return solve_few<3>(gap, q);
    case 4:
      return solve_few<4>(gap, q);
    default:
      solve_many(gap, q);
    }
  }
} // namespace vibrocontact

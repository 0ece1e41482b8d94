#include <vibrocontact/base/checkpoint_file.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/contact/laws/signorini.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/wide_loops.h>

#include <algorithm>
#include <cmath>
#include <numeric>
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

    double largest(const double *const values, const unsigned int n)
    {
      double value = 0;
      for (unsigned int i = 0; i < n; ++i)
        value = std::max(value, std::abs(values[i]));
      return value;
    }

    /// what ContactResidual finds in closed points, from their forces and rho times their gaps, squared and summed
    double relative(const double gaps, const double forces)
    {
      return gaps > 0 ? std::sqrt(gaps / forces) : 0.;
    }
  } // namespace

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

  bool ActiveSetSolver::takes(const ContactProblem &problem)
  {
    return problem.n_components() == 1 && !problem.force_given() && !problem.A->fast_product() &&
           problem.normal_law.all(&NormalLaw::is_rigid);
  }

  void ActiveSetSolver::prepare(const ContactProblem &problem)
  {
    if (A == problem.A)
      return;
    A.reset();
    n = problem.n_points();
    std::vector<unsigned int> all(n);
    std::iota(all.begin(), all.end(), 0);
    DenseMatrix full;
    problem.A->extract(all, full);
    check_unique_forces(full, "in '" + problem.title + "'");
    rho = 1 / problem.A->mean_diagonal(0);
    last_set = 0;
    closed.clear();
    since_rebuilt = 0;
    keep(full);
    A = problem.A;
  }

  void ActiveSetSolver::keep(const DenseMatrix &full)
  {
    matrix.assign(n <= few ? n * n : n * padded(n), 0.);
    if (n <= few)
    {
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
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        matrix[j * stride + i] = full(i, j);
    inverse.assign(n * stride, 0.);
    for (auto *work : {&work_1, &work_2, &x, &b, &start, &now})
      work->assign(stride + wide_width, 0.);
    is_closed.assign(n, 0);
  }

  template <unsigned int N>
  bool ActiveSetSolver::try_set(const unsigned int set, const double *const start_gap, const double scale,
                                ContactSolution &state)
  {
    const double *const own = set_inverses.data() + set * N * N;
    double *const q = state.R.data(), *const gap = state.y.data();
    double worst = 0, gaps = 0, forces = 0;
    for (unsigned int i = 0; i < N; ++i)
    {
      double force = 0;
      for (unsigned int j = 0; j < N; ++j)
        force -= own[i * N + j] * start_gap[j];
      worst = std::min(worst, force * matrix[i * N + i]);
      q[i] = std::max(force, 0.);
      forces += q[i] * q[i];
    }
    for (unsigned int i = 0; i < N; ++i)
    {
      double value = start_gap[i];
      for (unsigned int j = 0; j < N; ++j)
        value += matrix[i * N + j] * q[j];
      const bool shut = set >> i & 1;
      worst = shut ? worst : std::min(worst, value);
      gaps += q[i] > 0 ? rho * value * (rho * value) : 0.;
      gap[i] = shut ? 0. : value;
    }
    state.residual = relative(gaps, forces);
    return worst >= -slack * scale;
  }

  template <unsigned int N>
  void ActiveSetSolver::solve_few(const ContactProblem &problem, ContactSolution &state)
  {
    const double *const gap = state.y.data();
    double start_gap[N], scale = 0;
    for (unsigned int i = 0; i < N; ++i)
    {
      start_gap[i] = gap[i];
      scale = std::max(scale, std::abs(start_gap[i]));
    }
    bool found = try_set<N>(last_set, start_gap, scale, state);
    for (unsigned int set = 0; set < 1u << N && !found; ++set)
    {
      found = try_set<N>(set, start_gap, scale, state);
      state.iterations += found;
      last_set = set;
    }
    if (!found)
      throw ConvergenceError("The contact problem '" + problem.title +
                             "' has no closed set: the motion is no longer finite.");
  }

  void ActiveSetSolver::add(const unsigned int point)
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

  void ActiveSetSolver::remove(const unsigned int place)
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

  void ActiveSetSolver::rebuild()
  {
    const std::vector<unsigned int> points = closed;
    closed.clear();
    std::fill(inverse.begin(), inverse.end(), 0.);
    std::fill(is_closed.begin(), is_closed.end(), 0);
    for (const unsigned int point : points)
      add(point);
    since_rebuilt = 0;
  }

  void ActiveSetSolver::exchange(CheckpointFile &file)
  {
    file("contact/last_set", last_set);
    file("contact/closed", closed);
    if (file.reading())
      renew();
  }

  void ActiveSetSolver::renew()
  {
    if (A && n > few)
      rebuild();
  }

  void ActiveSetSolver::multiply_inverse(const double *right, double *result) const
  {
    const std::size_t m = closed.size();
    std::fill_n(result, padded(m), 0.);
    // only the part that is filled
    wide_add_columns(result, inverse.data(), padded(m), stride, right, m);
  }

  void ActiveSetSolver::response(const double *gap_0, double *gap, const double *forces) const
  {
    std::copy(gap_0, gap_0 + stride, gap);
    wide_add_columns(gap, matrix.data(), stride, closed.data(), forces, closed.size());
  }

  void ActiveSetSolver::solve_many(const ContactProblem &problem, ContactSolution &state)
  {
    std::copy(state.y.begin(), state.y.begin() + n, start.begin());
    const double scale = largest(state.y.data(), n);
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
        if (worst <= 1e-13 * scale)
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
        throw ConvergenceError("The closed set of the contact problem '" + problem.title +
                               "' was not found in " + std::to_string(k) + " corrections.");
      ++state.iterations;
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
    std::fill(state.R.begin(), state.R.end(), 0.);
    std::copy(now.begin(), now.begin() + n, state.y.begin());
    double *const q = state.R.data(), *const gap = state.y.data();
    double gaps = 0, forces = 0;
    for (std::size_t i = 0; i < closed.size(); ++i)
    {
      const double left = rho * now[closed[i]];
      gaps += left * left;
      forces += x[i] * x[i];
      q[closed[i]] = x[i];
      gap[closed[i]] = 0;
    }
    state.residual = relative(gaps, forces);
  }

  void ActiveSetSolver::solve(const ContactProblem &problem, ContactSolution &state)
  {
    prepare(problem);
    if (state.R.size() != n || state.status.size() != n || state.y.size() != n)
    {
      state.R.reinit(n);
      state.y.reinit(n);
      state.status.resize(n);
    }
    // deal.II's own assignments ask first whether to share their work out
    double *const q = state.R.data(), *const gap = state.y.data();
    const double *const b = problem.b.data();
    double sum = 0;
    for (unsigned int i = 0; i < n; ++i)
      gap[i] = b[i];
    state.approach = problem.approach;
    if (state.approach != 0)
      problem.move(state.y, state.approach);
    if (n > few)
      sum = wide_dot(gap, gap, n);
    else
      for (unsigned int i = 0; i < n; ++i)
        sum += gap[i];
    if (!std::isfinite(sum))
      throw ConvergenceError("The gaps of the contact problem '" + problem.title +
                             "' are no longer finite numbers.");
    state.cost() = {};
    state.response_known = false;
    state.converged = true;
    switch (n)
    {
    case 1:
      q[0] = rigid_force(-gap[0] * rho);
      gap[0] = q[0] > 0 ? 0. : gap[0];
      state.residual = 0;
      break;
    case 2:
      solve_few<2>(problem, state);
      break;
    case 3:
      solve_few<3>(problem, state);
      break;
    case 4:
      solve_few<4>(problem, state);
      break;
    default:
      solve_many(problem, state);
    }
    ContactStatus *const status = state.status.data();
    for (unsigned int i = 0; i < n; ++i)
      status[i] = q[i] > 0 ? ContactStatus::stick : ContactStatus::open;
  }
} // namespace vibrocontact

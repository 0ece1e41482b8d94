#include <vibrocontact/contact/laws/friction_law.h>
#include <vibrocontact/periodic/massless_contact.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int most_newton_steps = 30, most_sweeps = 2000;
    constexpr double accuracy = 1e-11;

    /// columns of b <- A^-1 b, n x n and n x m by rows; false if A is singular
    bool eliminate(std::vector<double> A, std::vector<double> &b, const unsigned int n, const unsigned int m)
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        unsigned int pivot = k;
        for (unsigned int i = k + 1; i < n; ++i)
          if (std::abs(A[i * n + k]) > std::abs(A[pivot * n + k]))
            pivot = i;
        if (!(std::abs(A[pivot * n + k]) > 0))
          return false;
        std::swap_ranges(&A[k * n], &A[k * n] + n, &A[pivot * n]);
        std::swap_ranges(&b[k * m], &b[k * m] + m, &b[pivot * m]);
        for (unsigned int i = 0; i < n; ++i)
        {
          const double factor = A[i * n + k] / A[k * n + k];
          if (i == k || factor == 0)
            continue;
          for (unsigned int j = k; j < n; ++j)
            A[i * n + j] -= factor * A[k * n + j];
          for (unsigned int j = 0; j < m; ++j)
            b[i * m + j] -= factor * b[k * m + j];
        }
      }
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int j = 0; j < m; ++j)
          b[k * m + j] /= A[k * n + k];
      return true;
    }
  } // namespace

  MasslessContact::MasslessContact(const DenseMatrix &residual, const double friction)
      : S(residual), friction(friction), n(residual.m())
  {
  }

  double MasslessContact::linearise(const double *const w, const std::vector<double> &before,
                                    const std::vector<double> &gap, const std::vector<double> &p)
  {
    G.assign(n, 0.);
    by_p.assign(n * n, 0.);
    by_w.assign(n * n, 0.);
    by_before.assign(n * n, 0.);
    double size = 0, error = 0;
    std::vector<double> u(w, w + n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        u[i] += S(i, j) * p[j];
    for (unsigned int i = 0; i < n; i += 3)
    {
      // compression N = max(-p + r (u - gap), 0), r = 1 / S
      const double r = 1 / S(i, i), trial = -p[i] + r * (u[i] - gap[i / 3]), N = std::max(trial, 0.);
      G[i] = p[i] + N;
      by_p[i * n + i] = 1;
      std::vector<double> N_by_p(n, 0.);
      if (trial > 0)
      {
        N_by_p[i] = -1;
        for (unsigned int j = 0; j < n; ++j)
          N_by_p[j] += r * S(i, j);
        by_w[i * n + i] = r;
        for (unsigned int j = 0; j < n; ++j)
          by_p[i * n + j] += N_by_p[j];
      }
      const double rt = 1 / std::max(S(i + 1, i + 1), S(i + 2, i + 2));
      const auto law = project_on_disc(
          {{p[i + 1] - rt * (u[i + 1] - before[i + 1]), p[i + 2] - rt * (u[i + 2] - before[i + 2])}},
          friction * N);
      for (unsigned int a = 0; a < 2; ++a)
      {
        const unsigned int row = i + 1 + a;
        G[row] = p[row] - law.force[a];
        by_p[row * n + row] += 1;
        for (unsigned int b = 0; b < 2; ++b)
        {
          const unsigned int column = i + 1 + b;
          by_p[row * n + column] -= law.by_trial[a][b];
          for (unsigned int j = 0; j < n; ++j)
            by_p[row * n + j] += law.by_trial[a][b] * rt * S(column, j);
          by_w[row * n + column] += law.by_trial[a][b] * rt;
          by_before[row * n + column] -= law.by_trial[a][b] * rt;
        }
        if (trial > 0)
        {
          for (unsigned int j = 0; j < n; ++j)
            by_p[row * n + j] -= friction * law.by_radius[a] * N_by_p[j];
          by_w[row * n + i] -= friction * law.by_radius[a] * r;
        }
      }
      size = std::max({size, N, r * std::abs(gap[i / 3])});
      for (unsigned int a = 0; a < 3; ++a)
        error = std::max(error, std::abs(G[i + a]));
    }
    return error / std::max(size, 1e-300);
  }

  bool MasslessContact::solve(const double *const w, const std::vector<double> &before,
                              const std::vector<double> &gap, std::vector<double> &p)
  {
    unsigned int sweeps = 0;
    for (double error = linearise(w, before, gap, p); sweeps < most_sweeps; ++sweeps)
    {
      for (unsigned int k = 0; k < most_newton_steps && error > accuracy; ++k)
      {
        std::vector<double> step = G, trial = p;
        if (!eliminate(by_p, step, n, 1))
          break;
        for (unsigned int i = 0; i < n; ++i)
          trial[i] -= step[i];
        const double next = linearise(w, before, gap, trial);
        if (!(next < error))
          break;
        p = trial;
        error = next;
      }
      if (error <= accuracy)
        return true;
      // point after point where Newton's method gets no further
      for (unsigned int i = 0; i < n; i += 3)
      {
        linearise(w, before, gap, p);
        for (unsigned int a = 0; a < 3; ++a)
          p[i + a] -= G[i + a];
      }
      error = linearise(w, before, gap, p);
    }
    return false;
  }

  bool MasslessContact::march(const std::vector<double> &w, const std::vector<double> &gap,
                              std::vector<double> &p)
  {
    const unsigned int count = w.size() / n;
    std::vector<double> here(n), before(n), force(n, 0.);
    const auto load = [&](const unsigned int k)
    {
      bool is_open = true;
      for (unsigned int i = 0; i < n; ++i)
      {
        here[i] = w[i * count + k];
        is_open = is_open && (i % 3 != 0 || here[i] < gap[i / 3]);
      }
      return is_open;
    };
    unsigned int first = 0;
    while (first < count && !load(first))
      ++first;
    order.clear();
    for (unsigned int k = 0; k < (first < count ? count : 2 * count); ++k)
      order.push_back((first + k) % count);
    rate_w.assign(count, {});
    rate_before.assign(count, {});
    p.assign(w.size(), 0.);
    load(order[0]);
    before = here;
    bool solved = true;
    for (const unsigned int k : order)
    {
      if (load(k))
        std::fill(force.begin(), force.end(), 0.);
      else
      {
        solved = solve(here.data(), before, gap, force) && solved;
        linearise(here.data(), before, gap, force);
        for (double &x : by_w)
          x = -x;
        for (double &x : by_before)
          x = -x;
        solved = eliminate(by_p, by_w, n, n) && eliminate(by_p, by_before, n, n) && solved;
        rate_w[k] = by_w;
        rate_before[k] = by_before;
      }
      for (unsigned int i = 0; i < n; ++i)
      {
        p[i * count + k] = force[i];
        before[i] = here[i];
        for (unsigned int j = 0; j < n; ++j)
          before[i] += S(i, j) * force[j];
      }
    }
    return solved;
  }

  void MasslessContact::add_rates(const DenseMatrix &basis, const DenseMatrix &weights,
                                  DenseMatrix &into) const
  {
    const unsigned int count = basis.m(), N = basis.n(), columns = n * N;
    std::vector<double> values(N), values_before(N), weight(N);
    // rates of the force and of the position before by all coefficients, row by row
    std::vector<double> rate(n * columns), position(n * columns);
    for (unsigned int turn = 0; turn < order.size(); ++turn)
    {
      const unsigned int k = order[turn];
      if (rate_w[k].empty())
        continue;
      const unsigned int last = order[turn > 0 ? turn - 1 : 0];
      for (unsigned int l = 0; l < N; ++l)
      {
        values[l] = basis(k, l);
        values_before[l] = basis(last, l);
        weight[l] = weights(k, l);
      }
      if (turn == 0 || rate_w[last].empty())
      {
        std::fill(position.begin(), position.end(), 0.);
        for (unsigned int i = 0; i < n; ++i)
          std::copy(values_before.begin(), values_before.end(), &position[i * columns + i * N]);
      }
      std::fill(rate.begin(), rate.end(), 0.);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          const double direct = rate_w[k][i * n + j], history = rate_before[k][i * n + j];
          double *const to = &rate[i * columns];
          if (direct != 0)
            for (unsigned int l = 0; l < N; ++l)
              to[j * N + l] += direct * values[l];
          if (history != 0)
            for (unsigned int l = 0; l < columns; ++l)
              to[l] += history * position[j * columns + l];
        }
      if (turn + count >= order.size())
        for (unsigned int column = 0; column < columns; ++column)
        {
          double *const to = &into(0, column);
          for (unsigned int i = 0; i < n; ++i)
          {
            const double value = rate[i * columns + column];
            if (value != 0)
              for (unsigned int l = 0; l < N; ++l)
                to[i * N + l] += weight[l] * value;
          }
        }
      // u = w + S p
      std::fill(position.begin(), position.end(), 0.);
      for (unsigned int i = 0; i < n; ++i)
      {
        std::copy(values.begin(), values.end(), &position[i * columns + i * N]);
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int l = 0; l < columns; ++l)
            position[i * columns + l] += S(i, j) * rate[j * columns + l];
      }
    }
  }
} // namespace vibrocontact

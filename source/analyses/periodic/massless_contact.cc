#include <vibrocontact/analyses/periodic/massless_contact.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// p_n = -N: forces on the body and motions into the stop by those of the contact problem
    double sign(const unsigned int row)
    {
      return row % 3 == 0 ? -1. : 1.;
    }

    /// A in y = A R + b, rows by contact_row(), from S point by point
    DenseMatrix contact_matrix(const DenseMatrix &S)
    {
      const unsigned int n_rows = S.m(), n = n_rows / 3;
      DenseMatrix matrix(n_rows, n_rows);
      for (unsigned int i = 0; i < n_rows; ++i)
        for (unsigned int j = 0; j < n_rows; ++j)
          matrix(i % 3 * n + i / 3, j % 3 * n + j / 3) = sign(i) * sign(j) * S(i, j);
      return matrix;
    }
  } // namespace

  MasslessContact::MasslessContact(const DenseMatrix &residual, const std::vector<double> &friction)
      : S(residual), n(residual.m())
  {
    problem.title = "contact points without mass";
    problem.A = std::make_shared<DenseContactOperator>(contact_matrix(S));
    problem.b.reinit(n);
    problem.mu = friction;
  }

  bool MasslessContact::march(const std::vector<double> &w, const std::vector<double> &gap,
                              std::vector<double> &p)
  {
    const unsigned int count = w.size() / n;
    std::vector<double> here(n), before(n), force(n, 0.), rates(n * n);
    // place of a row in the contact problem
    const auto at = [this](const unsigned int row) { return row % 3 * (n / 3) + row / 3; };
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
    statuses.assign(w.size() / 3, ContactStatus::open);
    solution.R.reinit(n);
    load(order[0]);
    before = here;
    bool solved = true;
    for (const unsigned int k : order)
    {
      if (load(k))
        std::fill(force.begin(), force.end(), 0.);
      else
      {
        for (unsigned int i = 0; i < n; ++i)
        {
          problem.b[at(i)] = i % 3 == 0 ? gap[i / 3] - here[i] : here[i] - before[i];
          solution.R[at(i)] = sign(i) * force[i];
        }
        contact.solve(problem, solution);
        solved = solution.converged && solved;
        for (unsigned int i = 0; i < n / 3; ++i)
          statuses[i * count + k] = solution.status[i];
        solved = contact.sensitivity(rates.data()) && solved;
        rate_w[k].resize(n * n);
        rate_before[k].assign(n * n, 0.);
        for (unsigned int i = 0; i < n; ++i)
        {
          force[i] = sign(i) * solution.R[at(i)];
          for (unsigned int j = 0; j < n; ++j)
          {
            rate_w[k][i * n + j] = sign(i) * sign(j) * rates[at(j) * n + at(i)];
            if (j % 3 != 0)
              rate_before[k][i * n + j] = -rate_w[k][i * n + j];
          }
        }
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

  void MasslessContact::add_rates(const DenseMatrix &basis, const DenseMatrix &weights, DenseMatrix &into,
                                  const double growth) const
  {
    const unsigned int count = basis.m(), N = basis.n(), columns = n * N;
    std::vector<double> values(N), values_before(N);
    // samples are summed in batches, as products of matrices
    constexpr unsigned int batch = 64;
    DenseMatrix weight(N, batch), rates(n * columns, batch), sums(N, n * columns);
    unsigned int waiting = 0;
    const auto add_waiting = [&]
    {
      for (; waiting > 0 && waiting < batch; ++waiting)
        std::fill_n(&weight(0, waiting), N, 0.);
      if (waiting > 0)
        weight.mTmult(sums, rates, true);
      waiting = 0;
    };
    // rates of the force and of the position before by all coefficients, row by row
    std::vector<double> rate(n * columns), position(n * columns);
    // rows whose force changes
    std::vector<unsigned int> loaded;
    for (unsigned int turn = 0; turn < order.size(); ++turn)
    {
      const unsigned int k = order[turn];
      if (rate_w[k].empty())
        continue;
      const unsigned int last = order[turn > 0 ? turn - 1 : 0];
      const double grown = std::exp(growth * turn),
                   grown_before = turn > 0 ? std::exp(growth * (turn - 1.)) : 1.;
      for (unsigned int l = 0; l < N; ++l)
      {
        values[l] = grown * basis(k, l);
        values_before[l] = grown_before * basis(last, l);
      }
      if (turn == 0 || rate_w[last].empty())
      {
        std::fill(position.begin(), position.end(), 0.);
        for (unsigned int i = 0; i < n; ++i)
          std::copy(values_before.begin(), values_before.end(), &position[i * columns + i * N]);
      }
      std::fill(rate.begin(), rate.end(), 0.);
      loaded.clear();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          const double direct = rate_w[k][i * n + j], history = rate_before[k][i * n + j];
          if ((direct != 0 || history != 0) && (loaded.empty() || loaded.back() != i))
            loaded.push_back(i);
          double *const to = &rate[i * columns];
          if (direct != 0)
            for (unsigned int l = 0; l < N; ++l)
              to[j * N + l] += direct * values[l];
          if (history != 0)
            for (unsigned int l = 0; l < columns; ++l)
              to[l] += history * position[j * columns + l];
        }
      if (turn + count >= order.size())
      {
        for (unsigned int l = 0; l < N; ++l)
          weight(l, waiting) = weights(k, l) / grown;
        std::copy(rate.begin(), rate.end(), &rates(0, waiting));
        if (++waiting == batch)
          add_waiting();
      }
      // u = w + S p
      std::fill(position.begin(), position.end(), 0.);
      for (unsigned int i = 0; i < n; ++i)
      {
        std::copy(values.begin(), values.end(), &position[i * columns + i * N]);
        for (const unsigned int j : loaded)
          for (unsigned int l = 0; l < columns; ++l)
            position[i * columns + l] += S(i, j) * rate[j * columns + l];
      }
    }
    add_waiting();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int column = 0; column < columns; ++column)
        for (unsigned int l = 0; l < N; ++l)
          into(i * N + l, column) += sums(l, i * columns + column);
  }
} // namespace vibrocontact

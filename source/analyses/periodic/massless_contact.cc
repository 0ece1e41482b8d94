#include <vibrocontact/analyses/periodic/massless_contact.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  MasslessContact::MasslessContact(const DenseMatrix &residual, const std::vector<double> &friction)
      : points(residual, 3, friction), n(residual.m())
  {
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
        is_open = is_open && (!points.is_normal(i) || here[i] < gap[i / 3]);
      }
      return is_open;
    };
    unsigned int first = 0;
    while (first < count && !load(first))
      ++first;
    order.clear();
    for (unsigned int k = 0; k < (first < count ? count : 2 * count); ++k)
      order.push_back((first + k) % count);
    rates.assign(count, {});
    p.assign(w.size(), 0.);
    statuses.assign(w.size() / 3, ContactStatus::open);
    load(order[0]);
    before = here;
    bool solved = true;
    for (const unsigned int k : order)
    {
      if (load(k))
        std::fill(force.begin(), force.end(), 0.);
      else
      {
        solved = points.solve(here, before.data(), gap, force) && solved;
        for (unsigned int i = 0; i < n / 3; ++i)
          statuses[i * count + k] = points.status()[i];
        rates[k].resize(n * n);
        solved = points.rates(rates[k].data()) && solved;
      }
      for (unsigned int i = 0; i < n; ++i)
      {
        p[i * count + k] = force[i];
        before[i] = here[i];
        for (unsigned int j = 0; j < n; ++j)
          before[i] += points.S(i, j) * force[j];
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
    DenseMatrix weight(N, batch), forces(n * columns, batch), sums(N, n * columns);
    unsigned int waiting = 0;
    const auto add_waiting = [&]
    {
      for (; waiting > 0 && waiting < batch; ++waiting)
        std::fill_n(&weight(0, waiting), N, 0.);
      if (waiting > 0)
        weight.mTmult(sums, forces, true);
      waiting = 0;
    };
    // rates of the force and of the position before by all coefficients, a column for each row
    DenseMatrix rate(columns, n), position(columns, n), history(n, n);
    for (unsigned int turn = 0; turn < order.size(); ++turn)
    {
      const unsigned int k = order[turn];
      if (rates[k].empty())
        continue;
      const unsigned int last = order[turn > 0 ? turn - 1 : 0];
      const double grown = std::exp(growth * turn),
                   grown_before = turn > 0 ? std::exp(growth * (turn - 1.)) : 1.;
      for (unsigned int l = 0; l < N; ++l)
      {
        values[l] = grown * basis(k, l);
        values_before[l] = grown_before * basis(last, l);
      }
      if (turn == 0 || rates[last].empty())
      {
        position = 0.;
        for (unsigned int i = 0; i < n; ++i)
          std::copy(values_before.begin(), values_before.end(), &position(i * N, i));
      }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          history(j, i) = points.is_normal(j) ? 0. : -rates[k][i * n + j];
      position.mmult(rate, history);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int l = 0; l < N; ++l)
            rate(j * N + l, i) += rates[k][i * n + j] * values[l];
      if (turn + count >= order.size())
      {
        for (unsigned int l = 0; l < N; ++l)
          weight(l, waiting) = weights(k, l) / grown;
        std::copy_n(&rate(0, 0), n * columns, &forces(0, waiting));
        if (++waiting == batch)
          add_waiting();
      }
      // u = w + S p
      rate.mTmult(position, points.S);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int l = 0; l < N; ++l)
          position(i * N + l, i) += values[l];
    }
    add_waiting();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int column = 0; column < columns; ++column)
        for (unsigned int l = 0; l < N; ++l)
          into(i * N + l, column) += sums(l, i * columns + column);
  }
} // namespace vibrocontact

#include <vibrocontact/contact/newton_jacobian.h>

namespace vibrocontact
{
  NewtonJacobian::NewtonJacobian(const ContactProblem &problem, const double rho_normal,
                                 const double rho_tangential, const DenseVector &R, const DenseVector &y)
      : problem(problem), n(problem.n_points()), rho_t(rho_tangential), dR(3 * n), dy(3 * n)
  {
    for (unsigned int i = 0; i < n; ++i)
    {
      const NormalLaw::Projection normal = problem.normal_law[i].project(R[i], y[i], rho_normal);
      if (normal.by_force == 0 && normal.by_gap == 0)
        continue;
      const DiscProjection friction = project_on_disc(
          {{R[n + i] - rho_t * y[n + i], R[2 * n + i] - rho_t * y[2 * n + i]}}, problem.mu[i] * normal.force);
      active.push_back(i);
      rows.push_back({normal.by_force,
                      normal.by_gap,
                      friction.by_trial,
                      {{problem.mu[i] * friction.by_radius[0], problem.mu[i] * friction.by_radius[1]}}});
    }
  }

  double NewtonJacobian::approach_scale() const
  {
    return rows.empty() || rows[0].by_gap == 0 ? 1 : -1 / rows[0].by_gap;
  }

  std::array<double, 3> NewtonJacobian::apply(const Row &r, const double dN, const double dTx,
                                              const double dTy, const double dgap, const double dsx,
                                              const double dsy) const
  {
    const double dP = r.by_force * dN + r.by_gap * dgap;
    const double tx = dTx - rho_t * dsx, ty = dTy - rho_t * dsy;
    return {{dN - dP, dTx - r.by_trial[0][0] * tx - r.by_trial[0][1] * ty - r.by_radius[0] * dP,
             dTy - r.by_trial[1][0] * tx - r.by_trial[1][1] * ty - r.by_radius[1] * dP}};
  }

  std::array<double, 3> NewtonJacobian::by_approach(const unsigned int k, const Row &row) const
  {
    const std::array<double, 3> a = problem.approach_of(active[k]);
    const double scale = approach_scale();
    return apply(row, 0, 0, 0, -scale * a[0], -scale * a[1], -scale * a[2]);
  }

  void NewtonJacobian::vmult(DenseVector &dst, const DenseVector &src) const
  {
    const unsigned int m = active.size();
    dR = 0;
    scatter(src, dR);
    problem.A->vmult_among(dy, dR, active);
    const double d_approach = problem.force_given() ? src[3 * m] * approach_scale() : 0;
    double sum = 0;
    for (unsigned int k = 0; k < m; ++k)
    {
      const unsigned int i = active[k];
      const std::array<double, 3> a = problem.approach_of(i), l = problem.share_of(i);
      const auto value = apply(rows[k], dR[i], dR[n + i], dR[2 * n + i], dy[i] - d_approach * a[0],
                               dy[n + i] - d_approach * a[1], dy[2 * n + i] - d_approach * a[2]);
      for (unsigned int c = 0; c < 3; ++c)
      {
        dst[c * m + k] = value[c];
        sum += l[c] * dR[c * n + i];
      }
    }
    if (problem.force_given())
      dst[3 * m] = sum;
  }

  void NewtonJacobian::assemble(const DenseMatrix &A, DenseMatrix &J) const
  {
    const unsigned int m = active.size();
    J.reinit(size());
    for (unsigned int column = 0; column < 3 * m; ++column)
    {
      const double *const a = &A(0, column);
      double *const out = &J(0, column);
      const unsigned int c = column / m, own = column % m;
      for (unsigned int k = 0; k < m; ++k)
      {
        const auto value = apply(rows[k], 0, 0, 0, a[k], a[m + k], a[2 * m + k]);
        out[k] = value[0];
        out[m + k] = value[1];
        out[2 * m + k] = value[2];
      }
      const std::array<double, 3> diagonal = apply(rows[own], c == 0, c == 1, c == 2, 0, 0, 0);
      for (unsigned int row = 0; row < 3; ++row)
        out[row * m + own] += diagonal[row];
      if (problem.force_given())
        J(3 * m, column) = problem.share_of(active[own])[c];
    }
    if (problem.force_given())
      for (unsigned int k = 0; k < m; ++k)
      {
        const std::array<double, 3> value = by_approach(k, rows[k]);
        for (unsigned int row = 0; row < 3; ++row)
          J(row * m + k, 3 * m) = value[row];
      }
  }

  void NewtonJacobian::assemble_difference(const unsigned int k, const Row &before, const DenseMatrix &A,
                                           DenseMatrix &differences, const unsigned int at) const
  {
    const unsigned int m = active.size();
    const auto entries = [&](const Row &r, const unsigned int column)
    {
      const unsigned int c = column % m == k ? column / m : 3;
      return apply(r, c == 0, c == 1, c == 2, A(k, column), A(m + k, column), A(2 * m + k, column));
    };
    for (unsigned int column = 0; column < 3 * m; ++column)
    {
      const auto now = entries(rows[k], column), then = entries(before, column);
      for (unsigned int row = 0; row < 2; ++row)
        differences(at + row, column) = now[row + 1] - then[row + 1];
    }
    if (problem.force_given())
    {
      const auto now = by_approach(k, rows[k]), then = by_approach(k, before);
      for (unsigned int row = 0; row < 2; ++row)
        differences(at + row, 3 * m) = now[row + 1] - then[row + 1];
    }
  }

  void NewtonJacobian::scatter(const DenseVector &values, DenseVector &full) const
  {
    const unsigned int m = active.size();
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int k = 0; k < m; ++k)
        full[c * n + active[k]] = values[c * m + k];
  }
} // namespace vibrocontact

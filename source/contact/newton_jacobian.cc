#include <vibrocontact/contact/newton_jacobian.h>

namespace vibrocontact
{
  void NewtonJacobian::linearise(const ContactProblem &of, const ContactResidual &residual,
                                 const DenseVector &R, const DenseVector &y)
  {
    problem = &of;
    n = of.n_points();
    components = of.n_components();
    active.clear();
    rows.clear();
    for (unsigned int i = 0; i < n; ++i)
    {
      const NormalLaw::Projection normal = of.normal_law[i].project(R[i], y[i], residual.rho_normal_of(i));
      if (normal.by_force == 0 && normal.by_gap == 0)
        continue;
      active.push_back(i);
      if (components == 1)
      {
        rows.push_back({normal.by_force, normal.by_gap, {}, {}, 0});
        continue;
      }
      const auto force = at_point(R, n, components, i), slip = at_point(y, n, components, i);
      const double rho = residual.rho_tangential_of(i);
      const DiscProjection friction =
          project_on_disc({{force[1] - rho * slip[1], force[2] - rho * slip[2]}}, of.mu[i] * normal.force);
      rows.push_back({normal.by_force,
                      normal.by_gap,
                      friction.by_trial,
                      {{of.mu[i] * friction.by_radius[0], of.mu[i] * friction.by_radius[1]}},
                      rho});
    }
  }

  double NewtonJacobian::approach_scale() const
  {
    return rows.empty() || rows[0].by_gap == 0 ? 1 : -1 / rows[0].by_gap;
  }

  std::array<double, 3> NewtonJacobian::apply(const Row &r, const double dN, const double dTx,
                                              const double dTy, const double dgap, const double dsx,
                                              const double dsy)
  {
    const double dP = r.by_force * dN + r.by_gap * dgap;
    const double tx = dTx - r.rho * dsx, ty = dTy - r.rho * dsy;
    return {{dN - dP, dTx - r.by_trial[0][0] * tx - r.by_trial[0][1] * ty - r.by_radius[0] * dP,
             dTy - r.by_trial[1][0] * tx - r.by_trial[1][1] * ty - r.by_radius[1] * dP}};
  }

  NewtonJacobian::Blocks NewtonJacobian::blocks_of(const Row &row)
  {
    Blocks blocks;
    for (unsigned int c = 0; c < 3; ++c)
    {
      const auto by_force = apply(row, c == 0, c == 1, c == 2, 0, 0, 0),
                 by_response = apply(row, 0, 0, 0, c == 0, c == 1, c == 2);
      for (unsigned int i = 0; i < 3; ++i)
      {
        blocks.by_force[i][c] = by_force[i];
        blocks.by_response[i][c] = by_response[i];
      }
    }
    return blocks;
  }

  std::array<double, 3> NewtonJacobian::response_to_approach(const unsigned int k) const
  {
    const std::array<double, 3> a = problem->approach_of(active[k]);
    const double scale = approach_scale();
    return {{-scale * a[0], -scale * a[1], -scale * a[2]}};
  }

  void NewtonJacobian::vmult(DenseVector &dst, const DenseVector &src) const
  {
    const unsigned int m = active.size();
    dR.reinit(components * n);
    scatter(src, dR);
    problem->A->vmult_among(dy, dR, active);
    const double d_approach = problem->force_given() ? src[components * m] * approach_scale() : 0;
    double sum = 0;
    for (unsigned int k = 0; k < m; ++k)
    {
      const unsigned int i = active[k];
      const std::array<double, 3> a = problem->approach_of(i), l = problem->share_of(i);
      const auto force = at_point(dR, n, components, i), moved = at_point(dy, n, components, i);
      const auto value = apply(rows[k], force[0], force[1], force[2], moved[0] - d_approach * a[0],
                               moved[1] - d_approach * a[1], moved[2] - d_approach * a[2]);
      for (unsigned int c = 0; c < components; ++c)
      {
        dst[c * m + k] = value[c];
        sum += l[c] * force[c];
      }
    }
    if (problem->force_given())
      dst[components * m] = sum;
  }

  void NewtonJacobian::assemble(const DenseMatrix &A, DenseMatrix &J) const
  {
    const unsigned int m = active.size();
    J.reinit(size());
    // what rows that a point has not read and write
    const std::vector<double> zero(components < 3 ? m : 0, 0.);
    std::vector<double> nowhere(zero);
    for (unsigned int column = 0; column < components * m; ++column)
    {
      const double *const a = &A(0, column), *const ax = components > 1 ? a + m : zero.data(),
                          *const ay = components > 2 ? a + 2 * m : zero.data();
      double *const out = &J(0, column), *const out_x = components > 1 ? out + m : nowhere.data(),
                    *const out_y = components > 2 ? out + 2 * m : nowhere.data();
      const unsigned int c = column / m, own = column % m;
      for (unsigned int k = 0; k < m; ++k)
      {
        const auto value = apply(rows[k], 0, 0, 0, a[k], ax[k], ay[k]);
        out[k] = value[0];
        out_x[k] = value[1];
        out_y[k] = value[2];
      }
      const std::array<double, 3> diagonal = apply(rows[own], c == 0, c == 1, c == 2, 0, 0, 0);
      for (unsigned int row = 0; row < components; ++row)
        out[row * m + own] += diagonal[row];
      if (problem->force_given())
        J(components * m, column) = problem->share_of(active[own])[c];
    }
    if (problem->force_given())
      for (unsigned int k = 0; k < m; ++k)
      {
        const std::array<double, 3> y = response_to_approach(k), value = apply(k, 0, 0, 0, y[0], y[1], y[2]);
        for (unsigned int row = 0; row < components; ++row)
          J(row * m + k, components * m) = value[row];
      }
  }

  void NewtonJacobian::scatter(const DenseVector &values, DenseVector &full) const
  {
    const unsigned int m = active.size();
    for (unsigned int c = 0; c < components; ++c)
      for (unsigned int k = 0; k < m; ++k)
        full[c * n + active[k]] = values[c * m + k];
  }
} // namespace vibrocontact

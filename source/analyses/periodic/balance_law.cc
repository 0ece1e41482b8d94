#include <vibrocontact/analyses/periodic/balance.h>

#include <limits>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
    using Quantity = TimeSampling::Quantity;
  } // namespace

  /// The law of the equation at the head of PeriodicBalance, sample by sample: law_samples, and its derivatives by_u,
  /// by_v (by f Q' u) and by_c (by L c), blocks of a point's rows a, b as [(a rows + b) count + k].
  void PeriodicBalance::apply_law(const std::vector<double> &c)
  {
    const unsigned int N = settings.n_functions, count = samples->n_samples(), rows = body.rows_per_point;
    const bool friction = settings.friction > 0;
    evaluated = c;
    displacement_from(c, linear.linear, linear.compliance, u);
    if (massless)
    {
      apply_massless(c);
      return;
    }
    for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
    {
      if (is_normal(i))
        samples->samples(Quantity::displacement, &u[i * N], &u_samples[i * count]);
      else if (friction)
        samples->samples(Quantity::velocity, &u[i * N], &v_samples[i * count]);
      if (is_normal(i) ? !law[i / rows].is_function_of_gap() : friction)
        samples->samples(Quantity::force, &c[i * N], &c_samples[i * count]);
    }
    for (unsigned int p = 0; p < body.n_points(); ++p)
    {
      const unsigned int normal = p * rows * count;
      const NormalLaw &own = law[p];
      const bool is_spring = own.is_function_of_gap();
      const double mu = friction_of(p);
      double *const du = &by_u[p * rows * rows * count], *const dc = &by_c[p * rows * rows * count],
                    *const dv = &by_v[p * rows * rows * count];
      for (unsigned int k = 0; k < count; ++k)
      {
        const double gap = body.gap[p] - u_samples[normal + k];
        if (is_spring)
        {
          const NormalLaw::GraphPoint at = over_gap(p, gap);
          law_samples[normal + k] = law_factor * at.force;
          du[k] = law_factor * at.force_slope;
        }
        else
        {
          const auto value = own.project(c_samples[normal + k], gap, normal_rho);
          law_samples[normal + k] = value.force;
          du[k] = -value.by_gap;
          dc[k] = value.by_force;
        }
        status[p * count + k] = du[k] != 0 ? ContactStatus::slip : ContactStatus::open;
      }
      if (!friction)
        continue;
      const unsigned int first = normal + count, second = first + count;
      const double f = force.frequency;
      for (unsigned int k = 0; k < count; ++k)
      {
        const Vector2 trial = {{c_samples[first + k] - tangential_rho * f * v_samples[first + k],
                                c_samples[second + k] - tangential_rho * f * v_samples[second + k]}};
        // the disc's radius mu N moves with the normal row: chain rule through law_samples[normal + k]
        const auto value = project_on_disc(trial, mu * law_samples[normal + k]);
        if (value.sticks && status[p * count + k] != ContactStatus::open)
          status[p * count + k] = ContactStatus::stick;
        for (unsigned int a = 0; a < 2; ++a)
        {
          if (is_inert[p * rows + 1 + a])
            continue; // its law and derivatives stay zero
          law_samples[first + a * count + k] = value.force[a];
          const unsigned int row = (a + 1) * rows;
          du[row * count + k] = mu * value.by_radius[a] * du[k];
          dc[row * count + k] = mu * value.by_radius[a] * dc[k];
          for (unsigned int b = 0; b < 2; ++b)
          {
            dc[(row + 1 + b) * count + k] = value.by_trial[a][b];
            dv[(row + 1 + b) * count + k] = -tangential_rho * value.by_trial[a][b];
          }
        }
      }
    }
  }

  /// The same where the forces follow from the motion of the modes: w = u - S p, whose order m has S p_m / A_0(m) in it.
  void PeriodicBalance::apply_massless(const std::vector<double> &c)
  {
    const unsigned int N = settings.n_functions, count = samples->n_samples(), rows = body.rows_per_point,
                       n = body.n_contact_rows();
    std::vector<double> w = u;
    for (unsigned int i = 0; i < n; ++i)
    {
      samples->samples(Quantity::displacement, &u[i * N], &u_samples[i * count]);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int m = 0; 2 * m <= N; ++m)
        {
          const bool is_real = m == 0 || 2 * m == N;
          const unsigned int at = m == 0 ? 0 : 2 * m - 1;
          const Complex r = body.residual(i, j) * sign(j) / pairing.a0[m] *
                            Complex(c[j * N + at], is_real ? 0. : c[j * N + at + 1]);
          w[i * N + at] -= r.real();
          if (!is_real)
            w[i * N + at + 1] -= r.imag();
        }
      samples->samples(Quantity::displacement, &w[i * N], &modal_samples[i * count]);
    }
    if (!massless->march(modal_samples, body.gap, law_samples))
      law_samples[0] = std::numeric_limits<double>::quiet_NaN(); // Newton's method turns back
    status = massless->status();
    for (unsigned int i = 0; i < n; i += rows)
      for (unsigned int k = 0; k < count; ++k)
        law_samples[i * count + k] *= -1;
  }

  std::array<double, 3> PeriodicBalance::contact_force(const unsigned int point,
                                                       const std::array<double, 3> &given, const double gap,
                                                       const std::array<double, 3> &velocity) const
  {
    std::array<double, 3> result{};
    result[0] = law[point].is_function_of_gap() ? over_gap(point, gap).force
                                                : law[point].project(given[0], gap, normal_rho).force;
    if (settings.friction > 0)
    {
      const auto value = project_on_disc(
          {{given[1] - tangential_rho * velocity[1], given[2] - tangential_rho * velocity[2]}},
          friction_of(point) * result[0]);
      result[1] = value.force[0];
      result[2] = value.force[1];
    }
    return result;
  }

  void PeriodicBalance::assemble_law(DenseMatrix &by_force, DenseMatrix &by_motion) const
  {
    const unsigned int N = settings.n_functions, n = body.n_contact_rows(), count = samples->n_samples(),
                       rows = body.rows_per_point;
    const bool friction = settings.friction > 0;
    by_force.reinit(n * N, n * N);
    by_motion.reinit(n * N, n * N);
    if (massless)
      by_motion = massless_rates(0);
    for (unsigned int p = 0; p < (massless ? 0 : body.n_points()); ++p)
    {
      const bool is_spring = law[p].is_function_of_gap();
      for (unsigned int a = 0; a < rows; ++a)
        for (unsigned int b = 0; b < rows; ++b)
        {
          if (!friction && (a > 0 || b > 0))
            continue;
          const std::size_t at = std::size_t((p * rows + a) * rows + b) * count;
          const unsigned int row = (p * rows + a) * N, column = (p * rows + b) * N;
          if (b == 0)
            samples->add_weighted(&by_u[at], Quantity::displacement, 1., by_motion, row, column);
          else if (a > 0)
            samples->add_weighted(&by_v[at], Quantity::velocity, force.frequency, by_motion, row, column);
          if (!is_spring || (a > 0 && b > 0))
            samples->add_weighted(&by_c[at], Quantity::force, -1., by_force, row, column);
        }
    }
  }

  DenseMatrix PeriodicBalance::massless_rates(const double growth) const
  {
    const unsigned int N = settings.n_functions, size = body.n_contact_rows() * N;
    DenseMatrix result(size, size);
    massless->add_rates(trial_values, moment_weights, result, growth);
    for (unsigned int i = 0; i < size; ++i)
      if (is_normal(i / N))
        for (unsigned int j = 0; j < size; ++j)
          result(i, j) *= -1;
    return result;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/periodic/periodic_motion.h>
#include <vibrocontact/base/dense_operations.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// values (samples x N) times one row's coefficients
    std::vector<double> times(const DenseMatrix &values, const double *const coefficients,
                              const double factor = 1)
    {
      DenseVector x(values.n()), y(values.m());
      std::copy(coefficients, coefficients + values.n(), x.begin());
      values.vmult(y, x);
      y *= factor;
      return {y.begin(), y.end()};
    }

    double mean_square(const std::vector<double> &x)
    {
      double sum = 0;
      for (const double value : x)
        sum += value * value;
      return sum / x.size();
    }
  } // namespace

  namespace
  {
    /// r^T S^-1 r / 2 of the rows that have a residual, r their motion less the modes' part of it
    void add_residual_energy(const ForcedBody &body, const DenseMatrix &values, const DenseMatrix &q,
                             const std::vector<double> &displacement, std::vector<double> &energy)
    {
      std::vector<unsigned int> rows;
      for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
        if (body.residual(i, i) > 0)
          rows.push_back(i);
      DenseMatrix S(rows.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        for (unsigned int j = 0; j < rows.size(); ++j)
          S(i, j) = body.residual(rows[i], rows[j]);
      if (rows.empty() || !factorise_cholesky(S))
        return;
      std::vector<std::vector<double>> r;
      for (const unsigned int row : rows)
      {
        r.push_back(times(values, &displacement[row * values.n()]));
        for (unsigned int k = 0; k < body.n_modes(); ++k)
          for (unsigned int i = 0; i < energy.size(); ++i)
            r.back()[i] -= body.trace(row, k) * q(i, k);
      }
      DenseVector force(rows.size());
      for (unsigned int i = 0; i < energy.size(); ++i)
      {
        for (unsigned int a = 0; a < rows.size(); ++a)
          force(a) = r[a][i];
        S.solve(force);
        for (unsigned int a = 0; a < rows.size(); ++a)
          energy[i] += 0.5 * force(a) * r[a][i];
      }
    }
  } // namespace

  double relative(const double difference, const double size)
  {
    return difference == 0 ? 0. : size == 0 ? 1. : std::abs(difference / size);
  }

  double relative_error(const std::vector<double> &a, const std::vector<double> &b)
  {
    std::vector<double> difference(a.size());
    for (unsigned int i = 0; i < a.size(); ++i)
      difference[i] = a[i] - b[i];
    return relative(std::sqrt(mean_square(difference)), std::sqrt(mean_square(b)));
  }

  PeriodicMotion sample_motion(const PeriodicBalance &balance, const PeriodicSolution &solution,
                               const unsigned int n_samples)
  {
    const ForcedBody &body = balance.linear_body();
    const unsigned int N = balance.settings.n_functions, rows = body.rows_per_point;
    const double f = solution.excitation.frequency;
    PeriodicMotion motion;
    std::vector<double> basis_phase;
    for (unsigned int i = 0; i < n_samples; ++i)
    {
      motion.phase.push_back(double(i) / n_samples);
      const double t = motion.phase.back() - solution.excitation.phase / (2 * M_PI);
      basis_phase.push_back(t - std::floor(t));
    }
    const DenseMatrix values = sampled(balance.trial(), basis_phase, 0),
                      slopes = sampled_velocity(balance.trial(), basis_phase),
                      forces = over_norms(sampled(balance.weighting(), basis_phase, 0), balance.integrals());

    motion.energy.assign(n_samples, 0.);
    const double period = 1 / f;
    for (unsigned int p = 0; p < body.n_points(); ++p)
    {
      PointHistory point;
      const unsigned int row = p * rows;
      point.displacement = times(values, &solution.displacement[row * N]);
      point.velocity = times(slopes, &solution.displacement[row * N], f);
      std::vector<std::vector<double>> force(rows), velocity(rows);
      for (unsigned int a = 0; a < rows; ++a)
      {
        force[a] = times(forces, &solution.force[(row + a) * N]);
        velocity[a] = times(slopes, &solution.displacement[(row + a) * N], f);
        if (a > 0)
          point.tangential_displacement[a - 1] = times(values, &solution.displacement[(row + a) * N]);
      }
      double impulse = 0;
      for (unsigned int i = 0; i < n_samples; ++i)
      {
        std::array<double, 3> given{}, speed{};
        for (unsigned int a = 0; a < rows; ++a)
        {
          given[a] = force[a][i];
          speed[a] = velocity[a][i];
        }
        const double gap = body.gap[p] - point.displacement[i];
        const std::array<double, 3> contact = balance.contact_force(p, given, gap, speed);
        point.contact_force.push_back(contact[0]);
        for (unsigned int a = 1; a < rows; ++a)
          point.tangential_force[a - 1].push_back(contact[a]);
        impulse += contact[0] * period / n_samples;
        motion.energy[i] += balance.normal_law(p).potential(gap);
        motion.penetration = std::max(motion.penetration, -gap);
      }
      motion.impulse.push_back(impulse);
      motion.points.push_back(std::move(point));
    }
    const auto [least, most] =
        std::minmax_element(motion.points[0].displacement.begin(), motion.points[0].displacement.end());
    motion.tip_min = *least;
    motion.tip_max = *most;

    if (body.n_poles() > 0)
    {
      motion.energy.clear();
      return motion;
    }
    const DenseMatrix q = modal_coefficients(body, balance.integrals(), solution.excitation,
                                             balance.body_forces(solution.force)),
                      x = product(values, q), v = product(slopes, q);
    for (unsigned int k = 0; k < body.n_modes(); ++k)
      for (unsigned int i = 0; i < n_samples; ++i)
        motion.energy[i] +=
            0.5 * (f * f * v(i, k) * v(i, k) + body.omega[k] * body.omega[k] * x(i, k) * x(i, k));
    add_residual_energy(body, values, x, solution.displacement, motion.energy);
    motion.energy_norm = std::sqrt(mean_square(motion.energy));
    return motion;
  }
} // namespace vibrocontact

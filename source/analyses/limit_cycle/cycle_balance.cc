#include <vibrocontact/analyses/limit_cycle/cycle_balance.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/contact/point_rows.h>
#include <vibrocontact/numerics/time_basis.h>

#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// equal times per function at which the projections are looked at, and the fewest
    constexpr unsigned int samples_per_function = 4, fewest_samples = 64;
    /// GMRES stops at this share of the residual, and gives up after so many products
    constexpr double linear_balance_tolerance = 1e-3;
    constexpr unsigned int most_balance_products = 300;

    /// Values of 1, 2 cos, -2 sin, ... at equal times after the begin of a period, the last one at its end.
    DenseMatrix fourier_values(const unsigned int n_functions, const unsigned int n_times)
    {
      std::vector<double> phases;
      for (unsigned int i = 0; i < n_times; ++i)
        phases.push_back((i + 1.) / n_times);
      return sampled(*create_time_basis("fourier", n_functions), phases, 0);
    }

    /// Harmonics of values at those times are values^T times these.
    DenseMatrix fourier_weights(DenseMatrix values)
    {
      for (unsigned int k = 0; k < values.n(); ++k)
        for (unsigned int i = 0; i < values.m(); ++i)
          values(i, k) /= values.m() * (k == 0 ? 1. : 2.);
      return values;
    }

    double squares(const DenseMatrix &matrix)
    {
      return std::pow(matrix.frobenius_norm(), 2);
    }
  } // namespace

  CycleBalance::CycleBalance(const ContactPair &pair, const ContactSections &contact, const Drive &drive,
                             const DynamicState &at_rest, const PatchShapes &shapes,
                             const std::vector<unsigned int> &points, const unsigned int n_harmonics,
                             const double tolerance)
      : pair(pair), at_rest(at_rest), points(points), n(points.size()), n_functions(2 * n_harmonics + 1),
        force_given(drive.normal_force > 0), tolerance(tolerance),
        response(pair, find_creep_scheme(contact.first().creep_scheme), drive.creepage.speed, shapes, points,
                 n_harmonics),
        rest_forces(on_points(at_rest.R, points)), rest_response(on_points(at_rest.contact.y, points)),
        values(fourier_values(n_functions, std::max(fewest_samples, samples_per_function * n_functions))),
        weights(fourier_weights(values)), samples(values.m())
  {
    const CreepScheme &scheme = find_creep_scheme(contact.first().creep_scheme);
    rigid = rigid_slip(pair.interface.contacts, scheme, drive.creepage);
    const ContactProblem whole = rolling_problem(nullptr, pair.interface, scheme, drive.creepage, contact);
    problem.title = "harmonic balance";
    for (const unsigned int point : points)
      problem.mu.push_back(whole.mu[point]);
    problem.normal_law = whole.normal_law.at(points);
    problem.friction_law = whole.friction_law.at(points);
    problem.normal_force = drive.normal_force;
    to_force_of_all.reinit(pair.n_points());
    to_force_of_all = 1;
    if (whole.to_force.size() > 0)
      std::copy_n(whole.to_force.begin(), pair.n_points(), to_force_of_all.begin());
    if (whole.to_force.size() > 0)
      problem.by_approach = problem.to_force = on_points(whole.to_force, points);
  }

  std::vector<double> CycleBalance::unknowns(const std::vector<DenseVector> &forces,
                                             const std::vector<double> &approaches, const double period) const
  {
    const DenseMatrix to_harmonics = fourier_weights(fourier_values(n_functions, forces.size()));
    std::vector<double> x(n_unknowns(), 0.);
    // orders that so few samples cannot tell from lower ones begin at zero
    for (unsigned int k = 0; k < n_functions && (k + 1) / 2 * 2 < forces.size(); ++k)
      for (unsigned int t = 0; t < forces.size(); ++t)
      {
        for (unsigned int i = 0; i < 3 * n; ++i)
          x[k * 3 * n + i] += to_harmonics(t, k) * forces[t][i];
        if (force_given)
          x[3 * n * n_functions + k] += to_harmonics(t, k) * (approaches[t] - at_rest.contact.approach);
      }
    x.back() = 2 * dealii::numbers::PI / period;
    return x;
  }

  std::vector<double> CycleBalance::extended(const std::vector<double> &x, const CycleBalance &fewer) const
  {
    std::vector<double> result(n_unknowns(), 0.);
    const unsigned int n_forces = 3 * n * fewer.n_functions;
    std::copy_n(x.begin(), n_forces, result.begin());
    if (force_given)
      std::copy_n(x.begin() + n_forces, fewer.n_functions, result.begin() + 3 * n * n_functions);
    result.back() = x.back();
    return result;
  }

  DenseMatrix CycleBalance::forces_of(const DenseVector &x) const
  {
    DenseMatrix forces(3 * n, n_functions);
    std::copy_n(x.begin(), 3 * n * n_functions, &forces(0, 0));
    return forces;
  }

  DenseMatrix CycleBalance::response_to(const DenseVector &x, const DenseMatrix &forces) const
  {
    DenseMatrix y = response.response(forces);
    for (unsigned int k = 0; k < n_functions && force_given; ++k)
      for (unsigned int i = 0; i < n; ++i)
      {
        const std::array<double, 3> a = problem.approach_of(i);
        for (unsigned int c = 0; c < 3; ++c)
          y(contact_row(n, c, i), k) -= a[c] * x[3 * n * n_functions + k];
      }
    return y;
  }

  DenseMatrix CycleBalance::seen_slips(const DenseMatrix &y, const DenseMatrix &forces) const
  {
    DenseMatrix seen;
    if (sees_speed())
    {
      seen = y;
      seen.add(-1., response.rate_of_rest(forces));
    }
    return seen;
  }

  DenseVector CycleBalance::resultants(const DenseMatrix &forces) const
  {
    DenseVector sums(force_given ? n_functions : 0);
    for (unsigned int k = 0; k < sums.size(); ++k)
      for (unsigned int i = 0; i < n; ++i)
      {
        const std::array<double, 3> l = problem.share_of(i);
        for (unsigned int c = 0; c < 3; ++c)
          sums[k] += l[c] * forces(contact_row(n, c, i), k);
      }
    return sums;
  }

  DenseMatrix CycleBalance::sampled(const DenseMatrix &columns) const
  {
    if (columns.m() == 0)
      return columns;
    DenseMatrix result(columns.m(), values.m());
    columns.mTmult(result, values);
    return result;
  }

  DenseMatrix CycleBalance::harmonics(const DenseMatrix &of_samples) const
  {
    return product(of_samples, weights);
  }

  double CycleBalance::evaluate(const std::vector<double> &given)
  {
    try
    {
      return size_of_defect(given);
    }
    catch (const ConvergenceError &error)
    {
      failure = error.what();
      return not_evaluated;
    }
  }

  double CycleBalance::size_of_defect(const std::vector<double> &given)
  {
    const DenseVector x(given.begin(), given.end());
    omega = given.back();
    if (!(omega > 0))
    {
      failure = "the frequency is no longer positive";
      return not_evaluated;
    }
    response.set_frequency(omega);
    if (!problem.A)
    {
      // once: the projections stay the same while the frequency is sought
      const std::vector<double> own = response.own_compliance();
      DenseMatrix diagonal(3 * n);
      for (unsigned int i = 0; i < 3 * n; ++i)
        diagonal(i, i) = own[i];
      problem.A = std::make_shared<DenseContactOperator>(diagonal);
    }
    change = forces_of(x);
    for (unsigned int i = 0; i < 3 * n; ++i)
      change(i, 0) -= rest_forces[i];
    DenseMatrix y = response_to(x, change);
    for (unsigned int i = 0; i < 3 * n; ++i)
      y(i, 0) += rest_response[i];
    DenseMatrix forces = sampled(forces_of(x));
    const DenseMatrix seen = sampled(seen_slips(y, change));
    y = sampled(y);

    failure.clear();
    const ContactResidual residual(problem);
    DenseVector R(3 * n), of_sample(3 * n), projected;
    std::vector<ContactStatus> status;
    for (unsigned int t = 0; t < samples.size(); ++t)
    {
      std::copy_n(&forces(0, t), 3 * n, R.begin());
      std::copy_n(&y(0, t), 3 * n, of_sample.begin());
      if (sees_speed())
        set_friction(&seen(0, t));
      residual.evaluate(R, of_sample, projected, status);
      samples[t].jacobian.linearise(problem, residual, R, of_sample);
      samples[t].by_speed.clear();
      const std::vector<unsigned int> &active = samples[t].jacobian.points();
      for (unsigned int k = 0; k < active.size() && sees_speed(); ++k)
      {
        const unsigned int i = active[k];
        const Vector2 slip = {{seen(contact_row(n, 1, i), t), seen(contact_row(n, 2, i), t)}};
        samples[t].by_speed.push_back(speed_dependence(samples[t].jacobian.rows_of_points()[k], problem.mu[i],
                                                       projected[i], problem.friction_law[i], slip));
      }
      for (unsigned int i = 0; i < 3 * n; ++i)
        forces(i, t) -= projected[i];
    }
    left_over = harmonics(forces);
    left_of_resultant = resultants(change);
    const double size = std::sqrt((squares(left_over) + left_of_resultant.norm_sqr()) / squares(change));
    return std::isfinite(size) ? size : not_evaluated;
  }

  void CycleBalance::set_friction(const double *const seen_slip)
  {
    for (unsigned int i = 0; i < n; ++i)
      problem.mu[i] =
          problem.friction_law[i]
              .coefficient(std::hypot(seen_slip[contact_row(n, 1, i)], seen_slip[contact_row(n, 2, i)]))
              .value;
  }

  bool CycleBalance::keep(const std::vector<double> &, const double size)
  {
    return size <= tolerance;
  }

  DenseMatrix CycleBalance::linearised(DenseMatrix forces, const DenseMatrix &y,
                                       const DenseMatrix &seen) const
  {
    for (unsigned int t = 0; t < samples.size(); ++t)
    {
      const NewtonJacobian &jacobian = samples[t].jacobian;
      for (unsigned int k = 0; k < jacobian.points().size(); ++k)
      {
        const unsigned int i = jacobian.points()[k], x_row = contact_row(n, 1, i),
                           y_row = contact_row(n, 2, i);
        auto left = jacobian.apply(k, forces(i, t), forces(x_row, t), forces(y_row, t), y(i, t), y(x_row, t),
                                   y(y_row, t));
        if (!samples[t].by_speed.empty())
        {
          const SpeedDependence &own = samples[t].by_speed[k];
          const double speed = own.direction[0] * seen(x_row, t) + own.direction[1] * seen(y_row, t);
          for (unsigned int d = 0; d < 2; ++d)
            left[d + 1] -= own.force[d] * speed;
        }
        for (unsigned int c = 0; c < 3; ++c)
          forces(contact_row(n, c, i), t) = left[c];
      }
    }
    return harmonics(forces);
  }

  std::vector<MeanLaw> CycleBalance::mean_law() const
  {
    std::vector<MeanLaw> mean(n);
    std::vector<unsigned int> n_active(n, 0);
    const double share = 1. / samples.size();
    for (const Sample &sample : samples)
      for (unsigned int k = 0; k < sample.jacobian.points().size(); ++k)
      {
        const unsigned int i = sample.jacobian.points()[k];
        ++n_active[i];
        const NewtonJacobian::Blocks blocks = NewtonJacobian::blocks_of(sample.jacobian.rows_of_points()[k]);
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int row = 0; row < 3; ++row)
          {
            mean[i].by_force[row][c] += share * blocks.by_force[row][c];
            mean[i].by_response[row][c] += share * blocks.by_response[row][c];
            if (row > 0 && c > 0 && !sample.by_speed.empty())
              mean[i].by_seen_slip[row][c] -=
                  share * sample.by_speed[k].force[row - 1] * sample.by_speed[k].direction[c - 1];
          }
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        mean[i].by_force[c][c] += 1 - share * n_active[i];
    return mean;
  }

  void CycleBalance::vmult(DenseVector &to, const DenseVector &from) const
  {
    ++n_products;
    if (progress)
      progress->advance(0, [this] { return std::to_string(n_products) + " products"; });
    const DenseMatrix forces = forces_of(from), y = response_to(from, forces),
                      left = linearised(sampled(forces), sampled(y), sampled(seen_slips(y, forces)));
    to.reinit(from.size());
    std::copy_n(&left(0, 0), 3 * n * n_functions, to.begin());
    to.add(from[from.size() - 1], by_frequency);
    const DenseVector sums = resultants(forces);
    std::copy(sums.begin(), sums.end(), to.begin() + 3 * n * n_functions);
    to[to.size() - 1] = along * from;
  }

  DenseVector CycleBalance::defect() const
  {
    DenseVector result(n_unknowns());
    std::copy_n(&left_over(0, 0), 3 * n * n_functions, result.begin());
    std::copy(left_of_resultant.begin(), left_of_resultant.end(), result.begin() + 3 * n * n_functions);
    return result;
  }

  double CycleBalance::linearise()
  {
    // what longer or shorter periods change
    DenseMatrix y = response.response_slope(change), seen;
    if (sees_speed())
    {
      DenseMatrix slips = y;
      slips.add(-1., response.rate_of_rest_slope(change));
      seen = sampled(slips);
    }
    const DenseMatrix slope = linearised(DenseMatrix(3 * n, samples.size()), sampled(y), seen);
    DenseMatrix rate = change;
    response.differentiate(rate);
    by_frequency.reinit(n_unknowns());
    along.reinit(n_unknowns());
    std::copy_n(&slope(0, 0), 3 * n * n_functions, by_frequency.begin());
    std::copy_n(&rate(0, 0), 3 * n * n_functions, along.begin());
    along /= along.l2_norm();
    const double unit = 1 / by_frequency.l2_norm();
    by_frequency *= unit;
    return unit;
  }

  bool CycleBalance::find_step(bool, std::vector<double> &step)
  {
    // of the last place nothing is known
    if (!failure.empty())
      return false;
    const double unit = linearise();
    if (!std::isfinite(unit))
    {
      failure = "the contact does not feel how long a period is";
      return false;
    }
    DenseVector right = defect(), x(n_unknowns());
    right *= -1;
    dealii::SolverControl control(most_balance_products, linear_balance_tolerance * right.l2_norm());
    const dealii::SolverGMRES<DenseVector>::AdditionalData data(most_balance_products + 2, true);
    dealii::SolverGMRES<DenseVector> gmres(control, data);
    try
    {
      gmres.solve(*this, x, right,
                  BalancePreconditioner(response, mean_law(), problem, sees_speed(), by_frequency, along));
    }
    catch (const dealii::LACExceptions::ExcSingular &)
    {
      failure = "the projections in the mean of a period are singular";
      return false;
    }
    catch (const dealii::SolverControl::NoConvergence &)
    {
      // the line search judges what was found
      failure = "GMRES gave up after " + std::to_string(most_balance_products) + " products";
    }
    if (!std::all_of(x.begin(), x.end(), [](const double value) { return std::isfinite(value); }))
    {
      failure = "the linear system has no finite solution";
      return false;
    }
    step.assign(x.begin(), x.end());
    step.back() *= unit;
    return true;
  }

  void CycleBalance::set_gaps_elsewhere(DynamicState &state) const
  {
    DynamicState rest = at_rest;
    set_residual_displacement(pair, rest);
    for (unsigned int i = 0; i < pair.n_points(); ++i)
    {
      if (std::binary_search(points.begin(), points.end(), i))
        continue;
      double &gap = state.contact.y[i];
      gap += state.residual_displacement[i] - rest.residual_displacement[i] -
             to_force_of_all[i] * (state.contact.approach - at_rest.contact.approach);
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        gap += pair.trace(i, k) * (state.q[k] - at_rest.q[k]);
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
        gap += 2 * (pair.right(i, k) * (state.z[k] - at_rest.z[k])).real();
    }
  }

  std::vector<DynamicState> CycleBalance::motion(const std::vector<double> &given, const unsigned int n_steps)
  {
    evaluate(given);
    const unsigned int n_times = std::max(n_steps, samples_per_function * n_functions);
    const DenseVector x(given.begin(), given.end());
    const DenseMatrix at_times = fourier_values(n_functions, n_times);
    const auto over_time = [&](const DenseMatrix &columns)
    {
      DenseMatrix result(columns.m(), n_times);
      if (columns.m() > 0)
        columns.mTmult(result, at_times);
      return result;
    };
    DenseMatrix amplitudes = response.modal_amplitudes(change), y = response_to(x, change);
    for (unsigned int i = 0; i < 3 * n; ++i)
      y(i, 0) += rest_response[i];
    DenseMatrix approach(1, n_functions);
    const DenseMatrix q = over_time(amplitudes), R = over_time(change), response_now = over_time(y),
                      seen = sees_speed() ? over_time(seen_slips(y, change)) : DenseMatrix();
    for (unsigned int k = 0; k < n_functions && force_given; ++k)
      approach(0, k) = x[3 * n * n_functions + k];
    approach = over_time(approach);
    response.differentiate(amplitudes);
    const DenseMatrix v = over_time(amplitudes), z = over_time(response.pole_states(change));

    const ContactResidual residual(problem);
    const unsigned int n_all = pair.n_points();
    DenseVector forces(3 * n), gap_and_slip(3 * n), projected;
    std::vector<ContactStatus> status;
    std::vector<DynamicState> states;
    for (unsigned int t = 0; t < n_times; ++t)
    {
      DynamicState state = at_rest;
      state.time = (t + 1) * period(given) / n_times;
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
      {
        state.q[k] = at_rest.q[k] + q(k, t);
        state.v[k] = v(k, t);
      }
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
        state.z[k] = at_rest.z[k] + std::complex<double>(z(k, t), z(pair.n_poles() + k, t));
      for (unsigned int i = 0; i < 3 * n; ++i)
      {
        forces[i] = rest_forces[i] + R(i, t);
        gap_and_slip[i] = response_now(i, t);
      }
      if (sees_speed())
        set_friction(&seen(0, t));
      residual.evaluate(forces, gap_and_slip, projected, status);
      state.contact.approach += approach(0, t);
      for (unsigned int i = 0; i < n; ++i)
      {
        state.contact.status[points[i]] = status[i];
        for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int here = contact_row(n, c, i), there = contact_row(n_all, c, points[i]);
          state.R[there] = forces[here];
          state.contact.y[there] = gap_and_slip[here];
        }
      }
      state.contact.R = state.R;
      complete(pair, rigid, state);
      set_gaps_elsewhere(state);
      states.push_back(state);
    }
    return states;
  }
} // namespace vibrocontact

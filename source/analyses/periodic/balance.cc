#include <vibrocontact/analyses/periodic/balance.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
    using Quantity = TimeSampling::Quantity;
  } // namespace

  PeriodicBalance::PeriodicBalance(const ForcedBody &body, const PointLaws<NormalLaw> &law,
                                   const BalanceSettings &settings)
      : settings(settings), body(body), law(law),
        spring(!law.any([](const NormalLaw &one) { return !one.is_function_of_gap(); })),
        trial_basis(create_time_basis(settings.trial, settings.n_functions, *settings.bases)),
        weighting_basis(create_time_basis(settings.weighting, settings.n_functions, *settings.bases)),
        pairing(pair_time_bases(*trial_basis, *weighting_basis, settings.form, settings.quadrature_points)),
        samples(std::make_unique<TimeSampling>(*trial_basis, *weighting_basis, pairing, settings.n_samples))
  {
    for (unsigned int m = 0; m < pairing.a0.size(); ++m)
      if (std::abs(pairing.a0[m]) < 1e-10)
      {
        const bool residual_singular = body.residual(0, 0) > 0 && body.relaxation == 0;
        const auto is_undamped = [](const double zeta) { return zeta <= 0; };
        if (residual_singular ||
            std::any_of(body.damping_ratio.begin(), body.damping_ratio.end(), is_undamped))
          throw ConvergenceError("The last order of " + std::to_string(settings.n_functions) + " functions " +
                                 settings.trial + ":" + settings.weighting +
                                 " has neither stiffness nor damping: take an odd number of functions.");
      }
    if (settings.friction > 0 && body.rows_per_point != 3)
      throw InputError("Friction needs the tangential motion of the contact points; this body has none: set "
                       "Contact/Friction coefficient = 0.");
    if (settings.friction > 0 && trial_basis->n_derivatives() == 0)
      throw InputError("Friction needs the velocity of the trial functions; those of " + trial_basis->name() +
                       " have none: choose another Periodic/Trial basis.");
    const std::size_t size = std::size_t(body.n_contact_rows()) * samples->n_samples();
    u_samples.resize(size);
    v_samples.resize(size);
    c_samples.resize(size);
    law_samples.resize(size);
    const std::size_t blocks = body.rows_per_point * body.rows_per_point * samples->n_samples();
    by_u.resize(body.n_points() * blocks);
    by_v.resize(by_u.size());
    by_c.resize(by_u.size());
    status.resize(body.n_points() * samples->n_samples());
    bool is_massless =
        settings.friction > 0 && !law.any(&NormalLaw::is_function_of_gap) && body.relaxation == 0;
    for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
      is_massless = is_massless && body.residual(i, i) > 0;
    if (!is_massless)
      return;
    std::vector<double> mu;
    for (unsigned int p = 0; p < body.n_points(); ++p)
      mu.push_back(friction_of(p));
    massless = std::make_unique<MasslessContact>(body.contact_residual(), mu);
    trial_values = sampled(*trial_basis, samples->phases(), 0);
    // moments take Psi_m once, the real functions of the layout have it twice but for the first and a lone last one
    moment_weights = sampled(*weighting_basis, samples->phases(), 0);
    const unsigned int N = settings.n_functions;
    for (unsigned int k = 0; k < N; ++k)
      for (unsigned int i = 0; i < samples->n_samples(); ++i)
        moment_weights(i, k) *= (k == 0 || (N % 2 == 0 && k + 1 == N) ? 1. : 0.5) / samples->n_samples();
    modal_samples.resize(size);
  }

  void PeriodicBalance::set_condensation(std::function<CondensedBody(const HarmonicForce &)> given)
  {
    receptances = std::move(given);
    set_force(force);
  }

  CondensedBody PeriodicBalance::condensed_at(const HarmonicForce &at) const
  {
    return receptances ? receptances(at) : condense(body, pairing, at);
  }

  void PeriodicBalance::set(const SceneParameter parameter, const double value)
  {
    HarmonicForce changed = force;
    if (parameter == SceneParameter::gap)
    {
      const double first = body.gap[0];
      for (double &gap : body.gap)
        gap = value + (gap - first);
    }
    else if (parameter == SceneParameter::force)
      changed.amplitude = value;
    else
      changed.frequency = value;
    if (parameter != SceneParameter::gap)
      set_force(changed);
  }

  void PeriodicBalance::set_force(const HarmonicForce &new_force)
  {
    force = new_force;
    linear = condensed_at(force);
    double normal = 0, tangential = 0;
    const unsigned int n = body.n_contact_rows();
    for (unsigned int i = 0; i < n; ++i)
      if (is_normal(i))
        normal = std::max(normal, largest_compliance(linear, i));
    is_inert.assign(n, 0);
    for (unsigned int i = 0; i < n; ++i)
      if (!is_normal(i))
      {
        is_inert[i] = largest_compliance(linear, i) <= 1e-14 * normal;
        for (unsigned int m = 0; m < pairing.a0.size(); ++m)
          tangential = std::max(tangential, 2 * M_PI * m * force.frequency *
                                                std::abs(linear.compliance[(m * n + i) * n + i]));
      }
    // kept while they are of the right size: solutions depend on them within the error of the functions
    const auto renew = [&](double &rho, const double wanted)
    {
      if (!(rho > wanted / 4 && rho < wanted * 4))
        rho = wanted;
    };
    if (fixed_rho > 0)
      normal_rho = fixed_rho;
    else
      renew(normal_rho, settings.projection / normal);
    if (tangential > 0)
      renew(tangential_rho, settings.projection / tangential);
  }

  /// u_m = linear_m + H_m p_m, p = sign c, order by order (analyses/periodic/condensation.h)
  void PeriodicBalance::displacement_from(const std::vector<double> &c,
                                          const std::vector<Complex> &linear_part,
                                          const std::vector<Complex> &compliance,
                                          std::vector<double> &u) const
  {
    const unsigned int n = body.n_contact_rows(), N = settings.n_functions;
    u.resize(n * N);
    for (unsigned int m = 0; 2 * m <= N; ++m)
    {
      const bool is_real = m == 0 || 2 * m == N;
      const unsigned int at = m == 0 ? 0 : 2 * m - 1;
      for (unsigned int i = 0; i < n; ++i)
      {
        Complex sum = linear_part[m * n + i];
        for (unsigned int j = 0; j < n; ++j)
          sum += compliance[(m * n + i) * n + j] * sign(j) *
                 Complex(c[j * N + at], is_real ? 0. : c[j * N + at + 1]);
        u[i * N + at] = sum.real();
        if (!is_real)
          u[i * N + at + 1] = sum.imag();
      }
    }
  }

  std::vector<double> PeriodicBalance::displacement(const std::vector<double> &c) const
  {
    std::vector<double> u;
    displacement_from(c, linear.linear, linear.compliance, u);
    return u;
  }

  std::vector<double> PeriodicBalance::body_forces(const std::vector<double> &c) const
  {
    std::vector<double> p = c;
    for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
      for (unsigned int k = 0; k < settings.n_functions; ++k)
        p[i * settings.n_functions + k] *= sign(i);
    return p;
  }

  double PeriodicBalance::force_scale(const std::vector<double> &c) const
  {
    return std::max({force.amplitude, euclidean_norm(c), std::numeric_limits<double>::min()});
  }

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

  void PeriodicBalance::residual_of(const std::vector<double> &c, std::vector<double> &residual) const
  {
    const unsigned int N = settings.n_functions, count = samples->n_samples();
    residual.assign(c.size(), 0.);
    for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
      if (is_normal(i) || settings.friction > 0)
        samples->moments(&law_samples[i * count], &residual[i * N]);
    for (unsigned int k = 0; k < c.size(); ++k)
      residual[k] = c[k] - residual[k];
  }

  /// dR/dc = 1 - P dlaw/dc L - P (dlaw/du Q + f dlaw/dv Q') H sign at the last c of apply_law(); `by_displacement` is the
  /// bracket with its P, by the coefficients of u (of w for massless points, whose H lacks S / A_0).
  void PeriodicBalance::assemble(DenseMatrix &jacobian)
  {
    assemble_law(jacobian, by_displacement);
    add_answer(by_displacement, linear.compliance, jacobian);
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

  /// Forces of a point without history depend on its own motion alone. H_m is diagonal in the orders: it mixes the two columns
  /// Re, Im of order m as a complex number does.
  void PeriodicBalance::add_answer(const DenseMatrix &by_motion,
                                   const std::vector<std::complex<double>> &compliance,
                                   DenseMatrix &jacobian) const
  {
    const unsigned int N = settings.n_functions, n = body.n_contact_rows(), rows = body.rows_per_point;
    const auto axpy = [&](const double factor, const unsigned int from, const unsigned int to)
    {
      if (factor == 0)
        return;
      const unsigned int size = massless ? n * N : rows * N, begin = massless ? 0 : from / size * size;
      const double *const x = &by_motion(begin, from);
      double *const y = &jacobian(begin, to);
      for (unsigned int r = 0; r < size; ++r)
        y[r] += factor * x[r];
    };
    for (unsigned int m = 0; 2 * m <= N; ++m)
    {
      const bool is_real = m == 0 || 2 * m == N;
      const unsigned int at = m == 0 ? 0 : 2 * m - 1;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          Complex h = compliance[(m * n + i) * n + j];
          if (massless)
            h -= body.residual(i, j) / pairing.a0[m];
          h *= -sign(j);
          axpy(h.real(), i * N + at, j * N + at);
          if (is_real)
            continue;
          axpy(h.imag(), i * N + at + 1, j * N + at);
          axpy(-h.imag(), i * N + at, j * N + at + 1);
          axpy(h.real(), i * N + at + 1, j * N + at + 1);
        }
    }
    for (unsigned int k = 0; k < n * N; ++k)
      jacobian(k, k) += 1;
  }

  std::vector<double> PeriodicBalance::motion_slope(const std::vector<double> &c,
                                                    const SceneParameter parameter) const
  {
    std::vector<double> slope;
    if (parameter == SceneParameter::frequency)
      displacement_from(c, linear.linear_slope, linear.compliance_slope, slope);
    else if (parameter == SceneParameter::force)
    {
      const std::vector<double> none(c.size(), 0.);
      std::vector<double> at_rest;
      const CondensedBody unit = condensed_at({1., force.frequency, force.phase}),
                          rest = condensed_at({0., force.frequency, force.phase});
      displacement_from(none, unit.linear, unit.compliance, slope);
      displacement_from(none, rest.linear, rest.compliance, at_rest);
      for (unsigned int k = 0; k < slope.size(); ++k)
        slope[k] -= at_rest[k];
    }
    else
    {
      // a wider gap is a motion away from the stop; the first function is the constant one
      slope.assign(c.size(), 0.);
      for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
        if (is_normal(i))
          slope[i * settings.n_functions] = -1;
    }
    return slope;
  }

  /// dR/dp = -P (dlaw/du Q + f dlaw/dv Q') du/dp, in frequency also -P dlaw/dv Q' u; `slope`: du/dp at fixed c.
  void PeriodicBalance::slope_of(const std::vector<double> &slope, const bool in_frequency,
                                 std::vector<double> &by_parameter)
  {
    const unsigned int N = settings.n_functions, count = samples->n_samples(), rows = body.rows_per_point;
    std::vector<double> row_u(count), law_slope(count);
    by_parameter.assign(slope.size(), 0.);
    if (massless)
    {
      // as assembled
      for (unsigned int j = 0; j < slope.size(); ++j)
        for (unsigned int i = 0; i < slope.size(); ++i)
          by_parameter[i] -= by_displacement(i, j) * slope[j];
      return;
    }
    for (unsigned int p = 0; p < body.n_points(); ++p)
      for (unsigned int a = 0; a < rows; ++a)
      {
        if (a > 0 && !(settings.friction > 0))
          continue;
        std::fill(law_slope.begin(), law_slope.end(), 0.);
        for (unsigned int b = 0; b < (a == 0 ? 1 : rows); ++b)
        {
          const unsigned int j = p * rows + b;
          const std::size_t at = std::size_t((p * rows + a) * rows + b) * count;
          samples->samples(b == 0 ? Quantity::displacement : Quantity::velocity, &slope[j * N], row_u.data());
          for (unsigned int k = 0; k < count; ++k)
          {
            if (b == 0)
              law_slope[k] += by_u[at + k] * row_u[k];
            else
              law_slope[k] += by_v[at + k] *
                              (force.frequency * row_u[k] + (in_frequency ? v_samples[j * count + k] : 0.));
          }
        }
        samples->moments(law_slope.data(), &by_parameter[(p * rows + a) * N]);
      }
    for (double &value : by_parameter)
      value = -value;
  }

  void PeriodicBalance::evaluate(const std::vector<double> &c, std::vector<double> &residual,
                                 DenseMatrix *jacobian, std::vector<double> *by_parameter,
                                 const SceneParameter parameter)
  {
    apply_law(c);
    residual_of(c, residual);
    DenseMatrix unwanted;
    if (jacobian || (by_parameter && massless))
      assemble(jacobian ? *jacobian : unwanted);
    if (by_parameter)
      slope_of(motion_slope(c, parameter), parameter == SceneParameter::frequency, *by_parameter);
  }

  std::size_t PeriodicBalance::active_pattern() const
  {
    // samples that are not open, mixed as FNV-1a does
    std::size_t hash = 0;
    for (std::size_t k = 0; k < status.size(); ++k)
      if (status[k] != ContactStatus::open)
        hash = (hash ^ (3 * k + std::size_t(status[k]))) * 1099511628211ull;
    return hash;
  }

  unsigned int PeriodicBalance::n_active() const
  {
    return std::count_if(status.begin(), status.end(),
                         [](const ContactStatus s) { return s != ContactStatus::open; });
  }
} // namespace vibrocontact

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
      : settings(settings), body(body), law(law), spring(law.all(&NormalLaw::is_function_of_gap)),
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

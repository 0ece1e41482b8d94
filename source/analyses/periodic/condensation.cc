#include <vibrocontact/analyses/periodic/condensation.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// d_n(m) and its derivative with respect to the frequency
    struct DynamicStiffness
    {
      DynamicStiffness(const double omega, const double damping_ratio, const TimePairing &a,
                       const unsigned int m, const double f, const double growth = 0)
          : value(f * f * a.a2[m] + 2 * damping_ratio * omega * f * a.a1[m] + omega * omega * a.a0[m] +
                  growth * (2 * f * a.a1[m] + (growth + 2 * damping_ratio * omega) * a.a0[m])),
            slope(2 * f * a.a2[m] + 2 * damping_ratio * omega * a.a1[m] + 2 * growth * a.a1[m])
      {
      }
      Complex value, slope;
    };

    /// moments of the exciting force and of the constant loads' unit
    Complex exciting_moment(const TimePairing &pairing, const unsigned int m, const HarmonicForce &force)
    {
      return force.amplitude *
             (std::cos(force.phase) * pairing.sine[m] + std::sin(force.phase) * pairing.cosine[m]);
    }
    Complex constant_moment(const TimePairing &pairing, const unsigned int m)
    {
      return m == 0 ? pairing.a0[0] : 0.;
    }
  } // namespace

  double largest_compliance(const CondensedBody &body, const unsigned int row)
  {
    const unsigned int n = body.n_rows;
    double largest = 0;
    for (std::size_t at = row * n + row; at < body.compliance.size(); at += n * n)
      largest = std::max(largest, std::abs(body.compliance[at]));
    return largest;
  }

  double log_of_poles(const ForcedBody &body, const TimePairing &pairing, const double frequency,
                      const double growth)
  {
    double result = 0;
    for (unsigned int m = 0; m < pairing.a0.size(); ++m)
      for (unsigned int k = 0; k < body.n_modes(); ++k)
      {
        const DynamicStiffness d(body.omega[k], body.damping_ratio[k], pairing, m, frequency, growth);
        result += (m == 0 || 2 * m == pairing.n_functions ? 1 : 2) * std::log(std::abs(d.value));
      }
    return result;
  }

  CondensedBody condense(const ForcedBody &body, const TimePairing &pairing, const HarmonicForce &force,
                         const double growth)
  {
    const unsigned int n = body.n_contact_rows(), force_row = body.force_row, orders = pairing.a0.size();
    const double f = force.frequency;
    CondensedBody result;
    result.n_rows = n;
    result.n_functions = pairing.n_functions;
    result.compliance.assign(orders * n * n, 0.);
    result.compliance_slope = result.compliance;
    result.linear.assign(orders * n, 0.);
    result.linear_slope = result.linear;
    for (unsigned int m = 0; m < orders; ++m)
    {
      Complex *const compliance = &result.compliance[m * n * n];
      Complex *const compliance_slope = &result.compliance_slope[m * n * n];
      Complex *const linear = &result.linear[m * n];
      Complex *const linear_slope = &result.linear_slope[m * n];
      const Complex exciting = exciting_moment(pairing, m, force), constant = constant_moment(pairing, m);
      for (unsigned int k = 0; k < body.n_modes(); ++k)
      {
        const DynamicStiffness d(body.omega[k], body.damping_ratio[k], pairing, m, f, growth);
        const Complex inverse = 1. / d.value, slope = -d.slope * inverse * inverse;
        const Complex load = body.modal_force(k) * exciting + body.modal_load[k] * constant;
        for (unsigned int i = 0; i < n; ++i)
        {
          linear[i] += body.trace(i, k) * inverse * load;
          linear_slope[i] += body.trace(i, k) * slope * load;
          for (unsigned int j = 0; j < n; ++j)
          {
            const double product = body.trace(i, k) * body.trace(j, k);
            compliance[i * n + j] += product * inverse;
            compliance_slope[i * n + j] += product * slope;
          }
        }
      }
      for (unsigned int k = 0; k < 2 * body.n_poles(); ++k)
      {
        // of each pole, then of its conjugate
        const unsigned int p = k / 2;
        const auto own = [k](const Complex &value) { return k % 2 == 0 ? value : std::conj(value); };
        const Complex inverse = 1. / (f * pairing.a1[m] + (growth - own(body.poles[p])) * pairing.a0[m]),
                      slope = -pairing.a1[m] * inverse * inverse,
                      load = own(body.left(force_row, p)) * exciting +
                             (body.pole_load.empty() ? 0. : own(body.pole_load[p]) * constant);
        for (unsigned int i = 0; i < n; ++i)
        {
          const Complex shape = own(body.right(i, p));
          linear[i] += shape * inverse * load;
          linear_slope[i] += shape * slope * load;
          for (unsigned int j = 0; j < n; ++j)
          {
            compliance[i * n + j] += shape * own(body.left(j, p)) * inverse;
            compliance_slope[i * n + j] += shape * own(body.left(j, p)) * slope;
          }
        }
      }
      const Complex relaxed = 1. / (pairing.a0[m] + f * body.relaxation * pairing.a1[m] +
                                    growth * body.relaxation * pairing.a0[m]);
      const Complex relaxed_slope = -body.relaxation * pairing.a1[m] * relaxed * relaxed;
      for (unsigned int i = 0; i < n; ++i)
      {
        const Complex load = body.residual_force(i) * exciting + body.residual_load[i] * constant;
        linear[i] += relaxed * load;
        linear_slope[i] += relaxed_slope * load;
        for (unsigned int j = 0; j < n; ++j)
        {
          compliance[i * n + j] += relaxed * body.residual(i, j);
          compliance_slope[i * n + j] += relaxed_slope * body.residual(i, j);
        }
      }
    }
    return result;
  }

  DenseMatrix modal_coefficients(const ForcedBody &body, const TimePairing &pairing,
                                 const HarmonicForce &force, const std::vector<double> &p)
  {
    const unsigned int n = pairing.n_functions, orders = pairing.a0.size();
    DenseMatrix result(n, body.n_modes());
    for (unsigned int m = 0; m < orders; ++m)
    {
      const bool is_real = m == 0 || 2 * m == n;
      const unsigned int at = m == 0 ? 0 : 2 * m - 1;
      const Complex exciting = exciting_moment(pairing, m, force), constant = constant_moment(pairing, m);
      for (unsigned int k = 0; k < body.n_modes(); ++k)
      {
        Complex load = body.modal_force(k) * exciting + body.modal_load[k] * constant;
        for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
          load += body.trace(i, k) * Complex(p[i * n + at], is_real ? 0. : p[i * n + at + 1]);
        const Complex q =
            load / DynamicStiffness(body.omega[k], body.damping_ratio[k], pairing, m, force.frequency).value;
        result(at, k) = q.real();
        if (!is_real)
          result(at + 1, k) = q.imag();
      }
    }
    return result;
  }
} // namespace vibrocontact

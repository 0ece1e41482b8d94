#include <vibrocontact/analyses/periodic/force_step.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <complex>
#include <map>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
    /// inner integrals by so many Gauss points are exact to rounding for exponents up to `slow`, for `very_slow` by the fewer
    /// ones, times polynomials of degree 11
    constexpr unsigned int n_inner = 24, n_fewer = 14;
    constexpr double slow = 20, very_slow = 2;

    struct InnerRule
    {
      InnerRule(const GaussRule &inner, const GaussRule &rule, const double t, const double x) : inner(inner)
      {
        for (unsigned int m = 0; m < inner.s; ++m)
          for (const double value : rule.lagrange(x * inner.node[m]))
            values.push_back(value * inner.weight[m] * t);
      }
      const GaussRule &inner;
      /// Lagrange polynomials at the points times weights
      std::vector<double> values;
    };

    /// int_0^t e^(lambda (t - tau)) p(tau / h) dtau by parts, derivatives of p at 0 and x = t / h
    template <typename Number>
    void by_parts(const Number lambda, const double t, const double h, const unsigned int s,
                  const std::vector<double> &at_0, const std::vector<double> &at_x,
                  std::vector<Number> &integral)
    {
      integral.assign(s, Number(0));
      const Number decay = std::exp(lambda * t);
      Number factor = 1. / lambda;
      for (unsigned int k = 0; k < s; ++k, factor /= lambda * h)
        for (unsigned int j = 0; j < s; ++j)
          integral[j] += (decay * at_0[k * s + j] - at_x[k * s + j]) * factor;
    }
  } // namespace

  FreeMode free_mode(const double omega, const double zeta, const double t)
  {
    const double a = zeta * omega;
    FreeMode m;
    if (zeta < 1 || omega == 0)
    {
      const double wd = omega * std::sqrt(std::max(0., 1 - zeta) * (1 + zeta)), decay = std::exp(-a * t);
      const double c = decay * std::cos(wd * t);
      m.qv = wd > 0 ? decay * std::sin(wd * t) / wd : t;
      m.qq = c + a * m.qv;
      m.vv = c - a * m.qv;
    }
    else
    {
      const double delta = omega * std::sqrt((zeta - 1) * (zeta + 1)), s = -omega * omega / (a + delta);
      const double decay = std::exp(s * t);
      m.qv = delta > 0 ? decay * -std::expm1(-2 * delta * t) / (2 * delta) : t * decay;
      m.qq = decay - s * m.qv;
      m.vv = std::exp(-(a + delta) * t) + s * m.qv;
    }
    m.vq = -omega * omega * m.qv;
    return m;
  }

  GaussRule::GaussRule(const unsigned int s) : s(s)
  {
    const dealii::QGauss<1> rule(s);
    for (unsigned int i = 0; i < s; ++i)
    {
      node.push_back(rule.point(i)[0]);
      weight.push_back(rule.weight(i));
    }
  }

  std::vector<double> GaussRule::lagrange(const double x) const
  {
    std::vector<double> value(s, 1.);
    for (unsigned int j = 0; j < s; ++j)
      for (unsigned int i = 0; i < s; ++i)
        if (i != j)
          value[j] *= (x - node[i]) / (node[j] - node[i]);
    return value;
  }

  std::vector<double> GaussRule::derivatives(const double x) const
  {
    std::vector<double> d(s * s);
    for (unsigned int j = 0; j < s; ++j)
    {
      // Taylor coefficients at x of the product of (y - node) / (node_j - node)
      std::vector<double> c(s, 0.);
      c[0] = 1;
      unsigned int degree = 0;
      for (unsigned int i = 0; i < s; ++i)
        if (i != j)
        {
          const double factor = 1 / (node[j] - node[i]);
          ++degree;
          for (unsigned int k = degree + 1; k-- > 0;)
            c[k] = ((k > 0 ? c[k - 1] : 0.) + (x - node[i]) * c[k]) * factor;
        }
      double factorial = 1;
      for (unsigned int k = 0; k < s; ++k, factorial *= k)
        d[k * s + j] = c[k] * factorial;
    }
    return d;
  }

  ForceAnswer answer_to_force(const ForcedBody &body, const GaussRule &rule, const double h, const double x,
                              const double beta)
  {
    const unsigned int n = body.n_modes(), s = rule.s;
    const double t = x * h;
    ForceAnswer answer;
    answer.displacement.assign(n * s, 0.);
    answer.velocity.assign(n * s, 0.);
    static const GaussRule many_points(n_inner), fewer_points(n_fewer);
    const InnerRule many(many_points, rule, t, x), few(fewer_points, rule, t, x);
    const auto inner_rule = [&](const double exponent) -> const InnerRule &
    { return exponent > very_slow ? many : few; };
    std::vector<double> at_0, at_x;
    const auto need_derivatives = [&]()
    {
      if (at_0.empty())
      {
        at_0 = rule.derivatives(0);
        at_x = rule.derivatives(x);
      }
    };
    std::vector<Complex> complex_integral;
    std::vector<double> integral_s, integral_f;
    // int_0^t e^(lambda (t - tau)) l_j dtau for real lambda <= 0
    const auto real_integral = [&](const double lambda, std::vector<double> &integral)
    {
      if (-lambda * t > slow)
      {
        need_derivatives();
        return by_parts(lambda, t, h, s, at_0, at_x, integral);
      }
      integral.assign(s, 0.);
      const InnerRule &points = inner_rule(-lambda * t);
      for (unsigned int m = 0; m < points.inner.s; ++m)
      {
        const double kernel = std::exp(lambda * t * (1 - points.inner.node[m]));
        for (unsigned int j = 0; j < s; ++j)
          integral[j] += kernel * points.values[m * s + j];
      }
    };
    for (unsigned int k = 0; k < n; ++k)
    {
      const double w = body.omega[k], zeta = body.damping_ratio[k], a = zeta * w;
      answer.free.push_back(free_mode(w, zeta, t));
      double *const q = &answer.displacement[k * s], *const v = &answer.velocity[k * s];
      const double split = w * std::sqrt(std::abs((zeta - 1) * (zeta + 1)));
      const double fastest = zeta > 1 ? a + split : w;
      if (fastest * t <= slow)
      {
        const InnerRule &points = inner_rule(fastest * t);
        for (unsigned int m = 0; m < points.inner.s; ++m)
        {
          const FreeMode kernel = free_mode(w, zeta, t * (1 - points.inner.node[m]));
          for (unsigned int j = 0; j < s; ++j)
          {
            q[j] += kernel.qv * points.values[m * s + j];
            v[j] += kernel.vv * points.values[m * s + j];
          }
        }
      }
      else if (split * t < 1)
      {
        // close to critical damping the roots do not separate: several intervals of Gauss points
        const unsigned int n_panels = std::ceil(fastest * t / slow);
        for (unsigned int p = 0; p < n_panels; ++p)
          for (unsigned int m = 0; m < n_inner; ++m)
          {
            const double at = (p + many.inner.node[m]) / n_panels,
                         factor = many.inner.weight[m] * t / n_panels;
            const FreeMode kernel = free_mode(w, zeta, t * (1 - at));
            const std::vector<double> l = rule.lagrange(x * at);
            for (unsigned int j = 0; j < s; ++j)
            {
              q[j] += kernel.qv * l[j] * factor;
              v[j] += kernel.vv * l[j] * factor;
            }
          }
      }
      else if (zeta < 1)
      {
        need_derivatives();
        const Complex lambda(-a, split);
        by_parts(lambda, t, h, s, at_0, at_x, complex_integral);
        for (unsigned int j = 0; j < s; ++j)
        {
          q[j] = complex_integral[j].imag() / split;
          v[j] = (lambda * complex_integral[j]).imag() / split;
        }
      }
      else
      {
        const double slow_root = -w * w / (a + split), fast_root = -(a + split);
        real_integral(slow_root, integral_s);
        real_integral(fast_root, integral_f);
        for (unsigned int j = 0; j < s; ++j)
        {
          q[j] = (integral_s[j] - integral_f[j]) / (2 * split);
          v[j] = (slow_root * integral_s[j] - fast_root * integral_f[j]) / (2 * split);
        }
      }
    }
    if (beta > 0)
    {
      answer.relaxation = std::exp(-t / beta);
      real_integral(-1 / beta, answer.residual);
      for (double &value : answer.residual)
        value /= beta;
    }
    return answer;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/periodic/floquet.h>
#include <vibrocontact/analyses/periodic/force_step.h>
#include <vibrocontact/analyses/periodic/shooting.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/lu_factors.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// Modes of a state [q, q', ...] over a time, column by column of their variation.
    class Flight
    {
    public:
      explicit Flight(const ForcedBody &body) : body(body) {}

      void operator()(const double t, DenseMatrix &X)
      {
        const unsigned int n = body.n_modes();
        if (t != kept_t)
        {
          kept.resize(n);
          for (unsigned int i = 0; i < n; ++i)
            kept[i] = free_mode(body.omega[i], body.damping_ratio[i], t);
          kept_t = t;
        }
        for (unsigned int j = 0; j < X.n(); ++j)
        {
          double *const x = &X(0, j);
          for (unsigned int i = 0; i < n; ++i)
          {
            const double q = x[i], v = x[n + i];
            x[i] = kept[i].qq * q + kept[i].qv * v;
            x[n + i] = kept[i].vq * q + kept[i].vv * v;
          }
        }
      }

    private:
      const ForcedBody &body;
      double kept_t = -1;
      std::vector<FreeMode> kept;
    };

    /// Variation of the state [q, q', (r)] over a period, column by column of the monodromy matrix.
    class Variation
    {
    public:
      Variation(const ForcedBody &body, const double dt)
          : body(body), n(body.n_modes()), points(body.n_points()), rows(body.rows_per_point), dt(dt),
            beta(body.relaxation), flight(body)
      {
        double largest = 0;
        for (unsigned int p = 0; p < points; ++p)
          largest = std::max(largest, body.residual(p * rows, p * rows));
        has_residual = largest > 0;
        has_state = has_residual && beta > 0;
        n_states = 2 * n + (has_state ? points : 0);
        X.reinit(n_states, n_states);
        for (unsigned int i = 0; i < n_states; ++i)
          X(i, i) = 1;
        z.resize(points);
        r.resize(points);
        given.resize(points);
      }

      /// modes over a time; residual over another one
      void fly(const double t, const double residual_t)
      {
        flight(t, X);
        const double decay = has_state ? std::exp(-residual_t / beta) : 0;
        for (unsigned int j = 0; j < n_states; ++j)
          for (unsigned int i = 2 * n; i < n_states; ++i)
            X(i, j) *= decay;
      }

      /// @param stiffness by point [N/m]
      void impulse_update(const std::vector<double> &stiffness)
      {
        // (beta + dt + S k dt) r = beta r - S k dt z, the same for all columns
        DenseMatrix coupling(points), inverse(points);
        if (has_residual)
        {
          for (unsigned int p = 0; p < points; ++p)
            for (unsigned int l = 0; l < points; ++l)
            {
              coupling(p, l) = body.residual(p * rows, l * rows) * stiffness[l] * dt;
              inverse(p, l) = coupling(p, l) + (p == l ? beta + dt : 0.);
            }
          inverse.invert();
        }
        for (unsigned int j = 0; j < n_states; ++j)
        {
          double *const x = &X(0, j);
          std::fill(z.begin(), z.end(), 0.);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int p = 0; p < points; ++p)
              z[p] += body.trace(p * rows, i) * x[i];
          if (has_residual)
          {
            for (unsigned int p = 0; p < points; ++p)
            {
              given[p] = has_state ? beta * x[2 * n + p] : 0.;
              for (unsigned int l = 0; l < points; ++l)
                given[p] -= coupling(p, l) * z[l];
            }
            for (unsigned int p = 0; p < points; ++p)
            {
              r[p] = 0;
              for (unsigned int l = 0; l < points; ++l)
                r[p] += inverse(p, l) * given[l];
            }
            for (unsigned int p = 0; p < points; ++p)
            {
              z[p] += r[p];
              if (has_state)
                x[2 * n + p] = r[p];
            }
          }
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int p = 0; p < points; ++p)
              x[n + i] -= body.trace(p * rows, i) * stiffness[p] * dt * z[p];
        }
      }

      DenseMatrix X;

    private:
      const ForcedBody &body;
      const unsigned int n, points, rows;
      const double dt, beta;
      bool has_residual = false, has_state = false;
      unsigned int n_states = 0;
      std::vector<double> z, r, given;
      Flight flight;
    };
  } // namespace

  ForcedBody slow_part(const ForcedBody &body, const double omega)
  {
    ForcedBody slow = body;
    std::vector<unsigned int> kept;
    for (unsigned int k = 0; k < body.n_modes(); ++k)
      if (body.omega[k] <= omega || kept.empty())
        kept.push_back(k);
      else
        for (unsigned int i = 0; i < body.n_rows(); ++i)
          for (unsigned int j = 0; j < body.n_rows(); ++j)
            slow.residual(i, j) += body.trace(i, k) * body.trace(j, k) / (body.omega[k] * body.omega[k]);
    const unsigned int n = kept.size();
    slow.trace.reinit(body.n_rows(), n);
    slow.omega.clear();
    slow.damping_ratio.clear();
    slow.modal_load.clear();
    for (unsigned int k = 0; k < n; ++k)
    {
      slow.omega.push_back(body.omega[kept[k]]);
      slow.damping_ratio.push_back(body.damping_ratio[kept[k]]);
      slow.modal_load.push_back(body.modal_load[kept[k]]);
      for (unsigned int i = 0; i < body.n_rows(); ++i)
        slow.trace(i, k) = body.trace(i, kept[k]);
    }
    return slow;
  }

  std::vector<Complex> monodromy_multipliers(const ForcedBody &body, const TangentContact &contact)
  {
    const unsigned int count = contact.stiffness[0].size(), points = body.n_points();
    const double dt = 1 / (contact.frequency * count);
    Variation variation(body, dt);
    std::vector<double> k(points);
    // half an interval before the first sample, half behind the last one
    double modes_behind = 0.5, residual_behind = 0;
    for (unsigned int i = 0; i < count; ++i)
    {
      bool touches = false;
      for (unsigned int p = 0; p < points; ++p)
      {
        k[p] = contact.stiffness[p][i];
        touches = touches || k[p] > 0;
      }
      if (touches)
      {
        variation.fly(modes_behind * dt, residual_behind * dt);
        variation.impulse_update(k);
        modes_behind = residual_behind = 0;
      }
      else
        residual_behind += 1;
      modes_behind += i + 1 < count ? 1. : 0.5;
    }
    variation.fly(modes_behind * dt, residual_behind * dt);
    return floquet_multipliers(variation.X);
  }

  namespace
  {
    bool is_open(const std::vector<double> &stiffness)
    {
      return std::all_of(stiffness.begin(), stiffness.end(), [](const double value) { return value == 0; });
    }

    /// Logarithm of Hill's determinant at lambda; of a law as a projection, whose start may be far off, times what is zero at the
    /// multipliers of the free modes, the determinant's poles.
    class HillDeterminant
    {
    public:
      HillDeterminant(const ForcedBody &body, const TangentContact &contact, const int n_harmonics)
          : body(body), H(n_harmonics), Omega(2 * M_PI * contact.frequency),
            without_poles(!contact.share.empty())
      {
        for (unsigned int p = 0; p < body.n_points(); ++p)
          if (!is_open(contact.stiffness[p]))
          {
            rows.push_back(p * body.rows_per_point);
            stiffness.push_back(spectrum(contact.stiffness[p]));
            share.push_back(contact.share.empty() ? std::vector<Complex>(4 * H + 1)
                                                  : spectrum(contact.share[p]));
          }
      }

      Complex logarithm(const Complex lambda)
      {
        const unsigned int points = rows.size();
        const unsigned int n = points * (2 * H + 1);
        std::vector<Complex> matrix(std::size_t(n) * n);
        std::vector<Complex> receptance(points * points);
        for (int l = -H; l <= H; ++l)
        {
          const Complex s = lambda + Complex(0, l * Omega);
          for (unsigned int p = 0; p < points; ++p)
            for (unsigned int q = 0; q < points; ++q)
              receptance[p * points + q] = body.residual(rows[p], rows[q]) / (1. + body.relaxation * s);
          for (unsigned int k = 0; k < body.n_modes(); ++k)
          {
            const Complex mode =
                1. / (s * s + 2 * body.damping_ratio[k] * body.omega[k] * s + body.omega[k] * body.omega[k]);
            for (unsigned int p = 0; p < points; ++p)
              for (unsigned int q = 0; q < points; ++q)
                receptance[p * points + q] += body.trace(rows[p], k) * body.trace(rows[q], k) * mode;
          }
          for (unsigned int q = 0; q < points; ++q)
            for (int k = -H; k <= H; ++k)
              for (unsigned int p = 0; p < points; ++p)
              {
                const std::size_t row = (k + H) * points + p, column = (l + H) * points + q;
                Complex &entry = matrix[column * n + row];
                entry = stiffness[p][k - l + 2 * H] * receptance[p * points + q];
                if (p == q)
                  entry += (k == l ? 1. : 0.) - share[p][k - l + 2 * H];
              }
        }
        factors.factorise(std::move(matrix));
        Complex result = factors.log_determinant();
        const double T = 2 * M_PI / Omega;
        for (unsigned int k = 0; k < body.n_modes() && without_poles; ++k)
          if (body.omega[k] < (H + 0.5) * Omega)
          {
            const double zeta = body.damping_ratio[k];
            const Complex root = std::sqrt(Complex(zeta * zeta - 1));
            for (const double sign : {1., -1.})
              result += std::log(1. - std::exp((body.omega[k] * (sign * root - zeta) - lambda) * T));
          }
        return result;
      }

    private:
      /// Fourier coefficients of orders -2 H to 2 H
      std::vector<Complex> spectrum(const std::vector<double> &samples) const
      {
        std::vector<Complex> result(4 * H + 1);
        const double count = samples.size();
        for (unsigned int i = 0; i < samples.size(); ++i)
        {
          if (samples[i] == 0)
            continue;
          const Complex turn = std::polar(1., -2 * M_PI * i / count);
          Complex factor = samples[i] / count * std::polar(1., 4 * M_PI * H * i / count);
          for (Complex &value : result)
          {
            value += factor;
            factor *= turn;
          }
        }
        return result;
      }

      const ForcedBody &body;
      const int H;
      const double Omega;
      const bool without_poles;
      /// of the points that touch: their normal rows, spectra of stiffness and share
      std::vector<unsigned int> rows;
      std::vector<std::vector<Complex>> stiffness, share;
      LuFactors<Complex> factors;
    };
  } // namespace

  Complex hill_multiplier(const ForcedBody &body, const TangentContact &contact,
                          const unsigned int n_harmonics, const Complex start)
  {
    if (std::all_of(contact.stiffness.begin(), contact.stiffness.end(), is_open))
      return start; // free modes, the determinant is one
    HillDeterminant determinant(body, contact, n_harmonics);
    const double f = contact.frequency;
    Complex before = f * std::log(start), lambda = before + 1e-3 * f;
    const Complex scale = determinant.logarithm(before);
    Complex value_before = 1, value = std::exp(determinant.logarithm(lambda) - scale);
    for (unsigned int iteration = 0; iteration < 60; ++iteration)
    {
      if (value == 0. || std::abs(lambda - before) <= 1e-12 * (f + std::abs(lambda)))
        return std::exp(lambda / f);
      Complex step = -value * (lambda - before) / (value - value_before);
      if (!std::isfinite(std::abs(step)))
        break;
      step *= std::min(1., f / std::abs(step));
      before = lambda;
      value_before = value;
      lambda += step;
      value = std::exp(determinant.logarithm(lambda) - scale);
    }
    throw ConvergenceError("Hill's determinant: no zero was found near the multiplier " +
                           std::to_string(start.real()) + ": give more harmonics.");
  }
} // namespace vibrocontact

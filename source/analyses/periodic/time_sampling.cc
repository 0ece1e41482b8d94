#include <vibrocontact/analyses/periodic/time_sampling.h>
#include <vibrocontact/base/exceptions.h>

#include <fftw3.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    std::vector<double> sample_phases(const TimeBasis &trial, const TimeBasis &weighting,
                                      const unsigned int least)
    {
      const bool cells = trial.n_derivatives() == 0 || weighting.n_derivatives() == 0,
                 dyadic = trial.is_dyadic() || weighting.is_dyadic();
      const unsigned int n = trial.n_functions();
      unsigned int count = least;
      if (dyadic)
        for (count = cells ? n : 1; count < least;)
          count *= 2;
      else if (cells)
        count = (least + n - 1) / n * n;
      const double shift = cells ? 0.5 : 0.;
      std::vector<double> phases(count);
      for (unsigned int i = 0; i < count; ++i)
        phases[i] = (i + shift) / count;
      return phases;
    }
  } // namespace

  /// u(t_i) = sum_m a_m e^(2 pi j m t_i) by FFTW.
  struct TimeSampling::Fourier
  {
    Fourier(const unsigned int n, const unsigned int count)
        : n(n), count(count), time(fftw_alloc_real(count)), line(fftw_alloc_complex(count / 2 + 1))
    {
      forward = fftw_plan_dft_r2c_1d(count, time, line, FFTW_ESTIMATE);
      backward = fftw_plan_dft_c2r_1d(count, line, time, FFTW_ESTIMATE);
    }
    ~Fourier()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
      fftw_free(time);
      fftw_free(line);
    }

    void samples(const Quantity quantity, const double *const a, double *const values)
    {
      for (unsigned int m = 0; m < count / 2 + 1; ++m)
        line[m][0] = line[m][1] = 0;
      const auto put = [&](const unsigned int m, const Complex value)
      {
        const Complex v = quantity == Quantity::velocity ? Complex(0, 2 * M_PI * m) * value : value;
        line[m][0] = v.real();
        line[m][1] = v.imag();
      };
      put(0, a[0]);
      for (unsigned int m = 1; 2 * m < n; ++m)
        put(m, Complex(a[2 * m - 1], a[2 * m]));
      if (n % 2 == 0) // sin(pi N t), whose norm is 1/2
        put(n / 2, Complex(0, (quantity == Quantity::force ? -1. : -0.5) * a[n - 1]));
      fftw_execute(backward);
      std::copy(time, time + count, values);
    }

    /// 1/count sum_i values_i e^(-2 pi j m t_i) into `line`
    void spectrum(const double *const values)
    {
      std::copy(values, values + count, time);
      fftw_execute(forward);
      for (unsigned int m = 0; m < count / 2 + 1; ++m)
      {
        line[m][0] /= count;
        line[m][1] /= count;
      }
    }

    void moments(const double *const values, double *const c)
    {
      spectrum(values);
      c[0] = line[0][0];
      for (unsigned int m = 1; 2 * m < n; ++m)
      {
        c[2 * m - 1] = line[m][0];
        c[2 * m] = line[m][1];
      }
      if (n % 2 == 0)
        c[n - 1] = -line[n / 2][1];
    }

    /// Toeplitz and Hankel parts from the spectrum of the weight
    void add_weighted(const double *const weight, const Quantity quantity, const double factor,
                      DenseMatrix &into, const unsigned int row, const unsigned int column)
    {
      spectrum(weight);
      const auto w = [&](const int m)
      {
        const int k = std::abs(m);
        return Complex(line[k][0], m < 0 ? -line[k][1] : line[k][1]);
      };
      const bool even = n % 2 == 0;
      const auto put = [&](const unsigned int m, const unsigned int at, const Complex value)
      {
        if (m == 0)
          into(row, column + at) += value.real();
        else if (even && m == n / 2)
          into(row + n - 1, column + at) -= value.imag();
        else
        {
          into(row + 2 * m - 1, column + at) += value.real();
          into(row + 2 * m, column + at) += value.imag();
        }
      };
      for (unsigned int k = 0; 2 * k <= n; ++k)
      {
        const Complex scale = quantity == Quantity::velocity ? factor * Complex(0, 2 * M_PI * k) : factor;
        for (unsigned int m = 0; 2 * m <= n; ++m)
        {
          const int i = m, j = k;
          // a e_k + conj(a) e_-k, for a = 1 and a = j
          const Complex plus = scale * w(i - j), minus = std::conj(scale) * w(i + j);
          if (k == 0)
            put(m, 0, plus);
          else if (even && k == n / 2)
            put(m, n - 1, Complex(0, quantity == Quantity::force ? -1. : -0.5) * (plus - minus));
          else
          {
            put(m, 2 * k - 1, plus + minus);
            put(m, 2 * k, Complex(0, 1) * (plus - minus));
          }
        }
      }
    }

    const unsigned int n, count;
    double *const time;
    fftw_complex *const line;
    fftw_plan forward, backward;
  };

  TimeSampling::TimeSampling(const TimeBasis &trial, const TimeBasis &weighting_basis,
                             const TimePairing &pairing, const unsigned int n_samples)
      : n(trial.n_functions()), phase(sample_phases(trial, weighting_basis, n_samples))
  {
    check_samples(n, n_samples);
    if (trial.n_derivatives() == TimeBasis::smooth && weighting_basis.n_derivatives() == TimeBasis::smooth)
    {
      fourier = std::make_unique<Fourier>(n, phase.size());
      return;
    }
    displacement = sampled(trial, phase, 0);
    if (trial.n_derivatives() > 0)
      velocity = sampled(trial, phase, 1);
    weighting = sampled(weighting_basis, phase, 0);
    force = over_norms(weighting, pairing);
    for (unsigned int k = 0; k < n; ++k)
    {
      const unsigned int m = (k + 1) / 2;
      const bool is_pair = m > 0 && 2 * m < n;
      for (unsigned int i = 0; i < phase.size(); ++i)
        weighting(i, k) /= phase.size() * (is_pair ? 2. : 1.);
    }
  }

  TimeSampling::~TimeSampling() = default;

  const DenseMatrix &TimeSampling::values_of(const Quantity quantity) const
  {
    if (quantity == Quantity::velocity)
      AssertThrow(velocity.m() > 0, dealii::ExcMessage("these trial functions have no velocity"));
    return quantity == Quantity::displacement ? displacement
           : quantity == Quantity::velocity   ? velocity
                                              : force;
  }

  void TimeSampling::samples(const Quantity quantity, const double *const coefficients,
                             double *const values) const
  {
    if (fourier)
      return fourier->samples(quantity, coefficients, values);
    DenseVector x(n), y(phase.size());
    std::copy(coefficients, coefficients + n, x.begin());
    values_of(quantity).vmult(y, x);
    std::copy(y.begin(), y.end(), values);
  }

  void TimeSampling::moments(const double *const values, double *const result) const
  {
    if (fourier)
      return fourier->moments(values, result);
    DenseVector x(phase.size()), y(n);
    std::copy(values, values + phase.size(), x.begin());
    weighting.Tvmult(y, x);
    std::copy(y.begin(), y.end(), result);
  }

  void TimeSampling::add_weighted(const double *const weight, const Quantity quantity, const double factor,
                                  DenseMatrix &into, const unsigned int row, const unsigned int column) const
  {
    if (fourier)
      return fourier->add_weighted(weight, quantity, factor, into, row, column);
    std::vector<unsigned int> active;
    for (unsigned int i = 0; i < phase.size(); ++i)
      if (weight[i] != 0)
        active.push_back(i);
    if (active.empty())
      return;
    const DenseMatrix &values = values_of(quantity);
    DenseMatrix left(active.size(), n), right(active.size(), n), block(n, n);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int a = 0; a < active.size(); ++a)
      {
        left(a, k) = factor * weight[active[a]] * weighting(active[a], k);
        right(a, k) = values(active[a], k);
      }
    left.Tmmult(block, right);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        into(row + i, column + k) += block(i, k);
  }

  void check_samples(const unsigned int n_functions, const unsigned int n_samples)
  {
    if (n_samples < 2 * n_functions)
      throw InputError("Periodic/Samples = " + std::to_string(n_samples) + " is too few for " +
                       std::to_string(n_functions) + " functions: give at least twice as many.");
  }

  DenseMatrix over_norms(DenseMatrix values, const TimePairing &pairing)
  {
    for (unsigned int k = 0; k < values.n(); ++k)
      for (unsigned int i = 0; i < values.m(); ++i)
        values(i, k) /= pairing.norm[(k + 1) / 2];
    return values;
  }

  DenseMatrix sampled_velocity(const TimeBasis &basis, const std::vector<double> &phases)
  {
    if (basis.n_derivatives() > 0)
      return sampled(basis, phases, 1);
    const unsigned int n = basis.n_functions();
    std::vector<double> shifted = phases;
    for (double &t : shifted)
    {
      t += 0.5 / n;
      t -= std::floor(t);
    }
    // a_k - a_(k-1) multiplies the coefficient of order m by N (1 - e^(-2 pi j m / N))
    DenseMatrix result = sampled(basis, shifted, 0);
    for (unsigned int m = 0; 2 * m <= n; ++m)
    {
      const Complex d = double(n) * (1. - std::polar(1., -2 * M_PI * m / n));
      for (unsigned int i = 0; i < phases.size(); ++i)
        if (m == 0)
          result(i, 0) = 0;
        else if (2 * m == n)
          result(i, n - 1) *= d.real();
        else
        {
          // columns hold 2 Re Theta and -2 Im Theta
          const Complex theta(result(i, 2 * m - 1), -result(i, 2 * m)), changed = d * theta;
          result(i, 2 * m - 1) = changed.real();
          result(i, 2 * m) = -changed.imag();
        }
    }
    return result;
  }
} // namespace vibrocontact

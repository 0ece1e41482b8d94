#include <vibrocontact/numerics/signal.h>

#include <deal.II/base/numbers.h>

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace vibrocontact
{
  namespace
  {
    /// Hermite cubic between sample i and the next.
    double cubic(const std::vector<double> &t, const std::vector<double> &y, const std::size_t i,
                 const double time)
    {
      const auto slope = [&](const std::size_t k)
      {
        const std::size_t a = k > 0 ? k - 1 : k, b = k + 1 < t.size() ? k + 1 : k;
        return (y[b] - y[a]) / (t[b] - t[a]);
      };
      const double h = t[i + 1] - t[i], s = (time - t[i]) / h;
      return y[i] * (1 + 2 * s) * (1 - s) * (1 - s) + y[i + 1] * s * s * (3 - 2 * s) +
             h * (slope(i) * s * (1 - s) * (1 - s) - slope(i + 1) * s * s * (1 - s));
    }
  } // namespace

  Signal equally_spaced(const std::vector<double> &times, const std::vector<double> &values)
  {
    Signal signal;
    const std::size_t n = times.size();
    if (n < 2)
    {
      signal.begin = n == 0 ? 0 : times[0];
      signal.values = values;
      return signal;
    }
    signal.begin = times[0];
    signal.step = (times[n - 1] - times[0]) / (n - 1);
    bool equal = true;
    for (std::size_t i = 0; i < n && equal; ++i)
      equal = std::abs(times[i] - signal.time(i)) < 1e-6 * signal.step;
    if (equal)
    {
      signal.values = values;
      return signal;
    }
    std::vector<double> distances(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i)
      distances[i] = times[i + 1] - times[i];
    std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
    signal.step = distances[distances.size() / 2];
    std::size_t i = 0;
    for (std::size_t k = 0; signal.time(k) <= times[n - 1]; ++k)
    {
      while (i + 2 < n && times[i + 1] < signal.time(k))
        ++i;
      signal.values.push_back(cubic(times, values, i, signal.time(k)));
    }
    return signal;
  }

  Signal part(const Signal &signal, const double from, const double to)
  {
    Signal result;
    result.step = signal.step;
    const double last = double(signal.size()) - 1;
    const double a = std::max(0., std::ceil((from - signal.begin) / signal.step - 1e-6)),
                 b = std::min(last, std::floor((to - signal.begin) / signal.step + 1e-6));
    result.begin = signal.time(a);
    if (b >= a)
      result.values.assign(signal.values.begin() + std::size_t(a),
                           signal.values.begin() + std::size_t(b) + 1);
    return result;
  }

  Signal resampled(const Signal &signal, const double rate, const double fade)
  {
    constexpr double pi = dealii::numbers::PI;
    Signal result;
    result.begin = signal.begin;
    result.step = 1 / rate;
    if (signal.size() < 2)
      return result;
    // a length, zeros included, that is (nearly) a whole number of samples at both rates
    const double ratio = signal.step * rate;
    std::size_t n = signal.size();
    double least = 1;
    for (std::size_t k = signal.size(); k < signal.size() + 4096; ++k)
    {
      const double miss = std::abs(k * ratio - std::round(k * ratio));
      if (miss < least - 1e-9)
      {
        least = miss;
        n = k;
      }
    }
    const std::size_t m = std::max<std::size_t>(1, std::llround(n * ratio));
    std::vector<double> values(signal.values);
    values.resize(n, 0.);
    const std::size_t n_fade = std::min<double>(signal.size() / 2, fade / signal.step);
    for (std::size_t i = 0; i < n_fade; ++i)
    {
      const double weight = 0.5 - 0.5 * std::cos(pi * i / n_fade);
      values[i] *= weight;
      values[signal.size() - 1 - i] *= weight;
    }
    std::vector<std::complex<double>> spectrum(n / 2 + 1);
    const auto complex = [](std::vector<std::complex<double>> &v)
    { return reinterpret_cast<fftw_complex *>(v.data()); };
    fftw_plan plan = fftw_plan_dft_r2c_1d(n, values.data(), complex(spectrum), FFTW_ESTIMATE);
    fftw_execute(plan);
    fftw_destroy_plan(plan);

    const double length = n * signal.step, limit = 0.5 * std::min(rate, 1 / signal.step);
    spectrum.resize(m / 2 + 1);
    for (std::size_t k = 0; k < spectrum.size(); ++k)
    {
      const double flank = (k / length / limit - 0.92) / 0.08;
      const double weight = flank <= 0 ? 1 : flank >= 1 ? 0 : 0.5 + 0.5 * std::cos(pi * flank);
      spectrum[k] *= weight / n;
    }
    std::vector<double> output(m);
    plan = fftw_plan_dft_c2r_1d(m, complex(spectrum), output.data(), FFTW_ESTIMATE);
    fftw_execute(plan);
    fftw_destroy_plan(plan);
    output.resize(std::min<std::size_t>(m, std::floor((signal.end() - signal.begin) * rate) + 1));
    result.values = output;
    return result;
  }
} // namespace vibrocontact

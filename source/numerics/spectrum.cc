#include <vibrocontact/numerics/spectrum.h>

#include <deal.II/base/numbers.h>

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int padding = 4;
    /// samples of the padded spectrum in two of the window's resolutions, those of a sine's main lobe on either side
    constexpr std::size_t reach = 2 * padding;

    /// Amplitudes of sines at the frequencies k / (padding N step).
    std::vector<double> amplitude_spectrum(const Signal &signal)
    {
      constexpr double pi = dealii::numbers::PI;
      const std::size_t n = signal.size(), length = padding * n;
      const double mean = std::accumulate(signal.values.begin(), signal.values.end(), 0.) / n;
      std::vector<double> values(length, 0.);
      for (std::size_t i = 0; i < n; ++i)
        values[i] = (signal.values[i] - mean) * (0.5 - 0.5 * std::cos(2 * pi * i / n));
      std::vector<std::complex<double>> spectrum(length / 2 + 1);
      const fftw_plan plan = fftw_plan_dft_r2c_1d(
          length, values.data(), reinterpret_cast<fftw_complex *>(spectrum.data()), FFTW_ESTIMATE);
      fftw_execute(plan);
      fftw_destroy_plan(plan);
      std::vector<double> amplitude(spectrum.size());
      for (std::size_t k = 0; k < spectrum.size(); ++k)
        amplitude[k] = std::abs(spectrum[k]) * 4 / n; // 2 / n, and the window's mean is 1/2
      return amplitude;
    }
  } // namespace

  std::vector<SpectralPeak> spectral_peaks(const Signal &signal, const unsigned int n, const double floor)
  {
    std::vector<SpectralPeak> peaks;
    if (signal.size() < least_samples_of_spectrum)
      return peaks;
    const std::vector<double> a = amplitude_spectrum(signal);
    const auto [low, high] = std::minmax_element(signal.values.begin(), signal.values.end());
    const double least = 1e-3 * (*high - *low) / 2;
    const double resolution = 1 / (padding * signal.size() * signal.step);
    for (std::size_t k = reach; k + 1 < a.size(); ++k)
    {
      const auto begin = a.begin() + (k - reach), end = a.begin() + std::min(a.size(), k + reach + 1);
      if (!(a[k] > least) || std::max_element(begin, end) != a.begin() + k)
        continue;
      const double left = std::log(std::max(a[k - 1], 1e-12 * a[k])), middle = std::log(a[k]),
                   right = std::log(std::max(a[k + 1], 1e-12 * a[k]));
      const double bend = left - 2 * middle + right, shift = bend < 0 ? 0.5 * (left - right) / bend : 0;
      peaks.push_back({(k + shift) * resolution, std::exp(middle - 0.25 * (left - right) * shift)});
    }
    std::stable_sort(peaks.begin(), peaks.end(),
                     [](const SpectralPeak &x, const SpectralPeak &y) { return x.amplitude > y.amplitude; });
    const auto small = std::find_if(peaks.begin(), peaks.end(),
                                    [&](const SpectralPeak &peak)
                                    { return !(peak.amplitude >= floor * peaks.front().amplitude); });
    peaks.erase(small, peaks.end());
    if (peaks.size() > n)
      peaks.resize(n);
    return peaks;
  }

  double slow_part(const Signal &signal, const std::vector<SpectralPeak> &peaks)
  {
    if (signal.size() < least_samples_of_spectrum)
      return 0;
    const std::vector<double> a = amplitude_spectrum(signal);
    double lowest = std::numeric_limits<double>::infinity();
    for (const SpectralPeak &peak : peaks)
      lowest = std::min(lowest, peak.frequency * padding * signal.size() * signal.step);
    double slow = 0, all = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
    {
      all += a[k] * a[k];
      if (k < reach && double(k) < lowest - double(reach))
        slow += a[k] * a[k];
    }
    return all > 0 ? slow / all : 0;
  }
} // namespace vibrocontact

#include <vibrocontact/numerics/third_octaves.h>

#include <deal.II/base/numbers.h>

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace vibrocontact
{
  namespace
  {
    /// Mean squares of the lines k / duration.
    std::vector<double> line_spectrum(const Signal &signal)
    {
      const std::size_t n = signal.size();
      std::vector<double> values(n), window(n);
      double weights = 0, squares = 0, mean = 0;
      for (std::size_t i = 0; i < n; ++i)
      {
        window[i] = 0.5 - 0.5 * std::cos(2 * dealii::numbers::PI * i / n);
        weights += window[i];
        squares += window[i] * window[i];
        mean += window[i] * signal.values[i];
      }
      mean /= weights;
      for (std::size_t i = 0; i < n; ++i)
        values[i] = window[i] * (signal.values[i] - mean);
      std::vector<std::complex<double>> spectrum(n / 2 + 1);
      const fftw_plan plan = fftw_plan_dft_r2c_1d(
          n, values.data(), reinterpret_cast<fftw_complex *>(spectrum.data()), FFTW_ESTIMATE);
      fftw_execute(plan);
      fftw_destroy_plan(plan);
      std::vector<double> result(spectrum.size());
      for (std::size_t k = 0; k < spectrum.size(); ++k)
        result[k] = (2 * k < n ? 2 : 1) * std::norm(spectrum[k]) / (n * squares);
      return result;
    }

    /// The band about 10^(x / 10) Hz.
    ThirdOctave third_octave(const int x)
    {
      constexpr double nominal[] = {1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8};
      const double half = std::pow(10., 0.05), centre = std::pow(10., 0.1 * x);
      const int decade = x >= 0 ? x / 10 : -((9 - x) / 10);
      return {nominal[x - 10 * decade] * std::pow(10., decade), centre, centre / half, centre * half, 0};
    }
  } // namespace

  std::vector<ThirdOctave> third_octaves_within(const double from, const double to)
  {
    std::vector<ThirdOctave> bands;
    for (int x = std::floor(10 * std::log10(std::max(from, 1e-3)));; ++x)
    {
      const ThirdOctave band = third_octave(x);
      if (band.upper > to)
        return bands;
      if (band.lower >= from)
        bands.push_back(band);
    }
  }

  double ThirdOctave::level() const
  {
    return 20 * std::log10(rms);
  }

  std::vector<ThirdOctave> third_octaves(const Signal &signal)
  {
    std::vector<ThirdOctave> bands;
    if (signal.size() < 16)
      return bands;
    const double distance = 1 / (signal.size() * signal.step), highest = 0.5 / signal.step;
    const std::vector<double> lines = line_spectrum(signal);
    for (int x = std::floor(10 * std::log10(distance));; ++x)
    {
      ThirdOctave band = third_octave(x);
      if (band.upper > highest)
        return bands;
      if (band.upper - band.lower < distance)
        continue;
      double square = 0;
      for (std::size_t k = std::floor(band.lower / distance); k < lines.size(); ++k)
      {
        // a line stands for the frequencies nearer to it than to others
        const double share =
            std::min(k + 0.5, band.upper / distance) - std::max(k - 0.5, band.lower / distance);
        if (share > 0)
          square += share * lines[k];
        if (k > band.upper / distance + 1)
          break;
      }
      band.rms = std::sqrt(square);
      bands.push_back(band);
    }
  }
} // namespace vibrocontact

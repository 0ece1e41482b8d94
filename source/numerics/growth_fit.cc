#include <vibrocontact/numerics/complex_eigenvectors.h>
#include <vibrocontact/numerics/complex_singular_values.h>
#include <vibrocontact/numerics/growth_fit.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;
    using Matrix = dealii::LAPACKFullMatrix<Complex>;
    constexpr unsigned int n_instants = 64, n_columns = 24, most_motions = 12;
    constexpr double two_pi = 2 * dealii::numbers::PI;

    /// The part of the signal near a frequency, shifted to zero frequency, at equally distant instants.
    struct Band
    {
      std::vector<Complex> values;
      double step = 0;
      /// of the middle of the window, counted from the first instant [s]
      double middle = 0;
      /// window of the low pass, distance of its samples, for its response
      std::vector<double> window;
      double sample = 0;

      /// what the low pass makes of exp(s t)
      Complex response(const Complex &s) const
      {
        Complex sum = 0;
        for (std::size_t j = 0; j < window.size(); ++j)
          sum += window[j] * std::exp(s * (sample * (double(j) - double(window.size() - 1) / 2)));
        return sum;
      }
    };

    Band band_of(const Signal &signal, const double frequency)
    {
      Band band;
      const std::size_t n_window = signal.size() / 4;
      const double beta = 16;
      double sum = 0;
      for (std::size_t j = 0; j < n_window; ++j)
      {
        const double x = 2. * j / (n_window - 1) - 1;
        band.window.push_back(std::cyl_bessel_i(0., beta * std::sqrt(std::max(0., 1 - x * x))));
        sum += band.window.back();
      }
      for (double &weight : band.window)
        weight /= sum;
      // a large mean would drown the band of a few periods
      const double mean =
          std::accumulate(signal.values.begin(), signal.values.end(), 0.) / double(signal.size());
      std::vector<Complex> shifted(signal.size());
      for (std::size_t i = 0; i < signal.size(); ++i)
        shifted[i] =
            (signal.values[i] - mean) * std::polar(1., -two_pi * std::fmod(frequency * signal.step * i, 1.));
      const std::size_t distance = (signal.size() - n_window) / (n_instants - 1);
      for (unsigned int k = 0; k < n_instants; ++k)
      {
        Complex value = 0;
        for (std::size_t j = 0; j < n_window; ++j)
          value += band.window[j] * shifted[k * distance + j];
        band.values.push_back(value);
      }
      band.step = distance * signal.step;
      band.sample = signal.step;
      band.middle = (signal.size() - n_window) * signal.step / 2;
      return band;
    }

    /// Exponentials z^k that the values are a sum of.
    std::vector<Complex> pencil(const std::vector<Complex> &values)
    {
      const unsigned int n = n_columns, m = values.size() - n;
      Matrix hankel(m, n + 1);
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j <= n; ++j)
          hankel(i, j) = values[i + j];
      const ComplexSingularValues decomposed = complex_singular_values(hankel);
      unsigned int rank = 0;
      while (rank < most_motions && decomposed.values[rank] > 1e-7 * decomposed.values[0])
        ++rank;
      if (rank == 0)
        return {};
      // The rows of V^H are T Z, Z the powers 0 ... n of each z in a row: B, all but the first column, is
      // T diag(z) T^-1 A, A all but the last, w; and A A^H = I - w w^H.
      const Matrix &vt = decomposed.right;
      Matrix step(rank, rank);
      std::vector<Complex> carried(rank, 0.); // B A^H w
      double size = 0;
      for (unsigned int r = 0; r < rank; ++r)
      {
        size += std::norm(vt(r, n));
        for (unsigned int s = 0; s < rank; ++s)
        {
          Complex sum = 0;
          for (unsigned int j = 0; j < n; ++j)
            sum += vt(r, j + 1) * std::conj(vt(s, j));
          step(r, s) = sum;
          carried[r] += sum * vt(s, n);
        }
      }
      for (unsigned int r = 0; r < rank; ++r)
        for (unsigned int s = 0; s < rank; ++s)
          step(r, s) += carried[r] * std::conj(vt(s, n)) / (1 - size);
      std::vector<Complex> result;
      for (const Complex &z : complex_eigenvalues(step, "eigenvalues of a signal's steps"))
        if (std::abs(z) > 0.1)
          result.push_back(z);
      return result;
    }

    /// Least squares by singular values.
    std::vector<Complex> amplitudes(const std::vector<Complex> &z, const std::vector<Complex> &values,
                                    double &residual)
    {
      Matrix powers(values.size(), z.size());
      for (unsigned int j = 0; j < z.size(); ++j)
        for (unsigned int k = 0; k < values.size(); ++k)
          powers(k, j) = std::pow(z[j], double(k));
      const ComplexSingularValues decomposed = complex_singular_values(powers);
      std::vector<Complex> result(z.size(), 0.);
      for (unsigned int r = 0; r < z.size() && decomposed.values[r] > 1e-12 * decomposed.values[0]; ++r)
      {
        Complex sum = 0;
        for (unsigned int k = 0; k < values.size(); ++k)
          sum += std::conj(decomposed.left(k, r)) * values[k];
        for (unsigned int j = 0; j < z.size(); ++j)
          result[j] += std::conj(decomposed.right(r, j)) * sum / decomposed.values[r];
      }
      double missed = 0, all = 0;
      for (unsigned int k = 0; k < values.size(); ++k)
      {
        Complex rest = values[k];
        for (unsigned int j = 0; j < z.size(); ++j)
          rest -= powers(k, j) * result[j];
        missed += std::norm(rest);
        all += std::norm(values[k]);
      }
      residual = all > 0 ? std::sqrt(missed / all) : 0;
      return result;
    }

    bool too_short(const Signal &signal, const double frequency)
    {
      return signal.size() < 8 * n_instants ||
             !(frequency * signal.step * signal.size() > least_periods_of_growth);
    }
  } // namespace

  GrowthFit fit_growth(const Signal &signal, const double frequency)
  {
    GrowthFit fit;
    if (too_short(signal, frequency))
      return fit;
    const Band band = band_of(signal, frequency);
    const std::vector<Complex> z = pencil(band.values);
    if (z.empty())
      return fit;
    double residual = 0;
    const std::vector<Complex> a = amplitudes(z, band.values, residual);
    for (unsigned int j = 0; j < z.size(); ++j)
    {
      const Complex s = std::log(z[j]) / band.step;
      const double size = 2 * std::abs(a[j] / band.response(s)) * std::exp(s.real() * band.middle);
      // the flank of the low pass would blow up what is only noise there; near zero is what drifts
      if (std::abs(s.imag()) * signal.step * signal.size() > two_pi * 12 ||
          s.imag() < -two_pi * frequency / 2 || !(size > fit.amplitude))
        continue;
      fit = {frequency + s.imag() / two_pi, s.real(), size, residual};
    }
    return fit;
  }

  std::vector<GrowthFit> fit_growths(const Signal &signal, const unsigned int n)
  {
    std::vector<GrowthFit> fits;
    for (const SpectralPeak &peak : spectral_peaks(signal, n, 1e-3))
    {
      const GrowthFit fit = fit_growth(signal, peak.frequency);
      const bool known =
          std::any_of(fits.begin(), fits.end(),
                      [&](const GrowthFit &other)
                      {
                        return std::abs(other.frequency - fit.frequency) <
                               std::max(1e-4 * fit.frequency, 0.05 / (signal.step * signal.size()));
                      });
      if (fit.amplitude > 0 && !known)
        fits.push_back(fit);
    }
    std::stable_sort(fits.begin(), fits.end(),
                     [](const GrowthFit &x, const GrowthFit &y) { return x.amplitude > y.amplitude; });
    return fits;
  }

  std::vector<SpectralPeak> peaks_too_short_for_growth(const Signal &signal, const unsigned int n)
  {
    std::vector<SpectralPeak> peaks = spectral_peaks(signal, n, 1e-3);
    peaks.erase(std::remove_if(peaks.begin(), peaks.end(),
                               [&](const SpectralPeak &peak) { return !too_short(signal, peak.frequency); }),
                peaks.end());
    return peaks;
  }
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/least_squares.h>
#include <vibrocontact/numerics/lsce.h>

#include <algorithm>
#include <cmath>
#include <fftw3.h>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  std::optional<double> line_spacing(const Spectra &data)
  {
    const unsigned int n_lines = data.omega.size();
    const double spacing = data.omega.back() / (n_lines - 1);
    for (unsigned int l = 0; l < n_lines; ++l)
      if (std::abs(data.omega[l] - l * spacing) > 1e-6 * spacing)
        return {};
    return spacing;
  }

  ImpulseResponses impulse_responses(const Spectra &data, const unsigned int n_samples)
  {
    const unsigned int n = std::max<unsigned int>(2 * (data.omega.size() - 1), n_samples);
    const std::optional<double> spacing = line_spacing(data);
    if (!spacing)
      throw InputError(
          "Identification/Method lsce needs frequencies equally spaced from 0 Hz on for its inverse "
          "Fourier transform: give such data or choose vector fitting.");
    ImpulseResponses result;
    const double frequency_step = *spacing / (2 * M_PI);
    result.step = 1 / (n * frequency_step);
    std::vector<Complex> lines(n / 2 + 1);
    std::vector<double> samples(n);
    const fftw_plan plan = fftw_plan_dft_c2r_1d(n, reinterpret_cast<fftw_complex *>(lines.data()),
                                                samples.data(), FFTW_ESTIMATE);
    for (const auto &entry : data.values)
    {
      std::fill(lines.begin(), lines.end(), Complex(0));
      std::copy(entry.begin(), entry.end(), lines.begin());
      fftw_execute(plan);
      result.values.push_back(samples);
      for (double &sample : result.values.back())
        sample *= frequency_step;
    }
    fftw_destroy_plan(plan);
    return result;
  }

  unsigned int most_lsce_pairs(const Spectra &data)
  {
    return (data.omega.size() - 1) / 4;
  }

  std::vector<Complex> lsce_poles(const ImpulseResponses &responses, const unsigned int n_pairs)
  {
    const unsigned int order = 2 * n_pairs, n_samples = responses.values.front().size() / 2;
    if (n_samples < 2 * order)
      throw InputError("Identification/Numbers of pole pairs asks lsce for " + std::to_string(n_pairs) +
                       " pairs, but its data have no more than " + std::to_string(2 * n_samples) +
                       " samples in time: ask for fewer or give a finer frequency axis.");
    const unsigned int n_rows = n_samples - order;
    DenseMatrix A(n_rows * responses.values.size(), order), B(A.m(), 1);
    for (unsigned int i = 0; i < responses.values.size(); ++i)
    {
      const std::vector<double> &g = responses.values[i];
      double largest = 0;
      for (const double value : g)
        largest = std::max(largest, std::abs(value));
      const double weight = largest > 0 ? 1 / largest : 1;
      for (unsigned int r = 0; r < n_rows; ++r)
      {
        for (unsigned int k = 0; k < order; ++k)
          A(i * n_rows + r, k) = weight * g[r + k];
        B(i * n_rows + r, 0) = -weight * g[r + order];
      }
    }
    const DenseMatrix beta = least_squares(A, B);
    DenseMatrix companion(order, order);
    for (unsigned int k = 0; k < order; ++k)
    {
      companion(k, order - 1) = -beta(k, 0);
      if (k > 0)
        companion(k, k - 1) = 1;
    }
    std::vector<Complex> poles;
    for (const Complex &root : general_eigenvalues(companion))
      if (std::abs(root) < 1 && (root.imag() > 0 || (root.imag() == 0 && root.real() > 0)))
        poles.push_back(std::log(root) / responses.step);
    std::sort(poles.begin(), poles.end(),
              [](const Complex &a, const Complex &b) { return a.imag() < b.imag(); });
    return poles;
  }

  PoleFit lsce_fit(const Spectra &data, const unsigned int n_pairs, const ResidueRules &rules)
  {
    return fit_residues(data, lsce_poles(impulse_responses(data), n_pairs), rules);
  }
} // namespace vibrocontact

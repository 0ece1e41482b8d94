#include <vibrocontact/contact/fourier_product.h>

#include <fftw3.h>

#include <algorithm>
#include <limits>

namespace vibrocontact
{
  struct FourierProduct::Plans
  {
    fftw_plan forward, backward;

    ~Plans()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
    }
  };

  namespace
  {
    /// 1, or the smallest of 2^k times 1, 3, 5, 9 or 15 that is not below n: longer ones of higher powers take more time
    unsigned int fast_size(const unsigned int n)
    {
      if (n == 1)
        return 1;
      unsigned int best = std::numeric_limits<unsigned int>::max();
      for (const unsigned int odd : {1, 3, 5, 9, 15})
      {
        unsigned int size = 2 * odd;
        while (size < n)
          size *= 2;
        best = std::min(best, size);
      }
      return best;
    }

    fftw_complex *complex_numbers(AlignedVector &values)
    {
      return reinterpret_cast<fftw_complex *>(values.data());
    }
  } // namespace

  FourierProduct::FourierProduct(const Kernel &kernel, const unsigned int n_components, const Size &sources,
                                 const Size &targets, const int shift_x, const int shift_y)
      : sources(sources), targets(targets), n_components(n_components),
        n_x(fast_size(sources.x + targets.x - 1)), n_y(fast_size(sources.y + targets.y - 1)),
        n_spectrum(padded(2 * std::size_t(n_x / 2 + 1) * n_y)), forces(std::size_t(n_x) * n_y, 0.),
        sums(std::size_t(n_x) * n_y, 0.), spectrum(n_spectrum, 0.),
        kernels(n_components * n_components, AlignedVector(n_spectrum, 0.)),
        force_spectra(n_components, AlignedVector(n_spectrum, 0.)),
        plans(
            new Plans{fftw_plan_dft_r2c_2d(n_y, n_x, forces.data(), complex_numbers(spectrum), FFTW_ESTIMATE),
                      fftw_plan_dft_c2r_2d(n_y, n_x, complex_numbers(spectrum), sums.data(), FFTW_ESTIMATE)})
  {
    const double scale = 1. / (double(n_x) * n_y);
    const int length_x = n_x, length_y = n_y, last_x = sources.x - 1, last_y = sources.y - 1;
    for (unsigned int k = 0; k < kernels.size(); ++k)
    {
      std::fill(forces.begin(), forces.end(), 0.);
      for (int dy = -last_y; dy < int(targets.y); ++dy)
        for (int dx = -last_x; dx < int(targets.x); ++dx)
          forces[std::size_t((dy + length_y) % length_y) * n_x + (dx + length_x) % length_x] =
              scale * kernel(k / n_components, k % n_components, dx + shift_x, dy + shift_y);
      fftw_execute_dft_r2c(plans->forward, forces.data(), complex_numbers(kernels[k]));
    }
    std::fill(forces.begin(), forces.end(), 0.);
  }

  FourierProduct::~FourierProduct() = default;

  void FourierProduct::vmult(double *const y, const double *const R, const std::size_t line,
                             const std::size_t component)
  {
    for (unsigned int c = 0; c < n_components; ++c)
    {
      for (unsigned int j = 0; j < sources.y; ++j)
        std::copy_n(R + c * component + j * line, sources.x, forces.data() + std::size_t(j) * n_x);
      fftw_execute_dft_r2c(plans->forward, forces.data(), complex_numbers(force_spectra[c]));
    }
    const double *own[3], *force[3];
    for (unsigned int c = 0; c < n_components; ++c)
    {
      for (unsigned int k = 0; k < n_components; ++k)
      {
        own[k] = kernels[n_components * c + k].data();
        force[k] = force_spectra[k].data();
      }
      std::fill(spectrum.begin(), spectrum.end(), 0.);
      wide_multiply_spectra(spectrum.data(), own, force, n_components, n_spectrum / 2);
      fftw_execute(plans->backward);
      for (unsigned int j = 0; j < targets.y; ++j)
        std::copy_n(sums.data() + std::size_t(j) * n_x, targets.x, y + c * component + j * line);
    }
  }
} // namespace vibrocontact

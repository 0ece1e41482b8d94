#include <vibrocontact/propagators/block_convolution.h>

#include <fftw3.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    constexpr std::size_t first_block = 64, growth = 8;
  }

  /// Lags first_block ... of one size of blocks.
  struct BlockConvolution::Level
  {
    Level(const std::vector<std::vector<double>> &kernel, const unsigned int n_rows, const std::size_t block,
          const std::size_t n_blocks)
        : n_rows(n_rows), block(block), n_blocks(n_blocks), stride(padded(2 * (block + 1)))
    {
      time.resize(padded(2 * block));
      spectrum.resize(stride);
      const auto complex = [](double *p) { return reinterpret_cast<fftw_complex *>(p); };
      forward = fftw_plan_dft_r2c_1d(2 * block, time.data(), complex(spectrum.data()), FFTW_ESTIMATE);
      backward = fftw_plan_dft_c2r_1d(2 * block, complex(spectrum.data()), time.data(), FFTW_ESTIMATE);
      kernels.resize(n_rows * n_rows * n_blocks * stride);
      inputs.resize(n_rows * n_blocks * stride);
      for (unsigned int pair = 0; pair < n_rows * n_rows; ++pair)
        for (std::size_t b = 0; b < n_blocks; ++b)
        {
          std::fill(time.begin(), time.end(), 0.);
          for (std::size_t k = 0; k < block; ++k)
          {
            const std::size_t lag = (b + 1) * block + k;
            // FFTW's transforms there and back multiply by the length
            time[k] = lag < kernel[pair].size() ? kernel[pair][lag] / (2. * block) : 0.;
          }
          fftw_execute(forward);
          std::copy(spectrum.begin(), spectrum.end(), kernels.begin() + (pair * n_blocks + b) * stride);
        }
      h.resize(n_blocks * n_rows);
      x.resize(n_blocks * n_rows);
    }

    ~Level()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
    }

    /// Takes the newest 2 block forces of each row.
    void take(const double *newest, const std::size_t row_stride)
    {
      newest_block = (newest_block + n_blocks - 1) % n_blocks;
      for (unsigned int j = 0; j < n_rows; ++j)
      {
        std::copy(newest + j * row_stride, newest + j * row_stride + 2 * block, time.begin());
        fftw_execute(forward);
        std::copy(spectrum.begin(), spectrum.end(), inputs.begin() + (j * n_blocks + newest_block) * stride);
      }
    }

    /// What the blocks add to the next `block` displacements of a row.
    const double *give(const unsigned int i)
    {
      std::fill(spectrum.begin(), spectrum.end(), 0.);
      std::size_t n = 0;
      for (unsigned int j = 0; j < n_rows; ++j)
        for (std::size_t b = 0; b < n_blocks; ++b, ++n)
        {
          h[n] = kernels.data() + ((i * n_rows + j) * n_blocks + b) * stride;
          x[n] = inputs.data() + (j * n_blocks + (newest_block + b) % n_blocks) * stride;
        }
      wide_multiply_spectra(spectrum.data(), h.data(), x.data(), n, stride / 2);
      fftw_execute(backward);
      return time.data() + block;
    }

    const unsigned int n_rows;
    const std::size_t block, n_blocks;
    /// numbers of a spectrum, real and imaginary parts, padded
    const std::size_t stride;
    AlignedVector time, spectrum, kernels, inputs;
    std::size_t newest_block = 0;
    std::vector<const double *> h, x;
    fftw_plan forward, backward;
  };

  BlockConvolution::BlockConvolution(const BodyInContact &model,
                                     const std::vector<std::complex<double>> &state,
                                     const PropagatorSettings &settings)
      : motion(model, state, settings.time_step)
  {
    const unsigned long lags = std::max(2ul, settings.memory > 0 ? settings.memory : settings.n_steps);
    const unsigned int n = model.n_rows();
    const auto kernel = step_kernel(model, settings.time_step, settings.interpolation, lags);
    one_step.reinit(n, n);
    direct = std::min<std::size_t>(lags, first_block) - 1;
    backwards.resize(n * n * direct);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        const std::vector<double> &own = kernel[i * n + j];
        one_step(i, j) = own[0];
        std::reverse_copy(own.begin() + 1, own.begin() + 1 + direct,
                          backwards.begin() + (i * n + j) * direct);
      }
    std::size_t block = first_block;
    for (std::size_t lag = first_block; lag < lags; block *= growth)
    {
      // blocks 1, 2, ... of this size; the last size takes the rest if that is short
      const std::size_t needed = (lags - lag + block - 1) / block;
      const std::size_t n_blocks = needed <= 2 * growth ? needed : growth - 1;
      levels.push_back(std::make_unique<Level>(kernel, n, block, n_blocks));
      lag += n_blocks * block;
    }
    const std::size_t largest = levels.empty() ? first_block : levels.back()->block;
    length = 4 * largest;
    end = 2 * largest;
    forces.resize(n * length);
    ring = largest;
    ahead.resize(n * ring);
    free.resize(n);
    motion.add_to(free.data());
  }

  BlockConvolution::~BlockConvolution() = default;

  void BlockConvolution::sum_up()
  {
    const unsigned int n = free.size();
    const std::size_t now = steps % ring;
    for (unsigned int i = 0; i < n; ++i)
    {
      double sum = ahead[i * ring + now];
      ahead[i * ring + now] = 0;
      for (unsigned int j = 0; j < n; ++j)
        sum += wide_dot(backwards.data() + (i * n + j) * direct, forces.data() + j * length + end - direct,
                        direct);
      free[i] = sum;
    }
    motion.add_to(free.data());
  }

  void BlockConvolution::advance(const double *q)
  {
    const unsigned int n = free.size();
    if (end == length)
    {
      for (unsigned int j = 0; j < n; ++j)
      {
        double *own = forces.data() + j * length;
        std::copy(own + length / 2, own + length, own);
      }
      end = length / 2;
    }
    for (unsigned int j = 0; j < n; ++j)
      forces[j * length + end] = q[j];
    ++end;
    ++steps;
    for (const auto &level : levels)
    {
      if (steps % level->block != 0)
        break;
      level->take(forces.data() + end - 2 * level->block, length);
      for (unsigned int i = 0; i < n; ++i)
      {
        const double *added = level->give(i);
        double *to = ahead.data() + i * ring;
        // the ring is a multiple of the block, and so is the step
        for (std::size_t k = 0, at = steps % ring; k < level->block; ++k, ++at)
          to[at] += added[k];
      }
    }
    motion.advance();
    sum_up();
  }

  void BlockConvolution::exchange(CheckpointFile &file)
  {
    exchange_past_forces(file, forces);
    file("propagator/end", end);
    file("propagator/steps", steps);
    file("propagator/ahead", ahead);
    file("propagator/free", free);
    motion.exchange(file, "propagator/motion");
    for (unsigned int k = 0; k < levels.size(); ++k)
    {
      const std::string name = "propagator/level_" + std::to_string(k);
      std::vector<double> kept(levels[k]->inputs.begin(), levels[k]->inputs.end());
      file(name + "/inputs", kept);
      file(name + "/newest", levels[k]->newest_block);
      std::copy(kept.begin(), kept.end(), levels[k]->inputs.begin());
    }
  }
} // namespace vibrocontact

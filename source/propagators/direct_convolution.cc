#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/propagators/direct_convolution.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    double scalar_dot(const double *a, const double *b, const std::size_t n)
    {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k)
        sum += a[k] * b[k];
      return sum;
    }
  } // namespace

  DirectConvolution::DirectConvolution(const BodyInContact &model,
                                       const std::vector<std::complex<double>> &state,
                                       const PropagatorSettings &settings, const bool wide)
      : motion(model, state, settings.time_step), dot(wide ? &wide_dot : &scalar_dot)
  {
    const unsigned long lags = std::max(2ul, settings.memory > 0 ? settings.memory : settings.n_steps);
    const unsigned int n = model.n_rows();
    memory = lags - 1;
    const auto kernel = step_kernel(model, settings.time_step, settings.interpolation, lags);
    one_step.reinit(n, n);
    backwards.resize(n * n * memory);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        const std::vector<double> &own = kernel[i * n + j];
        one_step(i, j) = own[0];
        std::reverse_copy(own.begin() + 1, own.end(), backwards.begin() + (i * n + j) * memory);
      }
    forces.resize(n * 2 * memory);
    free.resize(n);
    motion.add_to(free.data());
  }

  void DirectConvolution::sum_up()
  {
    const unsigned int n = free.size();
    for (unsigned int i = 0; i < n; ++i)
    {
      double sum = 0;
      for (unsigned int j = 0; j < n; ++j)
        sum += dot(backwards.data() + (i * n + j + 1) * memory - count,
                   forces.data() + 2 * memory * j + end - count, count);
      free[i] = sum;
    }
    motion.add_to(free.data());
  }

  void DirectConvolution::advance(const double *q)
  {
    const unsigned int n = free.size();
    if (end == 2 * memory)
    {
      for (unsigned int j = 0; j < n; ++j)
      {
        double *own = forces.data() + 2 * memory * j;
        std::copy(own + memory, own + 2 * memory, own);
      }
      end = memory;
    }
    for (unsigned int j = 0; j < n; ++j)
      forces[2 * memory * j + end] = q[j];
    ++end;
    count = std::min(count + 1, memory);
    motion.advance();
    sum_up();
  }

  void DirectConvolution::exchange(CheckpointFile &file)
  {
    exchange_past_forces(file, forces);
    file("propagator/end", end);
    file("propagator/count", count);
    file("propagator/free", free);
    motion.exchange(file, "propagator/motion");
  }
} // namespace vibrocontact

#pragma once

#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/propagators/step_weights.h>

#include <memory>

namespace vibrocontact
{
  /// The same sums as DirectConvolution by fast Fourier transforms, online: every force counts from the next step on.
  ///
  ///   lags  1 ... L-1      directly
  ///         L ... 8L-1     blocks of L:  every L steps one transform of the newest 2L forces, the products with the
  ///                        blocks of the kernel, one transform back (overlap-save)
  ///        8L ... 64L-1    blocks of 8L, and so on
  ///
  /// A block's products are due when its last force is known, which is when the first displacement that needs them is
  /// asked for: nothing comes late (Gardner, J. Audio Eng. Soc. 43 (1995) 127; Hairer, Lubich, Schlichte, SIAM J. Sci.
  /// Stat. Comput. 6 (1985) 532). Transforms by FFTW; plans are estimated, not measured, so that two runs agree bit for
  /// bit.
  class BlockConvolution final : public Propagator
  {
  public:
    BlockConvolution(const BodyInContact &model, const std::vector<std::complex<double>> &state,
                     const PropagatorSettings &settings);
    ~BlockConvolution() override;
    void advance(const double *q) override;
    void exchange(CheckpointFile &file) override;

  private:
    struct Level;

    void sum_up();

    FreeMotion motion;
    /// lags direct ... 1 of rows i, j
    std::vector<double> backwards;
    std::size_t direct = 0;
    /// per row, twice `length`: the newest forces, sliding as in DirectConvolution
    std::vector<double> forces;
    std::size_t length = 0, end = 0, steps = 0;
    /// per row, what the levels add to the displacements to come; a ring
    std::vector<double> ahead;
    std::size_t ring = 0;
    std::vector<std::unique_ptr<Level>> levels;
  };
} // namespace vibrocontact

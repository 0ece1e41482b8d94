#pragma once

#include <vibrocontact/propagators/step_weights.h>

namespace vibrocontact
{
  /// The paper's reference, Eqs 5, 6 and 22 with their errors put right: every step sums over the newest N_g forces,
  ///
  ///   u_free(t_(n+1)) = free motion + sum_(m = max(0, n - N_g + 1))^(n-1) kernel_(n-m) q_m
  ///
  /// The forces lie in the order of time and the kernel backwards, so that each pair of rows is one scalar product in
  /// the widest registers of the machine, or for comparison a plain loop, one multiplication after the other, as the
  /// paper's. Whole histories cost what they are long: use it for comparison.
  class DirectConvolution final : public Propagator
  {
  public:
    /// @param wide registers, or the plain loop
    DirectConvolution(const BodyInContact &model, const std::vector<std::complex<double>> &state,
                      const PropagatorSettings &settings, bool wide);
    void advance(const double *q) override;
    void exchange(CheckpointFile &file) override;

  private:
    void sum_up();

    FreeMotion motion;
    /// scalar product
    double (*const dot)(const double *a, const double *b, std::size_t n);
    /// N_g - 1: forces kept
    std::size_t memory;
    /// lags memory ... 1 of rows i, j at (i * n + j) * memory
    std::vector<double> backwards;
    /// of each row twice as long as the memory: the newest ones slide through it and are moved back at its end
    std::vector<double> forces;
    /// forces of a row lie in [end - count, end)
    std::size_t end = 0, count = 0;
  };
} // namespace vibrocontact

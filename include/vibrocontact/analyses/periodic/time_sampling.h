#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/numerics/time_pairing.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// Between coefficients in time and samples over the period, where contact laws are evaluated (the alternation between
  /// frequency and time of the harmonic balance, Cameron & Griffin 1989, for any pair of bases). Coefficients and moments
  /// in the real layout of time_basis.h, N numbers; samples at n equal phases.
  ///
  /// Fourier by Fourier goes through FFTW and needs no stored values; any other pair through the values of the
  /// functions, of which only samples that carry weight are touched in products of matrices.
  class TimeSampling
  {
  public:
    /// @param n_samples at least; more where the bases ask for it: a multiple of N with samples in the middle of equal parts of
    /// a cell if one of them is Haar's, a power of two (N times one with Haar) for Daubechies' functions
    /// @throws InputError if n_samples < 2 N
    TimeSampling(const TimeBasis &trial, const TimeBasis &weighting, const TimePairing &pairing,
                 unsigned int n_samples);
    ~TimeSampling();

    unsigned int n_functions() const { return n; }
    unsigned int n_samples() const { return phase.size(); }
    const std::vector<double> &phases() const { return phase; }

    /// What coefficients are samples of: displacement and its derivative with respect to the phase (trial functions),
    /// force from its moments (weighting functions, each divided by its norm)
    enum class Quantity
    {
      displacement,
      velocity,
      force
    };
    void samples(Quantity quantity, const double *coefficients, double *values) const;
    /// int conj(Psi_m) f dt by the samples of f
    void moments(const double *values, double *result) const;
    /// Adds the matrix from coefficients of the quantity to the moments of weight * quantity, to a block of `into`.
    void add_weighted(const double *weight, Quantity quantity, double factor, DenseMatrix &into,
                      unsigned int row, unsigned int column) const;

  private:
    const DenseMatrix &values_of(Quantity quantity) const;

    unsigned int n;
    std::vector<double> phase;
    /// values: samples x N; moments: the weighting functions' over the number of samples; velocity only if it exists
    DenseMatrix displacement, velocity, force, weighting;
    struct Fourier;
    std::unique_ptr<Fourier> fourier;
  };

  /// @throws InputError if n_samples < 2 n_functions
  void check_samples(unsigned int n_functions, unsigned int n_samples);

  /// Weighting functions in samples (n_phases x N), each over its norm: a force from its moments.
  DenseMatrix over_norms(DenseMatrix values, const TimePairing &pairing);

  /// Samples of the velocity, derivative with respect to the phase: of the functions where it exists; for Haar N (a_k -
  /// a_(k-1)) held over one cell around the jump (doc/theory.md, "Periodic motion").
  DenseMatrix sampled_velocity(const TimeBasis &basis, const std::vector<double> &phases);
} // namespace vibrocontact

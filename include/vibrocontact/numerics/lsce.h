#pragma once

#include <vibrocontact/numerics/pole_fit.h>

#include <optional>

namespace vibrocontact
{
  /// Impulse responses of Spectra whose lines are equally spaced from zero on, g(t) = 2 Re of the integral of
  /// G e^{j omega t} over the positive frequencies, by inverse FFT (FFTW).
  struct ImpulseResponses
  {
    /// [s]
    double step = 0;
    /// one list per entry
    std::vector<std::vector<double>> values;
  };

  /// Distance of the lines [rad/s] if they are equally spaced from zero on, otherwise nothing.
  std::optional<double> line_spacing(const Spectra &data);

  /// @param n_samples more of them lie closer, at 1 / (n_samples * spacing of the lines): nothing is taken to be above
  /// the band; 0: 2 (n_lines - 1)
  /// @throws InputError if the lines are not equally spaced from zero on
  ImpulseResponses impulse_responses(const Spectra &data, unsigned int n_samples = 0);

  /// Least squares complex exponential (Brown et al. 1979, SAE 790221): samples of a sum of 2 n_pairs exponentials
  /// fulfil a linear recurrence
  ///
  ///   sum_{k=0}^{2 n_pairs - 1} beta_k g_{n+k} = -g_{n+2 n_pairs}     for all n and all entries,
  ///
  /// solved by least squares over the first half of the record (the second carries what the cut at the end of the
  /// band folds back before t = 0); the roots of the polynomial are e^{lambda_k step}. Unstable roots and
  /// those on the negative real axis, which belong to no pole, are dropped, so that fewer than n_pairs may come out.
  /// @throws InputError for more pairs than most_lsce_pairs()
  std::vector<std::complex<double>> lsce_poles(const ImpulseResponses &responses, unsigned int n_pairs);

  /// Pairs for which the first half of the record gives each entry as many equations as there are unknowns.
  unsigned int most_lsce_pairs(const Spectra &data);

  /// LSCE poles, then residues by least squares on the frequency response.
  PoleFit lsce_fit(const Spectra &data, unsigned int n_pairs, const ResidueRules &rules = {});
} // namespace vibrocontact

#pragma once

#include <vibrocontact/bodies/identified_model.h>

#include <vector>

namespace vibrocontact
{
  /// Receptances on lines, symmetric matrices [m/N].
  struct ReceptanceLines
  {
    /// ascending, positive [rad/s]
    std::vector<double> omega;
    std::vector<ComplexMatrix> values;
  };

  /// Where a fit has to be right.
  struct FrequencyBand
  {
    /// [rad/s]
    double from, to;
    /// as ReceptanceFit::error; a fit that stays below is good enough
    double aimed_error = 0.005;

    bool holds(const double omega) const { return omega >= from && omega <= to; }
    double middle() const { return (from + to) / 2; }
    bool operator==(const FrequencyBand &other) const
    {
      return from == other.from && to == other.to && aimed_error == other.aimed_error;
    }
  };

  /// A body by poles that stands for receptances over a band.
  struct ReceptanceFit
  {
    /// its rows are those of the receptances
    BodyInContact body;
    /// on each line, the largest |fit_ij - G_ij| / sqrt(|G_ii| |G_jj|) [-]
    std::vector<double> error;
    bool converged = true;
    /// what it took to make it passive, rms over the rms of all lines [-]; and whether it is, by test_passivity()
    double change = 0;
    bool passive = false;

    double worst_error() const;
    /// @param line into `error`, that of the worst
    unsigned int worst_line() const;
  };

  /// Poles near receptances that no poles have: constant hysteretic loss is not causal. They are where roots are sought from
  /// (coupled_bodies/exact_roots.h), no body to move in time: nothing keeps them from giving energy to forces. Every line counts by
  /// its relative error, below 100 Hz less. At rest the body answers as it does elastically, not as its losses continued to 0 Hz:
  /// the difference X moves as slowly as no analysis sees,
  ///
  ///   G(s) = fit(s) + X a / (s + a),     a = 2 pi 0.1 Hz,   X = G_rest - fit(0)
  ///
  /// so that equilibria are those of the elastic body and increments about them those of the fit.
  /// @param at_rest symmetric [m/N]
  /// @param at_once what follows forces at once, positive definite: the direct term keeps a fifth of it at least, so that a
  /// contact stays well posed [m/N]
  ReceptanceFit fit_receptance(const ReceptanceLines &lines, const DenseMatrix &at_rest,
                               const DenseMatrix &at_once, unsigned int n_pairs);

  /// The same as a body to move in time. Lines in the bands and rest count in full, others only as much as keeps the poles off them
  /// from going astray; the residues then change as little as makes the body passive (passive_fit.h), which test_passivity() proves
  /// at all frequencies. What is missing to the elastic compliance moves slowly as far as that takes energy, and else
  /// belongs to the direct term. Bands with a larger error than aimed at count more in the next of at most five fits. `passive` says whether there is such a fit.
  ReceptanceFit passive_receptance_fit(const ReceptanceLines &lines, const std::vector<FrequencyBand> &bands,
                                       const DenseMatrix &at_rest, const DenseMatrix &at_once,
                                       unsigned int n_pairs);
  /// The worst `error` of the lines in each band.
  std::vector<double> errors_in_bands(const ReceptanceFit &fit, const ReceptanceLines &lines,
                                      const std::vector<FrequencyBand> &bands);
} // namespace vibrocontact

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

  /// A body by poles that stands for receptances over a band.
  struct ReceptanceFit
  {
    /// its rows are those of the receptances
    BodyInContact body;
    /// on each line, the largest |fit_ij - G_ij| / sqrt(|G_ii| |G_jj|) [-]
    std::vector<double> error;
    bool converged = true;

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
} // namespace vibrocontact

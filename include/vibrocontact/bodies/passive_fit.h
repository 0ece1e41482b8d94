#pragma once

#include <vibrocontact/bodies/identified_model.h>

namespace vibrocontact
{
  /// What it took to make a fit passive.
  struct PassiveFit
  {
    PoleFit fit;
    /// largest eigenvalue of Im G over |G| at any frequency, before and after [-]
    double gain_before = 0, gain = 0;
    /// rms of the change of all entries over the rms of the entries, on the lines of the data [-]
    double change = 0;
    unsigned int n_rounds = 0;

    bool is_passive() const;
  };

  /// The passive model nearest to a fit of a body at rest: the residues change, the poles stay.
  ///
  /// A model takes energy from every force if no eigenvalue of Im G(omega) (symmetric) is positive at any
  /// frequency, beyond the band as well. On a grid (lines, around the poles, to 1000 times the last line and pole) the
  /// peaks of the largest eigenvalue are sought; each with its vector v gives one linear inequality for the residues,
  ///
  ///   v^T Im (G + dG)(omega) v <= 0,      min sum over lines |weight dG|^2,
  ///
  /// which collect over the rounds until none is violated (Grivet-Talocia & Gustavsen 2015, Passive Macromodeling, ch. 10;
  /// here by the dual problem with non-negative multipliers, whose matrix is the size of the inequalities). Beyond
  /// the last line changes of the mobility count, too, with a tenth of the weight; g(0+) = 0 and real amplitudes are kept if
  /// `rules` have them. The direct term stays in what it is beyond that.
  /// @param data the lines of the fit; @param map symmetric
  PassiveFit nearest_passive_fit(const Spectra &data, const PoleFit &fit, const EntryMap &map,
                                 const ResidueRules &rules);
} // namespace vibrocontact

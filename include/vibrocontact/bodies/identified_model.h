#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/numerics/pole_fit.h>

namespace vibrocontact
{
  /// Where the entries of a matrix of Green's functions stand in a fit: entry[i * n_rows + j] for response i and force j;
  /// of a reciprocal matrix both halves may share entries.
  struct EntryMap
  {
    unsigned int n_rows = 0;
    std::vector<unsigned int> entry;
  };

  struct IdentifiedModel
  {
    BodyInContact model;
    /// largest change of an entry of G by what was left out of the residues, over the largest |G|, both bounded by
    /// sum of |R| / |Re lambda| [-]; zero if nothing was left out
    double truncation = 0;
  };

  /// Poles with left and right shapes from fitted residue matrices.
  ///
  /// The residue matrix of a fitted pole has full rank, unlike that of a simple mode, so that a pole needs as many
  /// states as the matrix has singular values: R = sum sigma u v^H gives right = sqrt(sigma) u, left = sqrt(sigma) v^*.
  /// Singular values are left out, the least important sigma / |Re lambda| first, as long as the bound `truncation` stays
  /// below `tolerance`. By default none is: n_rows states per pole are exact and keep g(0+) = 0 and reciprocity as
  /// fitted; a truncation saves states where many points are close together, and breaks both by its amount.
  IdentifiedModel identified_model(const PoleFit &fit, const EntryMap &map, double tolerance = 0);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/coupled_bodies/rolling_result.h>

namespace vibrocontact
{
  /// Tangential force over what friction bears [-]; 0 without friction.
  double utilisation(double Tx, double Ty, double bound);

  /// Why so few points in contact on the coarse grid say nothing about an error; empty if there are enough.
  std::string too_few_coarse_points(unsigned int contact_points);

  /// What the coarse grid says about a case and all of its contacts: the stated errors of their resultants, or why these are not
  /// known, and, of grids that extrapolate, what the resultants tend to (doc/contact.md, "Creep and grid").
  void take_coarse(const RollingGrids &grids, const RollingResult &coarse, RollingResult &own);

  /// Whether what rolls leaves the first column of its grids open, from which differences start.
  bool starts_open(const PlacedContacts &contacts, const RollingResult &result);
} // namespace vibrocontact

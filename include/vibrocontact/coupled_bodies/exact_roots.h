#pragma once

#include <vibrocontact/coupled_bodies/contact_receptance.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <vector>

namespace vibrocontact
{
  /// How many roots are put into the exact receptance, those with the largest divergence rate first, and all that grow: an
  /// evaluation costs as much as a hundred of the poles'.
  constexpr unsigned int n_exact_roots = 12;
  /// Roots that decay faster, as a share of their angular frequency, stay those of the poles.
  constexpr double least_exact_divergence = -5e-3;

  /// Puts the fitted roots that are nearest to instability in the contact's own equations with HystereticLoss::exact
  /// (contact_receptance.h) in place of the poles, and brings frequency and growth up to date; shapes stay. The poles
  /// turn into the exact receptance in steps, so that no root is mistaken for its neighbour. About each root the receptance is
  /// taken as linear in s, again by its secant until the root stays where it is (some 1e-11 of |s|). Roots named after a pole of such a body are
  /// where its fit has a pole, which the body itself need not have: those that the exact receptance does not have are dropped, the
  /// rest of them as well; those that it has are named after the mode, or the wave of a wheel that turns, with the largest share. Sorts the roots.
  /// @pre constant friction: the contact's own equations know it alone
  /// @throws ConvergenceError if a root of a mode is not found again, or two become one, or one grows above the poles' band
  void make_exact(std::vector<StabilityRoot> &roots, const ContactPair &pair, const CreepScheme &scheme,
                  const RollingEquilibrium &equilibrium, const HystereticLoss &loss);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/coupled_bodies/hysteretic_loss.h>
#include <vibrocontact/coupled_bodies/linearised_contact.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>

#include <vector>

namespace vibrocontact
{
  /// All roots of the reduced pair about an equilibrium; none is missing.
  std::vector<StabilityRoot> all_roots(const ContactPair &pair, const CreepScheme &scheme,
                                       const RollingEquilibrium &about, const LinearisationOptions &options,
                                       const HystereticLoss *loss);
} // namespace vibrocontact

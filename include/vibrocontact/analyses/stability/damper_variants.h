#pragma once

#include <vibrocontact/coupled_bodies/body_roots.h>

#include <memory>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// The roots of one scene with many dampers on body 1 in turn: its equilibrium, which no damper changes, its wheel without
  /// dampers and what all else answers are made once (coupled_bodies/body_roots.h).
  class DamperVariants
  {
  public:
    /// @param pair, loss of the scene without dampers @param section of body 1
    DamperVariants(const ContactPair &pair, const HystereticLoss &loss, const CreepScheme &scheme,
                   const RollingEquilibrium &equilibrium, std::shared_ptr<const RevolvedShapes> section);

    /// With the dampers that the body's parameters list.
    std::vector<StabilityRoot> roots(const BodyParameters &body);
    /// Makes what answers beside the wheel where roots of some variants lie, shared out over the ranks; roots() makes what is
    /// left. Collective.
    void prepare(const std::vector<const BodyParameters *> &bodies, MPI_Comm communicator);
    const BareBody &bare_body() const { return bare; }

  private:
    /// the body with its layers, and the masses on it
    std::pair<BareBody, std::vector<AttachedMass>> damped(const BodyParameters &body) const;

    const std::shared_ptr<const RevolvedShapes> section;
    /// by poles, and exact; one if no body has an exact receptance
    std::shared_ptr<AnswerOfRest> nearly, rest;
    BareBody bare;
  };
} // namespace vibrocontact

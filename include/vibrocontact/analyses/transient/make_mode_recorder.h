#pragma once

#include <vibrocontact/analyses/transient/mode_recorder.h>
#include <vibrocontact/marching/hub_motion.h>
#include <vibrocontact/run/parameters.h>

#include <memory>
#include <string>

namespace vibrocontact
{
  /// Who follows the modes of the contact through a transient (Transient/Signals/Mode amplitudes): those of the
  /// linearisation about the equilibrium that it starts from.
  /// @return null, and the reason in the log, if none is wanted or there is no such equilibrium: a start of
  /// undeformed bodies, contact points with mass, a penalty law, no modes, too many of them, or a contact that
  /// cannot be linearised
  std::unique_ptr<ModeRecorder> mode_recorder(const Parameters &parameters, const ContactPair &held,
                                              const HubMotion &hub, const std::string &folder);
} // namespace vibrocontact

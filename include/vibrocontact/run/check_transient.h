#pragma once

#include <vibrocontact/run/parameters.h>

namespace vibrocontact
{
  /// What sections Transient and Rolling ask for together and of the bodies, before anything is made.
  /// @throws InputError
  void check_transient(const Parameters &parameters);

  /// Refuses a load over time in a march from the end of section Loading. @param source what gives the load; empty: nothing
  void check_load_over_time(const TransientParameters &transient, const std::string &source);

  /// Whether the transient moves contact points with mass: finite elements other than those of a bar with a massless contact
  /// node, or bodies all of whose flexibility has mass (an oscillator) where nothing else yields.
  bool contact_points_have_mass(const Parameters &parameters);

  /// Whether a body of a contact yields there beside its modes.
  bool a_body_yields_in(const Parameters &parameters, unsigned int contact);

  /// Whether one does in any contact.
  bool yields_beside_modes(const Parameters &parameters);
} // namespace vibrocontact

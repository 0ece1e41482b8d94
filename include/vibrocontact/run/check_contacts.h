#pragma once

#include <vibrocontact/run/parameters.h>

#include <map>
#include <string>

namespace vibrocontact
{
  /// Sections of the analyses that run on another model than the reduced one, and that model.
  std::map<std::string, std::string> unreduced_models(const Parameters &parameters);

  /// Whether an analysis moves body 1 over body 2 as section Rolling says.
  bool rolls_or_slides(const Scene &scene);

  /// What contacts join and where, against the bodies of the scene and the analyses. @throws InputError
  void check_contacts(const Parameters &parameters);

  /// What the contact's own equations F(s) x = 0 do not know, by which roots are followed and differentiated.
  /// @param what asks for them @throws InputError
  void check_own_equations(const Parameters &parameters, const std::string &what);

  /// A body that rolls does so at the speed of its road. @throws InputError
  void check_speed_of_road(const BodyParameters &body, const RoadParameters &road);
} // namespace vibrocontact

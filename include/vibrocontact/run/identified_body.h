#pragma once

#include <vibrocontact/analyses/identification/identification.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/parameters.h>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A body of type `identified` as poles, without its tread.
  struct IdentifiedPoles
  {
    /// of its points: name_direction
    std::vector<std::string> labels;
    /// both ways of each pair of points are known
    bool both_ways = false;
    BodyInContact poles;
  };

  /// From its Poles file, or the first fit that section Identification asks for.
  /// @param contact_step the fit is repaired if contact cannot be solved with it at this step; 0: it is not [s]
  /// @throws InputError; also for an inverse transform, which has no poles
  IdentifiedPoles identified_poles(const Parameters &parameters, const std::optional<MeasuredData> &measured,
                                   const BodyParameters &body, double contact_step);

  /// The body in contact, with the compliance of a tread under each point, usable at such a step of time [s].
  /// @throws InputError
  BodyInContact identified_body(const Parameters &parameters, const std::optional<MeasuredData> &measured,
                                const BodyParameters &body, double contact_step);

  /// A fit in the log, with its warnings.
  void print_fit(const Identification &fit);

  /// That none of the fits came to Target error.
  std::string missed_target(const Identification &fit, const IdentificationParameters &own);
} // namespace vibrocontact

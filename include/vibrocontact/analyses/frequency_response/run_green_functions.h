#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/parameters.h>

#include <string>

namespace vibrocontact
{
  /// The analysis `frequency response` of a body without mesh that is known by its Green's functions: oscillator, analytic
  /// ring, identified body. Its contact points are called A, B, C, ...; z is radially inward (up at the bottom), x along
  /// the circle, forward.
  ///
  /// Writes frequency_response_<body>.csv (Method modal: from the poles and the residual, what contact runs with; direct:
  /// rings, by inversion of the 2 x 2 system of each order), impulse_response_<body>.csv, poles_<body>.csv;
  /// frequency_response_<body>.csv and impulse_response_<body>.csv are data for the analysis identification, poles_<body>.csv
  /// for Identified/Poles file. Collective.
  nlohmann::ordered_json run_green_functions(const Parameters &parameters,
                                             const std::optional<MeasuredData> &measured,
                                             const BodyParameters &body, const std::string &folder,
                                             nlohmann::ordered_json &tables);
} // namespace vibrocontact

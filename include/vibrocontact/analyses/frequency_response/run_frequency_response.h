#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <string>

namespace vibrocontact
{
  /// The analysis `frequency response` of the bodies asked for, with its output: results and per body
  /// frequency_response_<body>.csv, ..._time_domain.csv, ..._check.csv. What needs the finite elements (modal
  /// loss, static answers, direct solutions) is kept in the cache. Every rank computes, rank 0 writes.
  /// Collective.
  void run_frequency_response(const Parameters &parameters, const MeshedBodies &bodies,
                              const std::optional<MeasuredData> &measured, const std::string &folder,
                              Results &results);

  /// Whether the points lie on the bodies asked for, whose matrices are made for it. Collective. @throws InputError
  void check_response_points(const Parameters &parameters, const MeshedBodies &bodies);

  /// Its row of the table of analyses.
  Analysis frequency_response_analysis();
} // namespace vibrocontact

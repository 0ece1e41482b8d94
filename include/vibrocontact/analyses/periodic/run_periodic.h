#pragma once

#include <vibrocontact/analyses/periodic/make_forced_body.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>

#include <string>

namespace vibrocontact
{
  /// The analysis `periodic` of body 1, as forced_body() makes it, against a stop, with its output: analyses.periodic[]
  /// and a table periodic_<k>.csv per solution; what did not converge is kept and marked. Every rank computes, rank 0
  /// writes. Collective.
  void run_periodic(const Parameters &parameters, const ForcedBody &body, const std::string &folder,
                    Results &results);

  /// Its row of the table of analyses.
  Analysis periodic_analysis();
} // namespace vibrocontact

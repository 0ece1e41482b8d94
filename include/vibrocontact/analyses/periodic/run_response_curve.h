#pragma once

#include <vibrocontact/analyses/periodic/periodic.h>
#include <vibrocontact/output/results.h>

#include <memory>
#include <string>

namespace vibrocontact
{
  /// Response curves of section Periodic/Continuation: analyses.response with its variants, response.csv and response_<k>.csv.
  /// Every rank computes, rank 0 writes.
  void run_response_curve(const PeriodicParameters &periodic, const ForcedBody &body,
                          const PointLaws<NormalLaw> &law, const std::string &law_name,
                          const std::vector<double> &friction, const std::string &folder, Results &results);
} // namespace vibrocontact

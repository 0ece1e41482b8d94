#pragma once

#include <vibrocontact/run/analysis.h>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The analysis `identification` with its output: results and identification_data.csv, per fit
  /// identification_poles_<k>.csv, identification_fit_<k>.csv and .uff, identification_chart.csv. Every rank computes the
  /// same, rank 0 writes. Collective.
  void run_identification(const Parameters &parameters, const MeasuredData &measured,
                          const std::string &folder, Results &results);

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

  /// Its row of the table of analyses.
  Analysis identification_analysis();
} // namespace vibrocontact

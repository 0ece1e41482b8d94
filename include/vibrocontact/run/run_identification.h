#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/parameters.h>

#include <string>

namespace vibrocontact
{
  /// Reads the data of section Identification on all ranks. @throws InputError with file and line
  FrequencyData identification_data(const IdentificationParameters &parameters);

  /// Reads and checks the data if the analysis or a body needs them, before anything is written.
  /// @throws InputError, also if a body gives another number of positions than the data have points
  void check_identification(const Parameters &parameters);

  /// The analysis `identification` with its output: results and identification_data.csv, per fit
  /// identification_poles_<k>.csv, identification_fit_<k>.csv and .uff, identification_chart.csv. Every rank computes the
  /// same, rank 0 writes. Collective.
  void run_identification(const Parameters &parameters, const std::string &folder, Results &results);

  /// The model of a body of type `identified`: the first fit that section Identification asks for, which has to be
  /// usable in contact at this step, and the compliance of a tread under each point [m/N].
  /// @throws InputError
  PoleModel identified_body(const IdentificationParameters &parameters, double step, double tread_compliance,
                            const std::string &body);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/receptances/data_passivity.h>
#include <vibrocontact/receptances/pole_file.h>
#include <vibrocontact/run/parameters.h>

#include <optional>

namespace vibrocontact
{
  /// The data of section Identification.
  struct MeasuredData
  {
    FrequencyData data;
    DataJudgement judgement;
  };

  /// Reads and checks the data on all ranks if the analysis or a body needs them (Parameters::has_identification()),
  /// before anything is written.
  /// @throws InputError with file and line, also if a body gives another number of positions than the data have points
  std::optional<MeasuredData> measured_data(const Parameters &parameters);

  /// The Poles file of a body of type `identified`. Collective. @throws InputError
  PoleFile pole_file(const BodyParameters &body);
} // namespace vibrocontact

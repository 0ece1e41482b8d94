#pragma once

#include <vibrocontact/receptances/frequency_data.h>

namespace vibrocontact
{
  /// Universal file, dataset 58 (functions at nodal degrees of freedom; SDRC, University of Cincinnati): one
  /// dataset per entry, with response and reference entity, node and direction (1, 2, 3: x, y, z, negative: against it).
  /// Read: ASCII and binary (58b, IEEE, either byte order); real and complex, single and double, even and uneven abscissa;
  /// frequency responses (function type 4; displacement, velocity or acceleration per force) and impulse responses
  /// (type 1, real, over time in equal steps from 0), or either as type 0. Functions of other types (coherence,
  /// spectra) are left aside and counted; other datasets are skipped, units other than SI (dataset 164) refused.
  ///
  /// A point is called by its entity, or by its node if the entity is NONE or empty; direction _x, _y, _z or
  /// _-x, ..., none if scalar. Values as they stand there, see read_frequency_data().
  /// @throws InputError with file and line
  FrequencyData read_uff58(const std::string &file_name, const std::string &bytes);

  /// As double precision complex: 58b holds every bit of the values; ASCII has the format's 13 digits (E20.12), and
  /// what is read from it is written again with the same bytes. Frequencies at equal steps that
  /// 13 characters can say (E13.5 fields) come back bit by bit in both; others go as an uneven abscissa, which the
  /// format keeps in 6 digits (ASCII) or single precision (58b).
  /// @param title first line of each dataset
  std::string uff58_text(const FrequencyData &data, const std::string &title, bool binary);
} // namespace vibrocontact

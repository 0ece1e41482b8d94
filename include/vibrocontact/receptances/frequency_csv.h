#pragma once

#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/receptances/frequency_data.h>

#include <optional>
#include <utility>

namespace vibrocontact
{
  /// Columns frequency_Hz and <response>_<reference>_real_<unit>, ..._imag_<unit> as the analysis `frequency response`
  /// writes them, unit m_N (receptance), m_Ns (mobility) or m_Ns2 (accelerance); or time_s and
  /// <response>_<reference>_m_Ns, impulse responses. Reads only, values as they stand there, see
  /// read_frequency_data().
  FrequencyData read_frequency_csv(const CsvTable &table);

  /// Splits <response>_<reference>, what names of columns say before their units: points are those for which
  /// <point>_<point> is among them. @throws InputError naming the one that is no pair of such points
  std::vector<std::pair<std::string, std::string>> split_pairs(const CsvTable &table,
                                                               const std::vector<std::string> &pairs);
  /// What stands before `end`, if the name ends so.
  std::optional<std::string> without_end(const std::string &name, const std::string &end);

  /// A table with frequency_Hz, then <response>_<reference>_real_m_N and _imag_m_N per entry, 17 digits: read back bit
  /// by bit.
  std::string frequency_csv(const FrequencyData &data, const std::vector<std::string> &comments);
} // namespace vibrocontact

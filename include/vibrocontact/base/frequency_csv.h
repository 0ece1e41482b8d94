#pragma once

#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/frequency_data.h>

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

  /// The times of impulse responses have to go in equal steps from t = 0. @param rounding of the times in the file,
  /// relative. @return the step [s]
  /// @throws InputError naming the time, and the line if there are lines
  double equal_time_step(const std::string &source, const std::vector<double> &time, double rounding,
                         const std::vector<unsigned int> &lines);

  /// Receptance at multiples of 1 / duration of an impulse response sampled at equal steps from t = 0 on, by trapezoids
  /// (a jump at 0+ counts half) and FFT; up to half the sampling rate.
  void transform_to_frequency(FrequencyData &data, double step);

  /// Receptance from mobility (power 1) or accelerance (power 2): divides by (j omega)^power.
  /// @throws InputError if there is a line at 0 Hz
  void integrate_in_frequency(FrequencyData &data, unsigned int entry, unsigned int power);
} // namespace vibrocontact

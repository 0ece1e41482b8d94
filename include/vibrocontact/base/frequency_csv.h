#pragma once

#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/frequency_data.h>

namespace vibrocontact
{
  /// Columns frequency_Hz and <response>_<reference>_real_<unit>, ..._imag_<unit> as the analysis `frequency response`
  /// writes them, unit m_N (receptance), m_Ns (mobility) or m_Ns2 (accelerance); or time_s and
  /// <response>_<reference>_m_Ns, impulse responses. Reads only, see read_frequency_data().
  FrequencyData read_frequency_csv(const CsvTable &table);

  /// Receptance at multiples of 1 / duration of an impulse response sampled at equal steps from t = 0 on, by trapezoids
  /// (a jump at 0+ counts half) and FFT; up to half the sampling rate.
  void transform_to_frequency(FrequencyData &data, double step);

  /// Receptance from mobility (power 1) or accelerance (power 2): divides by (j omega)^power.
  /// @throws InputError if there is a line at 0 Hz
  void integrate_in_frequency(FrequencyData &data, unsigned int entry, unsigned int power);
} // namespace vibrocontact

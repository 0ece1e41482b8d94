#pragma once

#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/numerics/pole_fit.h>
#include <vibrocontact/receptances/frequency_data.h>

namespace vibrocontact
{
  /// Poles and residues as a table has them.
  struct PoleFile
  {
    /// the points and the pairs of them; no frequencies, no values
    FrequencyData names;
    /// residues in the order of names.entries
    PoleFit fit;
  };

  /// Poles: frequency and damping ratio, lambda, residue of every entry, and its constant if there is one. 17 digits:
  /// read_poles() reads every bit back.
  /// @param names labels and entries, its values are not looked at; @param title the table's first comment
  Table poles_table(const PoleFit &fit, const FrequencyData &names, const std::string &title);

  /// Reads what poles_table() writes, every bit: columns pole_real_1_s, pole_imag_1_s,
  /// <response>_<force>_residue_real_m_Ns and ..._residue_imag_m_Ns; <response>_<force>_direct_m_N, the same
  /// number in every line, is optional; frequency_Hz and damping_ratio are not looked at.
  /// @throws InputError with file and line: a pole that grows or does not decay, one that is given twice, a pair of points that is missing or there
  /// twice, another column
  PoleFile read_poles(const CsvTable &table);
} // namespace vibrocontact

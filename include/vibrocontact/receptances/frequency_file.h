#pragma once

#include <vibrocontact/receptances/frequency_data.h>

#include <string>

namespace vibrocontact
{
  /// How data are to be read.
  struct DataRules
  {
    /// the body turns, G_ij and G_ji differ
    bool rolling = false;
    /// lines outside are left out, upper 0: none above [Hz]
    double lower = 0, upper = 0;
    /// the responses lag behind by it: values are multiplied by e^{+j omega delay} [s]
    double delay = 0;
  };

  /// Reads a table (CSV with frequency_Hz or time_s) or a universal file (datasets 58 and 58b, names ending in .uff or
  /// .unv) and checks it: axis ascending and without a hole, matrix square, each entry there (one of two
  /// reciprocal ones is enough unless `rolling`), reciprocal unless `rolling`. Of two reciprocal entries the mean is kept.
  ///
  /// - A direction against an axis (label ..._-z) is turned into the axis, with the sign of its entries: all points
  ///   then count displacements and forces the same way.
  /// - Reciprocity is judged in the quantity of the file: noise that is even in accelerances is none in
  ///   receptances, where the lowest lines would count alone.
  /// - Velocities and accelerations become displacements after the band is cut: a line at 0 Hz may be cut off.
  /// @param bytes of the file
  /// @throws InputError with file and line
  FrequencyData read_frequency_data(const std::string &file_name, const std::string &bytes,
                                    const DataRules &rules);
} // namespace vibrocontact

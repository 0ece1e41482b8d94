#pragma once

#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Receptances between some points as a file holds them: displacement of a response per unit force
  /// e^{j omega t} at a reference.
  struct FrequencyData
  {
    struct Entry
    {
      /// into labels
      unsigned int response = 0, reference = 0;
      /// one per frequency [m/N]
      std::vector<std::complex<double>> values;
      /// the file gives 0 displacements, 1 velocities, 2 accelerations per force; values are displacements once
      /// read_frequency_data() is through
      unsigned int derivative = 0;
    };

    std::string file_name;
    /// point and direction such as tread_z; the rows and columns of the matrix
    std::vector<std::string> labels;
    /// ascending, not negative, common to all entries [Hz]
    std::vector<double> frequency;
    std::vector<Entry> entries;
    /// functions of the file left aside: coherences, spectra and others that are no responses to forces
    unsigned int n_skipped = 0;

    const Entry *find(unsigned int response, unsigned int reference) const;
    /// index of a label, which is added if it is new
    unsigned int label_index(const std::string &label);
  };

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

  /// The checks on an axis in Hz or s: at least 3 values, finite, not negative, ascending; a step that stands out
  /// of equal (or geometric) steps is a gap.
  /// @param unit Hz or s; @param lines of the file, one per value, or empty
  void check_axis(const std::string &file_name, const std::vector<double> &axis, const std::string &unit,
                  const std::vector<unsigned int> &lines);

  /// A table with frequency_Hz, then <response>_<reference>_real_m_N and _imag_m_N per entry, 17 digits: read back bit
  /// by bit.
  std::string frequency_csv(const FrequencyData &data, const std::vector<std::string> &comments);
} // namespace vibrocontact

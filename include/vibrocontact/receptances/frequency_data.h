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
      /// read_frequency_data() is through (receptances/frequency_file.h)
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
    /// impulse responses that do not begin with a blow at t = 0, as their samples show it (receptances/sampled_response.h)
    unsigned int n_without_blow = 0;

    const Entry *find(unsigned int response, unsigned int reference) const;
    /// index of a label, which is added if it is new
    unsigned int label_index(const std::string &label);
  };

  /// The checks on an axis in Hz or s: at least 3 values, finite, not negative, ascending; a step that stands out
  /// of equal (or geometric) steps is a gap.
  /// @param unit Hz or s; @param lines of the file, one per value, or empty
  void check_axis(const std::string &file_name, const std::vector<double> &axis, const std::string &unit,
                  const std::vector<unsigned int> &lines);

  /// The times of impulse responses have to go in equal steps from t = 0. @param rounding of the times in the file,
  /// relative. @return the step [s]
  /// @throws InputError naming the time, and the line if there are lines
  double equal_time_step(const std::string &source, const std::vector<double> &time, double rounding,
                         const std::vector<unsigned int> &lines);

  /// Receptance from mobility (power 1) or accelerance (power 2): divides by (j omega)^power.
  /// @throws InputError if there is a line at 0 Hz
  void integrate_in_frequency(FrequencyData &data, unsigned int entry, unsigned int power);

  /// Response and reference of an entry, as columns of tables name it: response_reference.
  std::string entry_name(const FrequencyData &data, unsigned int entry);
} // namespace vibrocontact

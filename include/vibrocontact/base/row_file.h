#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Rows of numbers that a long run adds one by one, to be found in the end as one array per column in an
  /// HDF5 file. In between they are appended to a plain file (doubles, row by row), so that neither memory
  /// nor the work of a checkpoint grows with the run (only finish() holds all in memory), and a killed run has all
  /// of them:
  ///
  ///   add, add, ..., flush          a checkpoint: size() rows are in the file and count
  ///   add, add, (killed)            what came later is cut off after resume(size)
  ///
  /// On one rank.
  class RowFile
  {
  public:
    /// @param stem of both files, `stem`.rows and `stem`.h5; @param columns names with units
    RowFile(const std::string &stem, const std::vector<std::string> &columns);

    void add(const std::vector<double> &row);
    unsigned long size() const { return n_written + buffer.size() / columns.size(); }
    /// Brings all rows into the file. @throws OutputError
    void flush();
    /// Before the first row: goes on behind the first `n` rows of an earlier run.
    /// @throws InputError if they are not there
    void resume(unsigned long n);
    /// Makes `stem`.h5 of all rows; the plain file goes if the run has come to its end. @throws OutputError
    void finish(bool at_the_end);

  private:
    std::vector<double> column(unsigned int k) const;

    const std::string stem;
    const std::vector<std::string> columns;
    /// rows in the file, and those that follow
    unsigned long n_written = 0;
    std::vector<double> buffer;
    std::ofstream file;
  };
} // namespace vibrocontact

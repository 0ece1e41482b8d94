#pragma once

#include <vibrocontact/base/checkpoint_file.h>
#include <vibrocontact/base/checksum.h>
#include <vibrocontact/base/exceptions.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Rows, or samples of a sound, that a checkpoint counts are not there as they were written.
  class RowsLost : public InputError
  {
  public:
    using InputError::InputError;
  };

  /// Rows of numbers that a long run adds one by one, to be found in the end as one array per column in an
  /// HDF5 file. In between they are appended to a plain file (doubles, row by row), so that neither memory
  /// nor the work of a checkpoint grows with the run (only finish() holds all in memory), and a killed run has all
  /// of them:
  ///
  ///   add, add, ..., flush          a checkpoint: size() rows are in the file and count
  ///   add, add, (killed)            what came later is cut off after resume
  ///
  /// The plain file is a chain of blocks, one per flush,
  ///
  ///   rows in it | sum over the sum of the block before, that number and the data | data
  ///
  /// and a checkpoint keeps the last sum: rows that are damaged, or not those that this checkpoint counted, are
  /// refused, never taken for results.
  ///
  /// On one rank.
  class RowFile
  {
  public:
    /// @param stem of both files, `stem`.rows and `stem`.h5; @param columns names with units
    RowFile(const std::string &stem, const std::vector<std::string> &columns);

    void add(const std::vector<double> &row);
    unsigned long size() const { return written.rows + buffer.size() / columns.size(); }
    /// Under a name in a checkpoint: brings all rows into the file and counts them, or, before the first row, goes
    /// on behind those that an earlier run counted.
    /// @throws OutputError, RowsLost
    void exchange(const std::string &name, CheckpointFile &checkpoint);
    /// Makes `stem`.h5 of all rows; the plain file goes if the run has come to its end. @throws OutputError
    void finish(bool at_the_end);

  private:
    /// How far the plain file has been gone through: rows, bytes, sum.
    struct Place
    {
      unsigned long rows = 0;
      std::uintmax_t bytes = 0;
      unsigned long long sum = Checksum().value();
    };

    void flush();
    void resume(unsigned long n, unsigned long long sum);
    /// The first n rows from `stem`.h5 into the buffer, if they are there and whole.
    bool take_columns(unsigned long n);
    /// The first n rows, block by block, up to the first block that is not whole.
    Place read_blocks(unsigned long n, const std::function<void(const std::vector<double> &)> &use) const;
    std::vector<double> column(unsigned int k) const;

    const std::string stem;
    const std::vector<std::string> columns;
    /// end of what is in the file, and the rows that follow
    Place written;
    std::vector<double> buffer;
    std::ofstream file;
  };

  /// Rows in `stem`.h5 as a table. @param columns of the table; in the file all but `time_s` have the prefix
  /// @throws OutputError
  void write_rows_as_table(const std::string &stem, const std::vector<std::string> &columns,
                           const std::string &prefix, const std::vector<std::string> &notes,
                           const std::string &table_name);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/base/dense.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Named arrays and texts in an HDF5 file, serially, by whoever calls (rank 0). HDF5's C interface is used
  /// because deal.II's wrappers check nothing in release mode.
  ///
  /// The writer fills `name`.part and renames it when it is complete: a file appears whole or not at all. A
  /// checksum of all that was written is kept in the attribute `checksum` of the file's root.
  class Hdf5Writer
  {
  public:
    /// @throws OutputError if the file cannot be written
    explicit Hdf5Writer(const std::string &file_name);
    ~Hdf5Writer();
    Hdf5Writer(const Hdf5Writer &) = delete;
    Hdf5Writer &operator=(const Hdf5Writer &) = delete;

    void write(const std::string &name, const std::vector<double> &values);
    void write(const std::string &name, const DenseMatrix &matrix);
    void write(const std::string &name, const std::string &text);
    /// Closes the file and gives it its name.
    void finish();

  private:
    std::string file_name;
    long long file = -1;
    unsigned long long checksum;
  };

  /// Reads what Hdf5Writer wrote.
  class Hdf5Reader
  {
  public:
    /// @throws std::runtime_error saying what is wrong with the file
    explicit Hdf5Reader(const std::string &file_name);
    ~Hdf5Reader();
    Hdf5Reader(const Hdf5Reader &) = delete;
    Hdf5Reader &operator=(const Hdf5Reader &) = delete;

    std::vector<double> vector(const std::string &name);
    DenseMatrix matrix(const std::string &name);
    std::string text(const std::string &name);
    /// Whether everything read, in the order written, is what was written. @throws std::runtime_error if not
    void verify() const;

  private:
    std::string file_name;
    long long file = -1;
    unsigned long long checksum;
  };
} // namespace vibrocontact

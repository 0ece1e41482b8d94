#pragma once

#include <vibrocontact/base/checksum.h>
#include <vibrocontact/base/dense.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace vibrocontact
{
  /// A number of a file as what it is to be: a count (below 2^53), a flag, or a number.
  /// @throws InputError if the type has no such value
  template <typename T>
  T number_as(const double value)
  {
    if constexpr (!std::is_floating_point_v<T>)
      if (!(value >= static_cast<double>(std::numeric_limits<T>::min()) &&
            value <= std::min(9007199254740992., static_cast<double>(std::numeric_limits<T>::max()))))
        throw InputError("A count in a file is " + std::to_string(value) +
                         ", which is none: the file is damaged; write it anew.");
    return static_cast<T>(value);
  }

  /// How the numbers of a set are kept in a file.
  struct Hdf5Storage
  {
    /// four bytes per number instead of eight
    bool single_precision = false;
    /// sets of more than a thousand numbers are compressed without loss
    bool compressed = false;
  };

  /// Named arrays and texts in an HDF5 file, serially, by whoever calls (rank 0). HDF5's C interface is used
  /// because deal.II's wrappers check nothing in release mode. Names may be paths (`/group/set`), groups are
  /// made as needed.
  ///
  /// The writer fills a file in memory, since HDF5 cannot close a file that the disk refuses, and hands it to
  /// write_file() when it is complete: a file appears whole or not at all. A checksum of all that was written is
  /// kept in the attribute `checksum` of the file's root.
  class Hdf5Writer
  {
  public:
    /// @throws OutputError if there is no memory for the file; so do all members
    explicit Hdf5Writer(const std::string &file_name);
    ~Hdf5Writer();
    Hdf5Writer(const Hdf5Writer &) = delete;
    Hdf5Writer &operator=(const Hdf5Writer &) = delete;

    void write(const std::string &name, const std::vector<double> &values, const Hdf5Storage &storage = {});
    void write(const std::string &name, const std::vector<int> &values, const Hdf5Storage &storage = {});
    /// sets of one number
    void write(const std::string &name, double value);
    void write(const std::string &name, int value);
    void write(const std::string &name, const DenseMatrix &matrix);
    void write(const std::string &name, const std::string &text);
    /// Writes the file. @throws OutputError if that is impossible, see write_file()
    /// @param sealed the sum over all its bytes stands behind them, see Hdf5Reader::check_seal()
    void finish(bool sealed = false);

  private:
    std::string file_name;
    long long file = -1;
    Checksum checksum;
  };

  /// Reads what Hdf5Writer or another program wrote. A set's shape and kind of number do not matter: it is
  /// converted to what is asked for.
  class Hdf5Reader
  {
  public:
    /// @throws InputError if the file is missing or no HDF5 file; so do all members for what they do not find
    explicit Hdf5Reader(const std::string &file_name);
    ~Hdf5Reader();
    Hdf5Reader(const Hdf5Reader &) = delete;
    Hdf5Reader &operator=(const Hdf5Reader &) = delete;

    /// Before a file is opened: whether each of its bytes is as it was written, those of HDF5 itself included, which
    /// does not survive every damage. @throws InputError if not, or if it was written without a seal
    static void check_seal(const std::string &file_name);
    bool has(const std::string &name) const;
    /// @param size number of values that there must be, 0 for any
    std::vector<double> numbers(const std::string &name, std::size_t size = 0);
    std::vector<int> integers(const std::string &name, std::size_t size = 0);
    double number(const std::string &name) { return numbers(name, 1).front(); }
    int integer(const std::string &name) { return integers(name, 1).front(); }
    DenseMatrix matrix(const std::string &name);
    std::string text(const std::string &name);
    /// Whether everything read, in the order written, is what was written. @throws InputError if not
    void verify() const;

  private:
    std::string file_name;
    long long file = -1;
    Checksum checksum;
  };
} // namespace vibrocontact

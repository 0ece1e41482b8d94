#pragma once

#include <string>

namespace readers
{
  /// An HDF5 file from the bytes of an input. The first byte chooses:
  ///
  ///   even: the others are the file as it stands, sealed (Hdf5Reader::check_seal) if it is a multiple of 4
  ///   odd:  a good file with edits to its sets, three bytes and what follows them each: which set, what becomes of it
  ///         (left out, numbers, whole numbers, a matrix, a text, a group), of which size; sealed
  ///
  /// HDF5 itself is no reader of the project and seldom survives what the first kind does to it; the second kind reaches
  /// what is done with sets that are there but are not as they should be.
  /// @param good a file that the reader takes
  std::string hdf5_bytes(const std::string &input, const std::string &good, bool sealed);

  std::string content_of(const std::string &file_name);
} // namespace readers

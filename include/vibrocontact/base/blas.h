#pragma once

#include <string>

namespace vibrocontact
{
  /// The linear algebra library that the program found at run time: with Debian's reference BLAS
  /// factorisations take 8 times longer than with OpenBLAS, and several BLAS threads per rank slow each other
  /// down.

  /// One BLAS thread per rank from now on, if the library can be told.
  void set_one_blas_thread();

  /// The file that serves dgemm, links followed, e.g. /usr/lib/x86_64-linux-gnu/openblas-pthread/libblas.so.3
  std::string loaded_blas();

  /// Whether such a file is the reference BLAS, by its name: how fast it is now depends on what else runs.
  bool is_reference_blas(const std::string &library);

  /// What to do about the reference BLAS: choose a faster one that stands beside it, or install one.
  std::string faster_blas_advice(const std::string &library);
} // namespace vibrocontact

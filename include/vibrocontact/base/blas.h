#pragma once

#include <string>

namespace vibrocontact
{
  /// The linear algebra library that the program found at run time: with Debian's reference BLAS
  /// factorisations take 8 times longer than with OpenBLAS, and several BLAS threads per rank slow each other
  /// down.
  struct Blas
  {
    /// file that serves dgemm, e.g. /usr/lib/x86_64-linux-gnu/openblas-pthread/libblas.so.3
    std::string library;
    /// speed of a product of two matrices of size 384 [Gflop/s], the best of some trials
    double gflops = 0;
    bool is_slow() const { return gflops < 8; }
  };

  /// One BLAS thread per rank from now on, if the library can be told.
  void set_one_blas_thread();

  /// Takes about 10 ms (0.2 s with the reference BLAS).
  Blas measure_blas();
} // namespace vibrocontact

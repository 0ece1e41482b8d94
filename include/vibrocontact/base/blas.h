#pragma once

#include <string>

namespace vibrocontact
{
  /// The linear algebra library that the program found at run time: with Debian's reference BLAS
  /// factorisations take 8 times longer than with OpenBLAS, and several BLAS threads per rank slow each other
  /// down.

  /// From now on: one BLAS thread per rank, and OpenBLAS' kernels for the registers of this processor. Of a processor that it
  /// does not know OpenBLAS takes the kernels of one of 2004 (0.3.21, which Debian 12 has: all of Intel's since 2023), which
  /// are up to ten times slower. What the environment says by OPENBLAS_CORETYPE stands.
  void prepare_blas();

  /// OpenBLAS' name of the kernels in use, e.g. SkylakeX; empty of other libraries.
  std::string blas_kernels();

  /// Kernels to take in place of some, on a processor that has AVX2 or AVX-512; empty if those are right.
  std::string better_kernels(const std::string &kernels, bool has_avx2, bool has_avx512);

  /// The file that serves dgemm, links followed, e.g. /usr/lib/x86_64-linux-gnu/openblas-pthread/libblas.so.3
  std::string loaded_blas();

  /// Whether such a file is the reference BLAS, by its name: how fast it is now depends on what else runs.
  bool is_reference_blas(const std::string &library);

  /// What to do about the reference BLAS: choose a faster one that stands beside it, or install one.
  std::string faster_blas_advice(const std::string &library);
} // namespace vibrocontact

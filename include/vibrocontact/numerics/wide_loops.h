#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace vibrocontact
{
  /// Inner loops of propagators and of contacts in time, compiled for AVX-512, for AVX2 and for any x86-64; which one runs is
  /// chosen when the program starts. Arrays whose length is called padded have it in multiples of wide_width,
  /// with zeros behind their end.
  constexpr std::size_t wide_width = 8;

  inline std::size_t padded(const std::size_t n)
  {
    return (n + wide_width - 1) / wide_width * wide_width;
  }

  /// the same of numbers in single precision
  constexpr std::size_t wide_width_single = 16;

  inline std::size_t padded_single(const std::size_t n)
  {
    return (n + wide_width_single - 1) / wide_width_single * wide_width_single;
  }

  /// Memory on cache lines, which wide registers read in one go.
  template <typename T>
  struct AlignedAllocator
  {
    using value_type = T;
    static constexpr std::align_val_t line{64};
    AlignedAllocator() = default;
    template <typename U>
    AlignedAllocator(const AlignedAllocator<U> &)
    {
    }
    T *allocate(const std::size_t n) { return static_cast<T *>(::operator new(n * sizeof(T), line)); }
    void deallocate(T *p, std::size_t) { ::operator delete(p, line); }
    bool operator==(const AlignedAllocator &) const { return true; }
    bool operator!=(const AlignedAllocator &) const { return false; }
  };
  using AlignedVector = std::vector<double, AlignedAllocator<double>>;
  using AlignedSingleVector = std::vector<float, AlignedAllocator<float>>;

  /// avx512, avx2 or sse2: what this machine runs
  const char *wide_loops_name();

  /// y_i = sum over k < n of c_k x_i^k, m of them, any m
  void wide_polynomial(const double *c, std::size_t n, const double *x, double *y, std::size_t m);

  /// sum of a_i b_i, any n and any alignment
  double wide_dot(const double *a, const double *b, std::size_t n);

  /// y += sum over the listed columns of factor_j * column_j
  /// @param columns column j begins at columns + j * n; @param n padded length
  void wide_add_columns(double *y, const double *columns, std::size_t n, const unsigned int *listed,
                        const double *factors, std::size_t n_listed);

  /// y += sum of factor_j * column_j over all columns, column j at columns + j * stride; @param n padded length
  void wide_add_columns(double *y, const double *columns, std::size_t n, std::size_t stride,
                        const double *factors, std::size_t n_columns);

  /// y += sum over the listed columns of factor_j * column_j in single precision, sums among them
  /// @param columns column j begins at columns + j * n; @param n padded_single(); @param listed null: the first n_listed
  void wide_add_columns(float *y, const float *columns, std::size_t n, const unsigned int *listed,
                        const float *factors, std::size_t n_listed);

  /// A step of Jacobi's iteration for 0 <= x perp b + A x >= 0, of a matrix with the diagonal d, any n:
  ///
  ///   c_i = y_i - d x_i,       x_i <- max(0, -(b_i + c_i) / d)        y = A x before
  ///
  /// @param change, size sums of squares of the changes of x and of x afterwards
  void wide_jacobi_step(double *x, double *c, const double *y, const double *b, double d, std::size_t n,
                        double &change, double &size);

  /// One step of complex states of some shapes under forces at few points (n_points <= 4), and what they then show:
  ///
  ///   p_k <- e_k p_k + sum_j w_jk q_j,       u_i = Re sum_k c_ik p_k
  ///
  /// @param n padded number of states; @param p, e real parts, then imaginary parts (2 n); @param w, c the same for
  /// each point, one behind the other
  void wide_recursion(double *p, const double *e, const double *w, const double *c, const double *q,
                      double *u, std::size_t n, unsigned int n_points);

  /// The same for real shapes s that are loaded and seen alike:
  ///
  ///   p_k <- e_k p_k + w_k sum_j s_jk q_j,       u_i = sum_k s_ik Re p_k
  ///
  /// @param w as p; @param s n for each point
  void wide_real_recursion(double *p, const double *e, const double *w, const double *s, const double *q,
                           double *u, std::size_t n, unsigned int n_points);

  /// p_k <- e_k p_k, layout as above
  void wide_rotate(double *p, const double *e, std::size_t n);

  /// y_k += sum over blocks b of h_bk x_bk, complex numbers with real and imaginary parts side by side
  /// @param h, x where the spectra of the blocks begin; @param n numbers, padded to 4
  void wide_multiply_spectra(double *y, const double *const *h, const double *const *x, std::size_t n_blocks,
                             std::size_t n);
} // namespace vibrocontact

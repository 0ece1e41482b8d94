#include <vibrocontact/numerics/wide_loops.h>

#include <algorithm>
#include <type_traits>

namespace vibrocontact
{
  namespace
  {
    // eight numbers, in one, two or four registers; the second type may stand anywhere in memory
    using Wide = double __attribute__((vector_size(64)));
    using LooseWide = double __attribute__((vector_size(64), aligned(8), may_alias));
    using WideSingle = float __attribute__((vector_size(64)));
    using LooseWideSingle = float __attribute__((vector_size(64), aligned(4), may_alias));
    using Indices = long long __attribute__((vector_size(64)));

#define VIBROCONTACT_BODY inline __attribute__((always_inline))

    VIBROCONTACT_BODY const LooseWide &at(const double *p)
    {
      return *reinterpret_cast<const LooseWide *>(p);
    }
    VIBROCONTACT_BODY LooseWide &at(double *p)
    {
      return *reinterpret_cast<LooseWide *>(p);
    }
    VIBROCONTACT_BODY const LooseWideSingle &at(const float *p)
    {
      return *reinterpret_cast<const LooseWideSingle *>(p);
    }
    VIBROCONTACT_BODY LooseWideSingle &at(float *p)
    {
      return *reinterpret_cast<LooseWideSingle *>(p);
    }
    VIBROCONTACT_BODY double sum_of(const Wide &a)
    {
      using Half = double __attribute__((vector_size(32)));
      using Quarter = double __attribute__((vector_size(16)));
      const Half half = __builtin_shufflevector(a, a, 0, 1, 2, 3) + __builtin_shufflevector(a, a, 4, 5, 6, 7);
      const Quarter quarter =
          __builtin_shufflevector(half, half, 0, 1) + __builtin_shufflevector(half, half, 2, 3);
      return quarter[0] + quarter[1];
    }

    VIBROCONTACT_BODY double dot_body(const double *a, const double *b, const std::size_t n)
    {
      Wide s0 = {}, s1 = {}, s2 = {}, s3 = {};
      std::size_t i = 0;
      for (; i + 32 <= n; i += 32)
      {
        s0 += at(a + i) * at(b + i);
        s1 += at(a + i + 8) * at(b + i + 8);
        s2 += at(a + i + 16) * at(b + i + 16);
        s3 += at(a + i + 24) * at(b + i + 24);
      }
      for (; i + 8 <= n; i += 8)
        s0 += at(a + i) * at(b + i);
      const Wide s = (s0 + s1) + (s2 + s3);
      double sum = sum_of(s);
      for (; i < n; ++i)
        sum += a[i] * b[i];
      return sum;
    }

    /// Horner's rule in B registers at once
    template <unsigned int B>
    VIBROCONTACT_BODY void polynomial_block(const double *c, const std::size_t n, const double *x, double *y)
    {
      Wide place[B], s[B];
      for (unsigned int b = 0; b < B; ++b)
      {
        place[b] = at(x + 8 * b);
        s[b] = Wide{};
      }
      for (std::size_t k = n; k-- > 0;)
        for (unsigned int b = 0; b < B; ++b)
          s[b] = s[b] * place[b] + c[k];
      for (unsigned int b = 0; b < B; ++b)
        at(y + 8 * b) = s[b];
    }

    VIBROCONTACT_BODY void polynomial_body(const double *c, const std::size_t n, const double *x, double *y,
                                           const std::size_t m)
    {
      std::size_t i = 0;
      for (; i + 32 <= m; i += 32)
        polynomial_block<4>(c, n, x + i, y + i);
      for (; i + 8 <= m; i += 8)
        polynomial_block<1>(c, n, x + i, y + i);
      if (i == m)
        return;
      double places[8] = {}, values[8];
      for (std::size_t k = i; k < m; ++k)
        places[k - i] = x[k];
      polynomial_block<1>(c, n, places, values);
      for (std::size_t k = i; k < m; ++k)
        y[k] = values[k - i];
    }

    /// as many numbers as a register holds
    template <typename Number>
    constexpr std::size_t lanes = 64 / sizeof(Number);

    /// B registers of y at once, so that their sums do not wait for each other
    template <unsigned int B, typename Number>
    VIBROCONTACT_BODY void columns_block(Number *y, const Number *columns, const std::size_t stride,
                                         const unsigned int *listed, const Number *factors,
                                         const std::size_t n_listed)
    {
      std::conditional_t<std::is_same_v<Number, double>, Wide, WideSingle> s[B];
      for (unsigned int k = 0; k < B; ++k)
        s[k] = at(y + lanes<Number> * k);
      for (std::size_t j = 0; j < n_listed; ++j)
      {
        const Number *column = columns + (listed == nullptr ? j : listed[j]) * stride;
        for (unsigned int k = 0; k < B; ++k)
          s[k] += factors[j] * at(column + lanes<Number> * k);
      }
      for (unsigned int k = 0; k < B; ++k)
        at(y + lanes<Number> * k) = s[k];
    }

    template <typename Number>
    VIBROCONTACT_BODY void add_columns_body(Number *y, const Number *columns, const std::size_t n,
                                            const std::size_t stride, const unsigned int *listed,
                                            const Number *factors, const std::size_t n_listed)
    {
      constexpr std::size_t width = lanes<Number>;
      std::size_t i = 0;
      for (; i + 13 * width <= n; i += 13 * width)
        columns_block<13>(y + i, columns + i, stride, listed, factors, n_listed);
      for (; i + 8 * width <= n; i += 8 * width)
        columns_block<8>(y + i, columns + i, stride, listed, factors, n_listed);
      for (; i + 4 * width <= n; i += 4 * width)
        columns_block<4>(y + i, columns + i, stride, listed, factors, n_listed);
      for (; i + 2 * width <= n; i += 2 * width)
        columns_block<2>(y + i, columns + i, stride, listed, factors, n_listed);
      for (; i < n; i += width)
        columns_block<1>(y + i, columns + i, stride, listed, factors, n_listed);
    }

    template <unsigned int N>
    VIBROCONTACT_BODY void recursion_body(double *p, const double *e, const double *w, const double *c,
                                          const double *q, double *u, const std::size_t n)
    {
      Wide sums[2 * N] = {};
      double force[N];
      for (unsigned int j = 0; j < N; ++j)
        force[j] = q[j];
      for (std::size_t k = 0; k < n; k += 8)
      {
        const Wide er = at(e + k), ei = at(e + n + k), pr = at(p + k), pi = at(p + n + k);
        Wide r = er * pr - ei * pi, i = er * pi + ei * pr;
        for (unsigned int j = 0; j < N; ++j)
        {
          r += force[j] * at(w + 2 * n * j + k);
          i += force[j] * at(w + 2 * n * j + n + k);
        }
        at(p + k) = r;
        at(p + n + k) = i;
        for (unsigned int j = 0; j < N; ++j)
        {
          sums[2 * j] += at(c + 2 * n * j + k) * r;
          sums[2 * j + 1] -= at(c + 2 * n * j + n + k) * i;
        }
      }
      for (unsigned int j = 0; j < N; ++j)
      {
        const Wide s = sums[2 * j] + sums[2 * j + 1];
        u[j] = sum_of(s);
      }
    }

    template <unsigned int N>
    VIBROCONTACT_BODY void real_recursion_body(double *p, const double *e, const double *w, const double *s,
                                               const double *q, double *u, const std::size_t n)
    {
      Wide sums[N] = {};
      double force[N];
      for (unsigned int j = 0; j < N; ++j)
        force[j] = q[j];
      for (std::size_t k = 0; k < n; k += 8)
      {
        const Wide er = at(e + k), ei = at(e + n + k), pr = at(p + k), pi = at(p + n + k);
        Wide shape[N];
        Wide load = {};
        for (unsigned int j = 0; j < N; ++j)
        {
          shape[j] = at(s + n * j + k);
          load += force[j] * shape[j];
        }
        const Wide r = er * pr - ei * pi + at(w + k) * load, i = er * pi + ei * pr + at(w + n + k) * load;
        at(p + k) = r;
        at(p + n + k) = i;
        for (unsigned int j = 0; j < N; ++j)
          sums[j] += shape[j] * r;
      }
      for (unsigned int j = 0; j < N; ++j)
        u[j] = sum_of(sums[j]);
    }

    VIBROCONTACT_BODY void rotate_body(double *p, const double *e, const std::size_t n)
    {
      for (std::size_t k = 0; k < n; k += 8)
      {
        const Wide er = at(e + k), ei = at(e + n + k), pr = at(p + k), pi = at(p + n + k);
        at(p + k) = er * pr - ei * pi;
        at(p + n + k) = er * pi + ei * pr;
      }
    }

    VIBROCONTACT_BODY void jacobi_body(double *x, double *c, const double *y, const double *b, const double d,
                                       const std::size_t n, double &change, double &size)
    {
      const double factor = -1 / d;
      Wide changes = {}, sizes = {};
      std::size_t i = 0;
      for (; i + 8 <= n; i += 8)
      {
        const Wide before = at(x + i), others = at(y + i) - d * before, next = factor * (at(b + i) + others),
                   projected = next > 0 ? next : Wide{}, difference = projected - before;
        at(c + i) = others;
        at(x + i) = projected;
        changes += difference * difference;
        sizes += projected * projected;
      }
      change = sum_of(changes);
      size = sum_of(sizes);
      for (; i < n; ++i)
      {
        c[i] = y[i] - d * x[i];
        const double projected = std::max(0., factor * (b[i] + c[i])), difference = projected - x[i];
        x[i] = projected;
        change += difference * difference;
        size += projected * projected;
      }
    }

    VIBROCONTACT_BODY void spectra_body(double *y, const double *const *h, const double *const *x,
                                        const std::size_t n_blocks, const std::size_t n)
    {
      const Indices swap = {1, 0, 3, 2, 5, 4, 7, 6}, even = {0, 0, 2, 2, 4, 4, 6, 6},
                    odd = {1, 1, 3, 3, 5, 5, 7, 7};
      const Wide sign = {-1, 1, -1, 1, -1, 1, -1, 1};
      for (std::size_t k = 0; k < 2 * n; k += 8)
      {
        Wide direct = at(y + k), crossed = {};
        for (std::size_t b = 0; b < n_blocks; ++b)
        {
          const Wide hb = at(h[b] + k), xb = at(x[b] + k);
          direct += __builtin_shuffle(hb, even) * xb;
          crossed += __builtin_shuffle(hb, odd) * __builtin_shuffle(xb, swap);
        }
        at(y + k) = direct + sign * crossed;
      }
    }

#define VIBROCONTACT_512 __attribute__((target("avx512f,avx512dq")))
#define VIBROCONTACT_256 __attribute__((target("avx2,fma")))
// one function for each kind of registers, the body written once
#define VIBROCONTACT_VARIANTS(type, name, body, parameters, arguments)                                       \
  VIBROCONTACT_512 type name##_512 parameters                                                                \
  {                                                                                                          \
    return body arguments;                                                                                   \
  }                                                                                                          \
  VIBROCONTACT_256 type name##_256 parameters                                                                \
  {                                                                                                          \
    return body arguments;                                                                                   \
  }                                                                                                          \
  type name##_128 parameters                                                                                 \
  {                                                                                                          \
    return body arguments;                                                                                   \
  }

    VIBROCONTACT_VARIANTS(double, dot, dot_body, (const double *a, const double *b, std::size_t n), (a, b, n))
    VIBROCONTACT_VARIANTS(void, polynomial, polynomial_body,
                          (const double *c, std::size_t n, const double *x, double *y, std::size_t m),
                          (c, n, x, y, m))
    VIBROCONTACT_VARIANTS(void, add_columns, add_columns_body,
                          (double *y, const double *columns, std::size_t n, std::size_t stride,
                           const unsigned int *listed, const double *factors, std::size_t n_listed),
                          (y, columns, n, stride, listed, factors, n_listed))
    VIBROCONTACT_VARIANTS(void, add_single_columns, add_columns_body,
                          (float *y, const float *columns, std::size_t n, std::size_t stride,
                           const unsigned int *listed, const float *factors, std::size_t n_listed),
                          (y, columns, n, stride, listed, factors, n_listed))
    VIBROCONTACT_VARIANTS(void, rotate, rotate_body, (double *p, const double *e, std::size_t n), (p, e, n))
    VIBROCONTACT_VARIANTS(void, spectra, spectra_body,
                          (double *y, const double *const *h, const double *const *x, std::size_t n_blocks,
                           std::size_t n),
                          (y, h, x, n_blocks, n))
    VIBROCONTACT_VARIANTS(void, jacobi, jacobi_body,
                          (double *x, double *c, const double *y, const double *b, double d, std::size_t n,
                           double &change, double &size),
                          (x, c, y, b, d, n, change, size))
#define VIBROCONTACT_RECURSION(N)                                                                            \
  VIBROCONTACT_VARIANTS(void, recursion_##N, recursion_body<N>,                                              \
                        (double *p, const double *e, const double *w, const double *c, const double *q,      \
                         double *u, std::size_t n),                                                          \
                        (p, e, w, c, q, u, n))                                                               \
  VIBROCONTACT_VARIANTS(void, real_recursion_##N, real_recursion_body<N>,                                    \
                        (double *p, const double *e, const double *w, const double *s, const double *q,      \
                         double *u, std::size_t n),                                                          \
                        (p, e, w, s, q, u, n))
    VIBROCONTACT_RECURSION(1)
    VIBROCONTACT_RECURSION(2)
    VIBROCONTACT_RECURSION(3)
    VIBROCONTACT_RECURSION(4)

    using Recursion = void (*)(double *, const double *, const double *, const double *, const double *,
                               double *, std::size_t);

    struct Loops
    {
      const char *name;
      decltype(&dot_128) dot;
      decltype(&polynomial_128) polynomial;
      decltype(&add_columns_128) add_columns;
      decltype(&add_single_columns_128) add_single_columns;
      decltype(&rotate_128) rotate;
      decltype(&spectra_128) spectra;
      decltype(&jacobi_128) jacobi;
      Recursion recursion[4], real_recursion[4];
    };

    Loops choose()
    {
      __builtin_cpu_init();
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        return {"avx512",
                dot_512,
                polynomial_512,
                add_columns_512,
                add_single_columns_512,
                rotate_512,
                spectra_512,
                jacobi_512,
                {recursion_1_512, recursion_2_512, recursion_3_512, recursion_4_512},
                {real_recursion_1_512, real_recursion_2_512, real_recursion_3_512, real_recursion_4_512}};
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return {"avx2",
                dot_256,
                polynomial_256,
                add_columns_256,
                add_single_columns_256,
                rotate_256,
                spectra_256,
                jacobi_256,
                {recursion_1_256, recursion_2_256, recursion_3_256, recursion_4_256},
                {real_recursion_1_256, real_recursion_2_256, real_recursion_3_256, real_recursion_4_256}};
      return {"sse2",
              dot_128,
              polynomial_128,
              add_columns_128,
              add_single_columns_128,
              rotate_128,
              spectra_128,
              jacobi_128,
              {recursion_1_128, recursion_2_128, recursion_3_128, recursion_4_128},
              {real_recursion_1_128, real_recursion_2_128, real_recursion_3_128, real_recursion_4_128}};
    }

    const Loops loops = choose();
  } // namespace

  const char *wide_loops_name()
  {
    return loops.name;
  }

  void wide_polynomial(const double *c, const std::size_t n, const double *x, double *y, const std::size_t m)
  {
    loops.polynomial(c, n, x, y, m);
  }

  double wide_dot(const double *a, const double *b, const std::size_t n)
  {
    return loops.dot(a, b, n);
  }

  void wide_add_columns(double *y, const double *columns, const std::size_t n, const unsigned int *listed,
                        const double *factors, const std::size_t n_listed)
  {
    loops.add_columns(y, columns, n, n, listed, factors, n_listed);
  }

  void wide_add_columns(double *y, const double *columns, const std::size_t n, const std::size_t stride,
                        const double *factors, const std::size_t n_columns)
  {
    loops.add_columns(y, columns, n, stride, nullptr, factors, n_columns);
  }

  void wide_add_columns(float *y, const float *columns, const std::size_t n, const unsigned int *listed,
                        const float *factors, const std::size_t n_listed)
  {
    loops.add_single_columns(y, columns, n, n, listed, factors, n_listed);
  }

  void wide_recursion(double *p, const double *e, const double *w, const double *c, const double *q,
                      double *u, const std::size_t n, const unsigned int n_points)
  {
    loops.recursion[n_points - 1](p, e, w, c, q, u, n);
  }

  void wide_real_recursion(double *p, const double *e, const double *w, const double *s, const double *q,
                           double *u, const std::size_t n, const unsigned int n_points)
  {
    loops.real_recursion[n_points - 1](p, e, w, s, q, u, n);
  }

  void wide_rotate(double *p, const double *e, const std::size_t n)
  {
    loops.rotate(p, e, n);
  }

  void wide_jacobi_step(double *x, double *c, const double *y, const double *b, const double d,
                        const std::size_t n, double &change, double &size)
  {
    loops.jacobi(x, c, y, b, d, n, change, size);
  }

  void wide_multiply_spectra(double *y, const double *const *h, const double *const *x,
                             const std::size_t n_blocks, const std::size_t n)
  {
    loops.spectra(y, h, x, n_blocks, n);
  }
} // namespace vibrocontact

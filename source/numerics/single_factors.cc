#include <vibrocontact/numerics/single_factors.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    using Integer = dealii::types::blas_int;

    constexpr Integer block = 48;
    constexpr float unit = 1, zero = 0, minus = -1;
    constexpr Integer one = 1;

    /// x[first, first + width) <- inverse x
    void apply(const float *const inverse, const Integer first, const Integer width, float *const x)
    {
      float before[block];
      std::copy_n(x + first, width, before);
      dealii::gemv("N", &width, &width, &unit, inverse, &width, before, &one, &zero, x + first, &one);
    }
  } // namespace

  bool SingleFactors::factorise(const SingleMatrix &matrix)
  {
    n = matrix.m();
    lu.assign(&matrix(0, 0), &matrix(0, 0) + matrix.n_elements());
    pivots.resize(n);
    Integer info = 0;
    dealii::getrf(&n, &n, lu.data(), &n, pivots.data(), &info);
    if (info != 0)
    {
      clear();
      return false;
    }
    invert_blocks();
    return true;
  }

  void SingleFactors::invert_blocks()
  {
    const Integer n_blocks = (n + block - 1) / block;
    inverses.assign(2 * n_blocks * block * block, 0.F);
    float *inverse = inverses.data();
    for (const bool is_upper : {false, true})
      for (Integer first = 0; first < n; first += block, inverse += block * block)
      {
        const Integer width = std::min(block, n - first);
        for (Integer i = 0; i < width; ++i)
          inverse[i * width + i] = 1;
        Integer info = 0;
        dealii::trtrs(is_upper ? "U" : "L", "N", is_upper ? "N" : "U", &width, &width,
                      &lu[std::size_t(first) * n + first], &n, inverse, &width, &info);
      }
  }

  void SingleFactors::solve(SingleVector &values) const
  {
    float *const x = values.data();
    for (Integer i = 0; i < n; ++i)
      std::swap(x[i], x[pivots[i] - 1]);
    const float *inverse = inverses.data();
    Integer first = 0;
    for (; first < n; first += block, inverse += block * block)
    {
      const Integer end = std::min(n, first + block), width = end - first, below = n - end;
      apply(inverse, first, width, x);
      if (below > 0)
        dealii::gemv("N", &below, &width, &minus, &lu[std::size_t(first) * n + end], &n, x + first, &one,
                     &unit, x + end, &one);
    }
    inverse = inverses.data() + inverses.size();
    while (first > 0)
    {
      first -= block;
      inverse -= block * block;
      const Integer width = std::min(block, n - first);
      apply(inverse, first, width, x);
      if (first > 0)
        dealii::gemv("N", &first, &width, &minus, &lu[std::size_t(first) * n], &n, x + first, &one, &unit, x,
                     &one);
    }
  }
} // namespace vibrocontact

#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/numerics/single_factors.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    using Integer = dealii::types::blas_int;

    /// unknowns; of 312 all widths from 32 to 104 take the same time, and wider ones longer to invert
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

  bool SingleFactors::factorise(const DenseMatrix &matrix)
  {
    AssertDimension(matrix.m(), matrix.n());
    n = matrix.m();
    lu = in_single_precision(matrix);
    pivots.resize(n);
    single.resize(n);
    Integer info = 0;
    dealii::getrf(&n, &n, &lu(0, 0), &n, pivots.data(), &info);
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
        dealii::trtrs(is_upper ? "U" : "L", "N", is_upper ? "N" : "U", &width, &width, &lu(first, first), &n,
                      inverse, &width, &info);
        Assert(info == 0, dealii::ExcInternalError());
      }
  }

  void SingleFactors::solve(DenseVector &values) const
  {
    Assert(!empty(), dealii::ExcNotInitialized());
    AssertDimension(values.size(), single.size());
    std::copy(values.begin(), values.end(), single.begin());
    float *const x = single.data();
    for (Integer i = 0; i < n; ++i)
      std::swap(x[i], x[pivots[i] - 1]);
    const float *inverse = inverses.data();
    Integer first = 0;
    for (; first < n; first += block, inverse += block * block)
    {
      const Integer end = std::min(n, first + block), width = end - first, below = n - end;
      apply(inverse, first, width, x);
      if (below > 0)
        dealii::gemv("N", &below, &width, &minus, &lu(end, first), &n, x + first, &one, &unit, x + end, &one);
    }
    inverse = inverses.data() + inverses.size();
    while (first > 0)
    {
      first -= block;
      inverse -= block * block;
      const Integer width = std::min(block, n - first);
      apply(inverse, first, width, x);
      if (first > 0)
        dealii::gemv("N", &first, &width, &minus, &lu(0, first), &n, x + first, &one, &unit, x, &one);
    }
    std::copy(single.begin(), single.end(), values.begin());
  }
} // namespace vibrocontact

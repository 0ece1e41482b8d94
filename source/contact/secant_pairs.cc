#include <vibrocontact/contact/secant_pairs.h>
#include <vibrocontact/numerics/wide_loops.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// differences that the later ones leave so little of say nothing new
    constexpr double least_share = 1e-3;

    // deal.II's own operations first decide about threads, which costs more than some hundred products

    double scalar_product(const DenseVector &a, const DenseVector &b)
    {
      AssertDimension(a.size(), b.size());
      return wide_dot(a.begin(), b.begin(), a.size());
    }

    /// x += factor y
    void add_multiple(DenseVector &x, const double factor, const DenseVector &y)
    {
      AssertDimension(x.size(), y.size());
      const dealii::types::blas_int n = x.size(), one = 1;
      dealii::axpy(&n, &factor, y.begin(), &one, x.begin(), &one);
    }
  } // namespace

  void SecantPairs::add(const DenseVector &difference, const DenseVector &step)
  {
    latest = n == 0 ? 0 : (latest + 1) % most_pairs;
    n = std::min(n + 1, most_pairs);
    pairs[latest].difference = difference;
    pairs[latest].step = step;
    for (unsigned int k = 0; k < n; ++k)
      products[latest][k] = products[k][latest] = scalar_product(difference, pairs[k].difference);
  }

  DenseVector SecantPairs::take_known_part(DenseVector &residual) const
  {
    // F^T F = L L^T of those that say something; w = L^-1 F^T r
    double L[most_pairs][most_pairs], w[most_pairs];
    unsigned int places[most_pairs], size = 0;
    for (unsigned int age = 0; age < n; ++age)
    {
      const unsigned int k = (latest + most_pairs - age) % most_pairs;
      double rest = products[k][k], right = scalar_product(residual, pairs[k].difference);
      for (unsigned int i = 0; i < size; ++i)
      {
        double entry = products[k][places[i]];
        for (unsigned int j = 0; j < i; ++j)
          entry -= L[size][j] * L[i][j];
        L[size][i] = entry / L[i][i];
        rest -= L[size][i] * L[size][i];
        right -= L[size][i] * w[i];
      }
      if (!(rest > least_share * least_share * products[k][k]))
        continue;
      L[size][size] = std::sqrt(rest);
      w[size] = right / L[size][size];
      places[size++] = k;
    }
    DenseVector known(residual.size());
    for (unsigned int i = size; i-- > 0;)
    {
      for (unsigned int j = i + 1; j < size; ++j)
        w[i] -= L[j][i] * w[j];
      w[i] /= L[i][i];
    }
    for (unsigned int i = 0; i < size; ++i)
    {
      add_multiple(residual, -w[i], pairs[places[i]].difference);
      add_multiple(known, w[i], pairs[places[i]].step);
    }
    return known;
  }
} // namespace vibrocontact

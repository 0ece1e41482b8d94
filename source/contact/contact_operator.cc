#include <vibrocontact/contact/contact_operator.h>

namespace vibrocontact
{
  DenseContactOperator::DenseContactOperator(DenseMatrix m, const unsigned int n_components)
      : matrix(std::move(m)), components(n_components)
  {
    AssertThrow(matrix.m() == matrix.n() && matrix.m() % components == 0,
                dealii::ExcMessage("A contact operator is square with as many rows for each point."));
  }

  void DenseContactOperator::vmult(DenseVector &y, const DenseVector &R,
                                   const std::vector<unsigned int> &sources) const
  {
    const unsigned int n = n_points(), size = components * n;
    y.reinit(size);
    double *const out = y.data();
    for (unsigned int component = 0; component < components; ++component)
      for (const unsigned int source : sources)
      {
        const unsigned int column = contact_row(n, component, source);
        const double force = R[column];
        if (force == 0)
          continue;
        const double *const values = &matrix(0, column);
        for (unsigned int row = 0; row < size; ++row)
          out[row] += values[row] * force;
      }
  }

  void DenseContactOperator::extract(const std::vector<unsigned int> &points, DenseMatrix &block) const
  {
    const unsigned int n = n_points(), m = points.size();
    block.reinit(components * m);
    for (unsigned int component = 0; component < components; ++component)
      for (unsigned int j = 0; j < m; ++j)
      {
        const double *const from = &matrix(0, contact_row(n, component, points[j]));
        double *const to = &block(0, component * m + j);
        for (unsigned int c = 0; c < components; ++c)
          for (unsigned int i = 0; i < m; ++i)
            to[c * m + i] = from[c * n + points[i]];
      }
  }

  double DenseContactOperator::mean_diagonal(const unsigned int component) const
  {
    const unsigned int n = n_points();
    double sum = 0;
    for (unsigned int i = component * n; i < (component + 1) * n; ++i)
      sum += matrix(i, i);
    return sum / n;
  }
} // namespace vibrocontact

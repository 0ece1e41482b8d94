#include <vibrocontact/coupled_bodies/sprung_operator.h>

#include <utility>

namespace vibrocontact
{
  SprungOperator::SprungOperator(std::shared_ptr<const ContactOperator> held, std::vector<Spring> springs)
      : held(std::move(held)), springs(std::move(springs))
  {
  }

  double SprungOperator::stretch(const Spring &spring, const DenseVector &R,
                                 const std::vector<unsigned int> &sources) const
  {
    double force = 0;
    for (unsigned int c = 0; c < n_components(); ++c)
      for (const unsigned int point : sources)
      {
        const unsigned int row = contact_row(n_points(), c, point);
        force += spring.motion[row] * R[row];
      }
    return spring.compliance * force;
  }

  void SprungOperator::vmult(DenseVector &y, const DenseVector &R,
                             const std::vector<unsigned int> &sources) const
  {
    held->vmult(y, R, sources);
    for (const Spring &spring : springs)
      y.add(stretch(spring, R, sources), spring.motion);
  }

  void SprungOperator::vmult_among(DenseVector &y, const DenseVector &R,
                                   const std::vector<unsigned int> &sources) const
  {
    held->vmult_among(y, R, sources);
    for (const Spring &spring : springs)
    {
      const double moved = stretch(spring, R, sources);
      for (unsigned int c = 0; c < n_components(); ++c)
        for (const unsigned int point : sources)
        {
          const unsigned int row = contact_row(n_points(), c, point);
          y[row] += moved * spring.motion[row];
        }
    }
  }

  void SprungOperator::extract(const std::vector<unsigned int> &points, DenseMatrix &block) const
  {
    held->extract(points, block);
    const unsigned int m = points.size(), size = n_components() * m;
    std::vector<double> h(size);
    for (const Spring &spring : springs)
    {
      for (unsigned int i = 0; i < size; ++i)
        h[i] = spring.motion[contact_row(n_points(), i / m, points[i % m])];
      for (unsigned int j = 0; j < size; ++j)
        if (h[j] != 0)
          for (unsigned int i = 0; i < size; ++i)
            block(i, j) += spring.compliance * h[i] * h[j];
    }
  }
} // namespace vibrocontact

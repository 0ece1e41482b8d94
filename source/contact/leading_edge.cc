#include <vibrocontact/contact/leading_edge.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// of the diagonal of A: that of a point that carries next to nothing
    constexpr double largest_compliance = 1e6;

    /// A with compliances on the diagonal of some points, whose tangential rows are then multiplied by weights.
    class LeadingEdgeOperator : public ContactOperator
    {
    public:
      LeadingEdgeOperator(std::shared_ptr<const ContactOperator> A, const LeadingEdge &edge)
          : A(std::move(A)), edge(edge)
      {
      }
      unsigned int n_points() const override { return A->n_points(); }
      unsigned int n_components() const override { return A->n_components(); }
      void vmult(DenseVector &y, const DenseVector &R,
                 const std::vector<unsigned int> &sources) const override
      {
        A->vmult(y, R, sources);
        change(y, R);
      }
      void vmult_among(DenseVector &y, const DenseVector &R,
                       const std::vector<unsigned int> &sources) const override
      {
        A->vmult_among(y, R, sources);
        change(y, R);
      }
      void extract(const std::vector<unsigned int> &points, DenseMatrix &block) const override
      {
        A->extract(points, block);
        const unsigned int m = points.size();
        for (const LeadingEdge::Point &one : edge.points)
        {
          const auto at = std::find(points.begin(), points.end(), one.point);
          for (unsigned int c = 1; c < 3 && at != points.end(); ++c)
          {
            const unsigned int row = c * m + (at - points.begin());
            block(row, row) += one.compliance[c - 1];
            for (unsigned int column = 0; column < 3 * m; ++column)
              block(row, column) *= one.weight[c - 1];
          }
        }
      }
      double mean_diagonal(const unsigned int component) const override
      {
        return A->mean_diagonal(component);
      }
      bool fast_product() const override { return A->fast_product(); }

    private:
      void change(DenseVector &y, const DenseVector &R) const
      {
        const unsigned int n = n_points();
        for (const LeadingEdge::Point &one : edge.points)
          for (unsigned int c = 1; c < 3; ++c)
          {
            double &slip = y[c * n + one.point];
            slip = one.weight[c - 1] * (slip + one.compliance[c - 1] * R[c * n + one.point]);
          }
      }

      const std::shared_ptr<const ContactOperator> A;
      const LeadingEdge edge;
    };
  } // namespace

  LeadingEdge::LeadingEdge(const ContactGrid &grid, const std::array<double, 2> &ratio, const double speed,
                           const ContactOperator &A, const ContactSolution &normal)
  {
    for (unsigned int i = 1; i < grid.n_points(); ++i)
    {
      if (i % grid.n_x == 0 || !(normal.R[i] > 0) || normal.R[i - 1] > 0)
        continue;
      const double of_normal = speed * std::max(normal.y[i - 1], 0.) / (grid.spacing_x * normal.R[i]);
      Point one = {i, {}, {}};
      for (unsigned int c = 0; c < 2; ++c)
      {
        const double own = A.mean_diagonal(c + 1);
        one.compliance[c] = std::min(ratio[c] * of_normal, largest_compliance * own);
        one.weight[c] = 1 / (1 + one.compliance[c] / own);
      }
      points.push_back(one);
    }
  }

  bool LeadingEdge::equals(const LeadingEdge &other) const
  {
    const auto close = [](const Point &a, const Point &b)
    { return a.point == b.point && std::abs(a.weight[0] - b.weight[0]) < 1e-6; };
    return std::equal(points.begin(), points.end(), other.points.begin(), other.points.end(), close);
  }

  LeadingEdge LeadingEdge::without_weights() const
  {
    LeadingEdge result = *this;
    for (Point &one : result.points)
      one.weight = {{1, 1}};
    return result;
  }

  void LeadingEdge::add_to(ContactProblem &problem) const
  {
    problem.A = std::make_shared<LeadingEdgeOperator>(problem.A, *this);
    const unsigned int n = problem.n_points();
    for (const Point &one : points)
      for (unsigned int c = 1; c < 3; ++c)
        problem.b[c * n + one.point] *= one.weight[c - 1];
  }

  void LeadingEdge::take_weights(DenseVector &y) const
  {
    const unsigned int n = y.size() / 3;
    for (const Point &one : points)
      for (unsigned int c = 1; c < 3; ++c)
        y[c * n + one.point] /= one.weight[c - 1];
  }

  const CreepScheme &leading_edge_scheme()
  {
    static const CreepScheme scheme = {
        "leading edge", "first-order upwind, slip taken in the middle of the difference", {1., -1.}, 0.5};
    return scheme;
  }
} // namespace vibrocontact

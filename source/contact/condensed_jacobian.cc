#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/contact/condensed_jacobian.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// largest relative defect of the inverse of A times A, times a vector
    constexpr double largest_defect = 1e-3;

    /// Whether a row of a point says what its response is.
    bool prescribes(const NewtonJacobian::Blocks &of_point, const unsigned int row)
    {
      for (unsigned int c = 0; c < 3; ++c)
        if (of_point.by_force[row][c] != 0 || (c == row) != (of_point.by_response[row][c] != 0))
          return false;
      return true;
    }
  } // namespace

  InverseResponse::InverseResponse(const ContactProblem &problem, std::vector<unsigned int> points)
      : of_points(std::move(points))
  {
    const ContactOperator &A = *problem.A;
    const unsigned int components = A.n_components(), m = of_points.size();
    DenseMatrix block;
    A.extract(of_points, block);
    n_rows = components * m + (problem.force_given() ? 1 : 0);
    stride = padded_single(n_rows);
    for (unsigned int c = 0; c < components; ++c)
    {
      scales[c] = A.mean_diagonal(c);
      // what does not yield has no inverse
      if (!(std::abs(scales[c]) > 0))
        return;
    }
    DenseMatrix scaled(n_rows);
    for (unsigned int j = 0; j < components * m; ++j)
      for (unsigned int i = 0; i < components * m; ++i)
        scaled(i, j) = block(i, j) / scales[i / m];
    if (problem.force_given())
      for (unsigned int c = 0; c < components; ++c)
        for (unsigned int k = 0; k < m; ++k)
        {
          scaled(c * m + k, n_rows - 1) = -problem.approach_of(of_points[k])[c] * scales[0] / scales[c];
          scaled(n_rows - 1, c * m + k) = problem.share_of(of_points[k])[c];
        }
    exact_enough = invert(scaled);
    if (!exact_enough)
      inverse.clear();
  }

  bool InverseResponse::invert(const DenseMatrix &matrix)
  {
    SingleMatrix single = in_single_precision(matrix);
    try
    {
      single.invert();
    }
    catch (const dealii::LACExceptions::ExcSingular &)
    {
      return false;
    }
    inverse.assign(stride * n_rows, 0.F);
    for (unsigned int j = 0; j < n_rows; ++j)
      std::copy_n(&single(0, j), n_rows, inverse.begin() + stride * j);

    // numbers of both signs that no symmetry of a grid has
    DenseVector forces(n_rows), responses(n_rows);
    for (unsigned int i = 0; i < n_rows; ++i)
      forces[i] = std::cos(2.4 * i * i);
    matrix.vmult(responses, forces);
    AlignedSingleVector found(stride, 0.F);
    const std::vector<float> factors(responses.begin(), responses.end());
    wide_add_columns(found.data(), inverse.data(), stride, nullptr, factors.data(), n_rows);
    double defect = 0;
    for (unsigned int i = 0; i < n_rows; ++i)
      defect += std::pow(found[i] - forces[i], 2);
    return std::sqrt(defect) <= largest_defect * forces.l2_norm();
  }

  bool InverseResponse::covers(const std::vector<unsigned int> &points) const
  {
    return std::includes(of_points.begin(), of_points.end(), points.begin(), points.end());
  }

  void InverseResponse::add_forces(const std::vector<unsigned int> &rows, const std::vector<float> &responses,
                                   AlignedSingleVector &forces) const
  {
    wide_add_columns(forces.data(), inverse.data(), stride, rows.data(), responses.data(), rows.size());
  }

  CondensedJacobian::CondensedJacobian(const NewtonJacobian::Rows &rows, const unsigned int n_components,
                                       std::shared_ptr<const InverseResponse> of_points)
      : inverse(std::move(of_points)), n(rows.size()), components(n_components), responses(inverse->size()),
        forces(inverse->padded_size())
  {
    AssertDimension(n, inverse->points().size());
    for (unsigned int k = 0; k < n; ++k)
    {
      const NewtonJacobian::Blocks blocks = NewtonJacobian::blocks_of(rows[k]);
      for (unsigned int c = 0; c < components; ++c)
      {
        const unsigned int row = c * n + k;
        if (prescribes(blocks, c))
        {
          prescribed.push_back(row);
          by_residual.push_back(1 / (blocks.by_response[c][c] * inverse->scale(c)));
          continue;
        }
        left.push_back({row, {{k, n + k, 2 * n + k}}, blocks.by_force[c], blocks.by_response[c]});
        for (unsigned int d = 0; d < components; ++d)
          left.back().by_scaled_response[d] *= inverse->scale(d);
      }
    }
    if (inverse->size() > components * n)
    {
      prescribed.push_back(components * n);
      by_residual.push_back(1);
    }
    for (const LeftRow &row : left)
      left_rows.push_back(row.row);
  }

  void CondensedJacobian::assemble(DenseMatrix &M) const
  {
    const unsigned int n_left = left.size();
    M.reinit(n_left);
    for (unsigned int j = 0; j < n_left; ++j)
    {
      const float *const forces_by = inverse->column(left_rows[j]);
      double *const column = &M(0, j);
      std::array<double, 3> force{};
      for (unsigned int i = 0; i < n_left; ++i)
      {
        const LeftRow &row = left[i];
        if (i == 0 || row.of_point[0] != left[i - 1].of_point[0])
          for (unsigned int c = 0; c < components; ++c)
            force[c] = forces_by[row.of_point[c]];
        column[i] = row.by_force[0] * force[0] + row.by_force[1] * force[1] + row.by_force[2] * force[2];
      }
    }
    // rows of a point follow each other
    for (unsigned int i = 0; i < n_left; ++i)
      for (unsigned int j = i < 2 ? 0 : i - 2; j < std::min(n_left, i + 3); ++j)
        for (unsigned int c = 0; c < components; ++c)
          if (left[i].of_point[c] == left_rows[j])
            M(i, j) += left[i].by_scaled_response[c];
  }

  void CondensedJacobian::condense(const DenseVector &r, DenseVector &right_side)
  {
    std::fill(responses.begin(), responses.end(), 0.);
    factors.clear();
    for (unsigned int k = 0; k < prescribed.size(); ++k)
    {
      responses[prescribed[k]] = by_residual[k] * r[prescribed[k]];
      factors.push_back(static_cast<float>(responses[prescribed[k]]));
    }
    std::fill(forces.begin(), forces.end(), 0.F);
    inverse->add_forces(prescribed, factors, forces);
    right_side.reinit(left.size());
    for (unsigned int i = 0; i < left.size(); ++i)
    {
      const LeftRow &row = left[i];
      double sum = r[row.row];
      for (unsigned int c = 0; c < components; ++c)
        sum -= row.by_force[c] * forces[row.of_point[c]] +
               row.by_scaled_response[c] * responses[row.of_point[c]];
      right_side[i] = sum;
    }
  }

  void CondensedJacobian::expand(const DenseVector &of_left_rows, DenseVector &x)
  {
    for (unsigned int i = 0; i < left.size(); ++i)
      responses[left_rows[i]] = of_left_rows[i];
    factors.assign(of_left_rows.begin(), of_left_rows.end());
    inverse->add_forces(left_rows, factors, forces);
    std::copy_n(forces.begin(), inverse->size(), x.begin());
  }

  unsigned int condensed_size(const NewtonJacobian::Rows &rows, const unsigned int n_components)
  {
    unsigned int size = 0;
    for (const NewtonJacobian::Row &row : rows)
    {
      const NewtonJacobian::Blocks blocks = NewtonJacobian::blocks_of(row);
      for (unsigned int c = 0; c < n_components; ++c)
        size += prescribes(blocks, c) ? 0 : 1;
    }
    return size;
  }
} // namespace vibrocontact

#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/contact/newton_factors.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// of a right-hand side, that a solution in single precision may leave
    constexpr double largest_single_defect = 1e-3;
  } // namespace

  std::vector<unsigned int> places_among(const std::vector<unsigned int> &some,
                                         const std::vector<unsigned int> &all)
  {
    std::vector<unsigned int> result;
    unsigned int place = 0;
    for (const unsigned int point : some)
    {
      while (place < all.size() && all[place] < point)
        ++place;
      Assert(place < all.size() && all[place] == point, dealii::ExcInternalError());
      result.push_back(place);
    }
    return result;
  }

  void JacobianOnPoints::take(const NewtonJacobian &J, const std::vector<unsigned int> &on_points,
                              const std::vector<ContactStatus> &status_of_all, const double scale)
  {
    components = J.n_components();
    force_given = J.size() > components * J.points().size();
    approach_scale = scale;
    points = on_points;
    rows.assign(points.size(), {});
    status.assign(points.size(), ContactStatus::open);
    const std::vector<unsigned int> places = places_among(J.points(), points);
    for (unsigned int k = 0; k < places.size(); ++k)
    {
      rows[places[k]] = J.rows_of_points()[k];
      status[places[k]] = status_of_all[J.points()[k]];
    }
  }

  NewtonFactors::NewtonFactors(const JacobianOnPoints &at, std::shared_ptr<const InverseResponse> inverse)
      : made_for(at)
  {
    if (inverse)
      condensed.emplace(at.rows, at.components, std::move(inverse));
  }

  bool NewtonFactors::factorise(const std::function<void(DenseMatrix &)> &assemble,
                                const bool in_single_precision)
  {
    if (n_factorised() == 0)
      return true;
    if (condensed)
      condensed->assemble(lu);
    else
      assemble(lu);
    return (in_single_precision && single_lu.factorise(lu)) || factorise_lu(lu);
  }

  std::vector<unsigned int> NewtonFactors::changed_points(const JacobianOnPoints &now) const
  {
    std::vector<unsigned int> result;
    for (unsigned int k = 0; k < now.points.size(); ++k)
      if (now.status[k] != made_for.status[k])
        result.push_back(k);
    return result;
  }

  bool NewtonFactors::has(const JacobianOnPoints &now, const std::vector<unsigned int> &points) const
  {
    if (points != changed)
      return false;
    for (unsigned int i = 0; i < points.size(); ++i)
      if (now.status[points[i]] != changed_status[i])
        return false;
    return true;
  }

  unsigned int NewtonFactors::n_new(const std::vector<unsigned int> &points) const
  {
    return std::count_if(points.begin(), points.end(),
                         [&](const unsigned int k)
                         { return !std::binary_search(changed.begin(), changed.end(), k); });
  }

  bool NewtonFactors::update(const JacobianOnPoints &now, const std::vector<unsigned int> &points,
                             DenseMatrix rows)
  {
    const unsigned int n = now.points.size();
    std::vector<ChangedRow> of_points;
    std::vector<DenseVector> Z, AZ;
    rows_of_A = std::move(rows);
    for (const unsigned int k : points)
    {
      const NewtonJacobian::Blocks after = NewtonJacobian::blocks_of(now.rows[k]),
                                   before = NewtonJacobian::blocks_of(made_for.rows[k]);
      const bool touches = now.status[k] != ContactStatus::open && made_for.status[k] != ContactStatus::open;
      for (unsigned int c = touches ? 1 : 0; c < now.components; ++c)
      {
        ChangedRow row{k, c, {}, {}};
        for (unsigned int d = 0; d < 3; ++d)
        {
          row.by_force[d] = after.by_force[c][d] - before.by_force[c][d];
          row.by_response[d] = after.by_response[c][d] - before.by_response[c][d];
        }
        of_points.push_back(row);
        const auto known =
            std::find_if(changed_rows.begin(), changed_rows.end(),
                         [&](const ChangedRow &one) { return one.point == k && one.component == c; });
        if (known != changed_rows.end())
        {
          Z.push_back(std::move(columns[known - changed_rows.begin()]));
          if (condensed)
            AZ.push_back(std::move(responses_of_columns[known - changed_rows.begin()]));
          continue;
        }
        Z.emplace_back(now.size());
        Z.back()[c * n + k] = 1;
        if (!solve_as_made(Z.back()))
          return false;
        if (condensed)
          AZ.push_back(response(Z.back()));
      }
    }
    changed = points;
    changed_status.clear();
    for (const unsigned int k : changed)
      changed_status.push_back(now.status[k]);
    changed_rows = std::move(of_points);
    columns = std::move(Z);
    responses_of_columns = std::move(AZ);
    pairs.clear();
    if (changed_rows.empty())
      return true;
    small.reinit(changed_rows.size());
    for (unsigned int j = 0; j < changed_rows.size(); ++j)
    {
      const DenseVector of_column =
          differences_by(columns[j], condensed ? responses_of_columns[j] : response(columns[j]));
      std::copy(of_column.begin(), of_column.end(), &small(0, j));
      small(j, j) += 1;
    }
    return factorise_lu(small);
  }

  DenseVector NewtonFactors::response(const DenseVector &x) const
  {
    const unsigned int n = made_for.points.size();
    DenseVector result(made_for.components * n);
    if (condensed)
    {
      for (unsigned int row = 0; row < result.size(); ++row)
        result[row] = condensed->response(row);
      return result;
    }
    DenseVector of_changed(rows_of_A.m());
    rows_of_A.vmult(of_changed, x);
    for (unsigned int i = 0; i < changed.size(); ++i)
      for (unsigned int c = 0; c < made_for.components; ++c)
        result[c * n + changed[i]] = of_changed[made_for.components * i + c];
    return result;
  }

  DenseVector NewtonFactors::differences_by(const DenseVector &x, const DenseVector &response) const
  {
    const unsigned int n = made_for.points.size(), components = made_for.components;
    DenseVector result(changed_rows.size());
    for (unsigned int i = 0; i < changed_rows.size(); ++i)
    {
      const ChangedRow &row = changed_rows[i];
      for (unsigned int c = 0; c < components; ++c)
        result[i] +=
            row.by_force[c] * x[c * n + row.point] + row.by_response[c] * response[c * n + row.point];
    }
    return result;
  }

  bool NewtonFactors::solve(DenseVector &x)
  {
    if (!solve_as_made(x))
      return false;
    if (changed_rows.empty())
      return true;
    DenseVector shares = differences_by(x, response(x));
    small.solve(shares);
    for (unsigned int j = 0; j < columns.size(); ++j)
      x.add(-shares[j], columns[j]);
    return true;
  }

  bool NewtonFactors::solve_as_made(DenseVector &x)
  {
    if (!condensed)
      return solve_factorised(x);
    condensed->condense(x, condensed_side);
    if (condensed_side.size() > 0 && !solve_factorised(condensed_side))
      return false;
    condensed->expand(condensed_side, x);
    return true;
  }

  bool NewtonFactors::solve_factorised(DenseVector &x)
  {
    if (single_lu.empty())
    {
      lu.solve(x);
      return true;
    }
    const bool is_first = lu.m() > 0;
    if (is_first)
      right_side = x;
    single_lu.solve(x);
    if (!is_first)
      return true;

    DenseVector defect(x.size());
    lu.vmult(defect, x);
    defect -= right_side;
    if (defect.l2_norm() <= largest_single_defect * right_side.l2_norm())
    {
      lu.reinit(0);
      return true;
    }
    single_lu.clear();
    x = right_side;
    if (!factorise_lu(lu))
      return false;
    lu.solve(x);
    return true;
  }
} // namespace vibrocontact

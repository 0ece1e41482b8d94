#include <vibrocontact/contact/newton_factorisation.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// more changed points than this are factorised
    constexpr unsigned int max_changed = 24;
    /// of the residual that a step leaves: factors of this problem have to reduce it by ten at a stroke, those of an earlier one
    /// are mended by secants
    constexpr double largest_gain_alone = 0.1, largest_gain_in_march = 0.9;
    /// with factors of an earlier problem; from then on they count as its own
    constexpr unsigned int most_solves = 15;

    bool factorise_lu(DenseMatrix &matrix)
    {
      try
      {
        matrix.compute_lu_factorization();
      }
      catch (const dealii::LACExceptions::ExcSingular &)
      {
        return false;
      }
      return true;
    }
  } // namespace

  void NewtonFactorisation::forget()
  {
    is_factorised = false;
    pairs.clear();
    last_direction.reinit(0);
  }

  void NewtonFactorisation::begin_problem()
  {
    ++n_problems;
    n_solves = 0;
    last_direction.reinit(0);
  }

  double NewtonFactorisation::largest_gain() const
  {
    return n_problems > 0 && n_solves < most_solves ? largest_gain_in_march : largest_gain_alone;
  }

  bool NewtonFactorisation::prepare(const ContactProblem &problem, const NewtonJacobian &J,
                                    const std::vector<ContactStatus> &now, const bool anew,
                                    unsigned int &factorisations)
  {
    if (!anew && is_factorised && A.lock() == problem.A && force_given == problem.force_given() &&
        points == J.points())
    {
      flipped.clear();
      for (unsigned int k = 0; k < points.size(); ++k)
        if (now[points[k]] != status[k])
          flipped.push_back(k);
      if (flipped == changed || (flipped.size() <= max_changed && update(J)))
        return true;
    }
    ++factorisations;
    return factorise(problem, J, now);
  }

  bool NewtonFactorisation::factorise(const ContactProblem &problem, const NewtonJacobian &J,
                                      const std::vector<ContactStatus> &now)
  {
    const bool same_points = A.lock() == problem.A && points == J.points();
    forget();
    points = J.points();
    status.clear();
    for (const unsigned int i : points)
      status.push_back(now[i]);
    rows = J.rows_of_points();
    changed.clear();
    if (!same_points)
      problem.A->extract(points, response);
    A = problem.A;
    J.assemble(response, lu);
    if (!factorise_lu(lu))
      return false;
    is_factorised = true;
    n_problems = 0;
    force_given = problem.force_given();
    return true;
  }

  bool NewtonFactorisation::update(const NewtonJacobian &J)
  {
    const unsigned int m = points.size(), size = lu.m(), n_flipped = flipped.size(), t = J.n_components() - 1;
    DenseMatrix Z(size, t * n_flipped);
    DenseVector column(size);
    differences.reinit(t * n_flipped, size);
    for (unsigned int f = 0; f < n_flipped; ++f)
    {
      const unsigned int k = flipped[f];
      const auto known = std::find(changed.begin(), changed.end(), k);
      for (unsigned int c = 0; c < t; ++c)
      {
        if (known != changed.end())
          std::copy_n(&columns(0, t * (known - changed.begin()) + c), size, column.begin());
        else
        {
          column = 0;
          column[(c + 1) * m + k] = 1;
          lu.solve(column);
        }
        std::copy(column.begin(), column.end(), &Z(0, t * f + c));
      }
      J.assemble_difference(k, rows[k], response, differences, t * f);
    }
    columns = Z;
    changed = flipped;
    pairs.clear();
    last_direction.reinit(0);
    if (n_flipped == 0)
      return true;
    small.reinit(t * n_flipped);
    differences.mmult(small, columns);
    for (unsigned int i = 0; i < t * n_flipped; ++i)
      small(i, i) += 1;
    return factorise_lu(small);
  }

  void NewtonFactorisation::solve(DenseVector &x)
  {
    ++n_solves;
    if (n_problems == 0)
      return solve_by_factors(x);
    if (last_direction.size() == x.size() && direction_taken)
    {
      last_residual -= x;
      pairs.add(last_residual, last_direction);
    }
    last_residual = x;
    const DenseVector known = pairs.take_known_part(x);
    solve_by_factors(x);
    x += known;
    last_direction = x;
    direction_taken = false;
  }

  void NewtonFactorisation::solve_by_factors(DenseVector &x)
  {
    lu.solve(x);
    if (changed.empty())
      return;
    DenseVector shares(small.m()), correction(x.size());
    differences.vmult(shares, x);
    small.solve(shares);
    columns.vmult(correction, shares);
    x -= correction;
  }
} // namespace vibrocontact

#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/contact/newton_factorisation.h>

#include <algorithm>
#include <limits>

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
    /// of a factorisation, in steps of Newton's method
    constexpr unsigned int price = 60;
    constexpr unsigned int most_kept = 24;
    /// sets of points whose entries of A are at hand
    constexpr unsigned int most_responses = 2;
    /// unknowns below which single precision saves nothing
    constexpr unsigned int few_unknowns = 100;
    /// of a right-hand side, that a solution in single precision may leave
    constexpr double largest_single_defect = 1e-3;

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

    /// Square of what the tangential rows differ by.
    double distance(const NewtonJacobian::Rows &a, const NewtonJacobian::Rows &b)
    {
      double sum = 0;
      for (std::size_t k = 0; k < a.size(); ++k)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double radius = a[k].by_radius[c] - b[k].by_radius[c],
                       x = a[k].by_trial[c][0] - b[k].by_trial[c][0],
                       y = a[k].by_trial[c][1] - b[k].by_trial[c][1];
          sum += radius * radius + x * x + y * y;
        }
      return sum;
    }
  } // namespace

  void NewtonFactorisation::forget()
  {
    A.reset();
    kept.clear();
    used = nullptr;
    n_problems = n_solves = 0;
    excess = 0;
    last_direction.reinit(0);
  }

  bool NewtonFactorisation::distrust()
  {
    is_distrusted = used != nullptr && is_earlier;
    return is_distrusted;
  }

  void NewtonFactorisation::begin_problem()
  {
    ++n_problems;
    excess += n_solves > 1 ? n_solves - 1 : 0;
    n_solves = 0;
    is_distrusted = false;
    // a problem by itself has factors in double precision; those that follow have their own, which solve in half the time
    if (n_problems == 2)
    {
      kept.erase(std::remove_if(kept.begin(), kept.end(),
                                [](const auto &one) { return one->lu.m() >= few_unknowns; }),
                 kept.end());
      used = nullptr;
    }
    is_earlier = used != nullptr;
    last_direction.reinit(0);
  }

  NewtonFactorisation::Factors *NewtonFactorisation::nearest(const NewtonJacobian &J) const
  {
    Factors *best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const std::unique_ptr<Factors> &one : kept)
      if (one->points == J.points())
      {
        const double now = distance(one->rows, J.rows_of_points());
        if (now < least)
        {
          least = now;
          best = one.get();
        }
      }
    return best;
  }

  bool NewtonFactorisation::find_flipped(const std::vector<ContactStatus> &now)
  {
    flipped.clear();
    for (unsigned int k = 0; k < used->points.size(); ++k)
      if (now[used->points[k]] != used->status[k])
        flipped.push_back(k);
    return flipped.size() <= max_changed;
  }

  void NewtonFactorisation::drop_used()
  {
    kept.erase(std::find_if(kept.begin(), kept.end(), [&](const auto &one) { return one.get() == used; }));
    used = nullptr;
  }

  bool NewtonFactorisation::wants_another(const double gain) const
  {
    if (is_distrusted)
      return true;
    if (!is_earlier || n_solves >= most_solves)
      return gain >= largest_gain_alone;
    return gain >= largest_gain_in_march || (gain >= largest_gain_alone && excess >= price);
  }

  bool NewtonFactorisation::prepare(const ContactProblem &problem, const NewtonJacobian &J,
                                    const std::vector<ContactStatus> &now, const double gain,
                                    unsigned int &factorisations)
  {
    if (A.lock() != problem.A || force_given != problem.force_given())
    {
      forget();
      responses.clear();
      n_problems = 1;
      A = problem.A;
      force_given = problem.force_given();
    }
    if (n_solves == 0 || (used && !(used->points == J.points() && find_flipped(now))))
    {
      Factors *const before = used;
      used = nearest(J);
      if (used)
        find_flipped(now);
      if (used != before)
        last_direction.reinit(0);
      is_earlier = used != nullptr;
    }
    if (used && !wants_another(gain))
    {
      used->last_used = n_problems;
      if (flipped == used->changed)
        return true;
      if (flipped.size() <= max_changed)
      {
        if (update(*problem.A, J))
          return true;
        drop_used();
      }
    }
    ++factorisations;
    return factorise(problem, J, now);
  }

  const DenseMatrix &NewtonFactorisation::response_of(const ContactOperator &of,
                                                      const std::vector<unsigned int> &points)
  {
    const auto known = std::find_if(responses.begin(), responses.end(),
                                    [&](const Response &one) { return one.points == points; });
    if (known != responses.end())
      std::rotate(responses.begin(), known, known + 1);
    else
    {
      Response found;
      found.points = points;
      of.extract(points, found.matrix);
      if (responses.size() == most_responses)
        responses.pop_back();
      responses.insert(responses.begin(), std::move(found));
    }
    return responses.front().matrix;
  }

  bool NewtonFactorisation::factorise(const ContactProblem &problem, const NewtonJacobian &J,
                                      const std::vector<ContactStatus> &now)
  {
    const DenseMatrix &response = response_of(*problem.A, J.points());
    last_direction.reinit(0);
    is_earlier = is_distrusted = false;
    excess = 0;
    if (kept.size() == most_kept)
      kept.erase(std::min_element(kept.begin(), kept.end(),
                                  [](const auto &a, const auto &b) { return a->last_used < b->last_used; }));
    kept.push_back(std::make_unique<Factors>());
    used = kept.back().get();
    used->last_used = n_problems;
    used->points = J.points();
    for (const unsigned int i : used->points)
      used->status.push_back(now[i]);
    used->rows = J.rows_of_points();
    J.assemble(response, used->lu);
    if (n_problems > 1 && J.size() >= few_unknowns && used->single_lu.factorise(used->lu))
      return true;
    if (factorise_lu(used->lu))
      return true;
    drop_used();
    return false;
  }

  bool NewtonFactorisation::update(const ContactOperator &of, const NewtonJacobian &J)
  {
    Factors &f = *used;
    const DenseMatrix &response = response_of(of, f.points);
    const unsigned int m = f.points.size(), size = J.size(), n_flipped = flipped.size(),
                       t = J.n_components() - 1;
    DenseMatrix Z(size, t * n_flipped);
    DenseVector column(size);
    f.differences.reinit(t * n_flipped, size);
    for (unsigned int i = 0; i < n_flipped; ++i)
    {
      const unsigned int k = flipped[i];
      const auto known = std::find(f.changed.begin(), f.changed.end(), k);
      for (unsigned int c = 0; c < t; ++c)
      {
        if (known != f.changed.end())
          std::copy_n(&f.columns(0, t * (known - f.changed.begin()) + c), size, column.begin());
        else
        {
          column = 0;
          column[(c + 1) * m + k] = 1;
          if (!solve_by_lu(column))
            return false;
        }
        std::copy(column.begin(), column.end(), &Z(0, t * i + c));
      }
      J.assemble_difference(k, f.rows[k], response, f.differences, t * i);
    }
    f.columns = Z;
    f.changed = flipped;
    f.pairs.clear();
    last_direction.reinit(0);
    if (n_flipped == 0)
      return true;
    f.small.reinit(t * n_flipped);
    f.differences.mmult(f.small, f.columns);
    for (unsigned int i = 0; i < t * n_flipped; ++i)
      f.small(i, i) += 1;
    return factorise_lu(f.small);
  }

  bool NewtonFactorisation::solve(DenseVector &x)
  {
    ++n_solves;
    if (!is_earlier)
      return solve_by_factors(x);
    if (last_direction.size() == x.size() && direction_taken)
    {
      last_residual -= x;
      used->pairs.add(last_residual, last_direction);
    }
    last_residual = x;
    const DenseVector known = used->pairs.take_known_part(x);
    if (!solve_by_factors(x))
      return false;
    x += known;
    last_direction = x;
    direction_taken = false;
    return true;
  }

  bool NewtonFactorisation::solve_by_factors(DenseVector &x)
  {
    if (!solve_by_lu(x))
      return false;
    if (used->changed.empty())
      return true;
    DenseVector shares(used->small.m()), correction(x.size());
    used->differences.vmult(shares, x);
    used->small.solve(shares);
    used->columns.vmult(correction, shares);
    x -= correction;
    return true;
  }

  bool NewtonFactorisation::solve_by_lu(DenseVector &x)
  {
    Factors &f = *used;
    if (f.single_lu.empty())
    {
      f.lu.solve(x);
      return true;
    }
    const bool is_first = f.lu.m() > 0;
    if (is_first)
      right_side = x;
    f.single_lu.solve(x);
    if (!is_first)
      return true;

    DenseVector defect(x.size());
    f.lu.vmult(defect, x);
    defect -= right_side;
    if (defect.l2_norm() <= largest_single_defect * right_side.l2_norm())
    {
      f.lu.reinit(0);
      return true;
    }
    f.single_lu.clear();
    x = right_side;
    if (!factorise_lu(f.lu))
      return false;
    f.lu.solve(x);
    return true;
  }
} // namespace vibrocontact

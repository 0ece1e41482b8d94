#include <vibrocontact/contact/newton_factorisation.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    /// more changed points than this are factorised; of matrices that are condensed, which cost less, more than so many new ones
    constexpr unsigned int max_changed = 24, max_new_of_condensed = 8;
    /// of the residual that a step leaves: factors of this problem have to reduce it by ten at a stroke, those of an earlier one
    /// are mended by secants
    constexpr double largest_gain_alone = 0.1, largest_gain_in_march = 0.9;
    /// with factors of an earlier problem; from then on they count as its own
    constexpr unsigned int most_solves = 15;
    /// of factorising J itself, in steps of Newton's method
    constexpr double price_of_whole = 60, least_price = 2;
    constexpr unsigned int most_kept = 24;
    /// sets of points whose entries of A are at hand
    constexpr unsigned int most_responses = 2;
    /// unknowns below which single precision saves nothing
    constexpr unsigned int few_unknowns = 100;
    /// of the unknowns, that may be left of a matrix that is condensed
    constexpr double largest_condensed = 0.85;
    /// of the active points, that an inverse may have besides
    constexpr double largest_surplus = 0.15;
    /// matrices that an inverse has to serve, at its price of four, to be made again as soon; the longest wait for another one
    constexpr unsigned int least_by_inverse = 4, longest_without_inverse = 64;

    bool same(const DenseVector &a, const DenseVector &b)
    {
      return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
    }

    /// Square of what the tangential rows differ by, and the number of points that are open in one alone; from a limit on it is
    /// not looked further.
    double distance(const NewtonJacobian::Rows &a, const NewtonJacobian::Rows &b, const double limit)
    {
      double sum = 0;
      for (std::size_t k = 0; k < a.size() && sum < limit; ++k)
      {
        sum += (a[k].by_gap == 0) != (b[k].by_gap == 0) ? 1 : 0;
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double radius = a[k].by_radius[c] - b[k].by_radius[c],
                       x = a[k].by_trial[c][0] - b[k].by_trial[c][0],
                       y = a[k].by_trial[c][1] - b[k].by_trial[c][1];
          sum += radius * radius + x * x + y * y;
        }
      }
      return sum;
    }
  } // namespace

  void NewtonFactorisation::forget()
  {
    A.reset();
    kept.clear();
    used = nullptr;
    inverse.reset();
    n_without_inverse = n_by_inverse = 0;
    wanted_without_inverse = 1;
    n_problems = n_solves = 0;
    excess = 0;
    last_direction.reinit(0);
  }

  bool NewtonFactorisation::distrust()
  {
    // no direction has come from it, or it was blamed before and none has come since
    if (n_solves == 0 || is_distrusted)
      return false;
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
                                [](const auto &one) { return one->at().size() >= few_unknowns; }),
                 kept.end());
      used = nullptr;
    }
    is_earlier = used != nullptr;
    last_direction.reinit(0);
  }

  void NewtonFactorisation::look_at(const NewtonJacobian &J, const std::vector<ContactStatus> &status)
  {
    on_active.take(J, J.points(), status, J.approach_scale());
    if (inverse && inverse->covers(J.points()))
      on_inverse.take(J, inverse->points(), status, inverse->scale(0));
    else
      on_inverse.points.clear();
  }

  bool NewtonFactorisation::has_few_changes(const NewtonFactors &factors) const
  {
    const std::vector<unsigned int> changed = factors.changed_points(as_in(factors));
    return changed.size() <= max_changed &&
           (!factors.is_condensed() || factors.n_new(changed) <= max_new_of_condensed);
  }

  NewtonFactors *NewtonFactorisation::nearest() const
  {
    NewtonFactors *best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](NewtonFactors &one)
    {
      if (!has_same_points(one))
        return;
      const double now = distance(one.at().rows, as_in(one).rows, least);
      if (now < least && has_few_changes(one))
      {
        least = now;
        best = &one;
      }
    };
    // most often the next are those of the last problem
    if (used)
      look_at(*used);
    for (const std::unique_ptr<NewtonFactors> &one : kept)
      if (one.get() != used)
        look_at(*one);
    return best;
  }

  void NewtonFactorisation::drop_used()
  {
    kept.erase(std::find_if(kept.begin(), kept.end(), [&](const auto &one) { return one.get() == used; }));
    used = nullptr;
  }

  double NewtonFactorisation::price() const
  {
    const double left = double(used->n_factorised()) / used->at().size();
    return std::max(least_price, price_of_whole * left * left);
  }

  bool NewtonFactorisation::wants_another(const double gain) const
  {
    if (is_distrusted)
      return true;
    if (!is_earlier || n_solves >= most_solves)
      return gain >= largest_gain_alone;
    return gain >= largest_gain_in_march || (gain >= largest_gain_alone && excess >= price());
  }

  bool NewtonFactorisation::prepare(const ContactProblem &problem, const NewtonJacobian &J,
                                    const std::vector<ContactStatus> &status, const double gain,
                                    unsigned int &factorisations)
  {
    if (!is_of(problem))
    {
      forget();
      responses.clear();
      n_problems = 1;
      A = problem.A;
      force_given = problem.force_given();
      by_approach = problem.by_approach;
      to_force = problem.to_force;
    }
    look_at(J, status);
    if (n_solves == 0 || (used && !(has_same_points(*used) && has_few_changes(*used))))
    {
      const NewtonFactors *const before = used;
      used = nearest();
      if (used != before)
        last_direction.reinit(0);
      is_earlier = used != nullptr;
    }
    if (used && !wants_another(gain))
    {
      used->last_used = n_problems;
      const JacobianOnPoints &now = as_in(*used);
      const std::vector<unsigned int> changed = used->changed_points(now);
      set_places(J);
      if (used->has(now, changed))
        return true;
      last_direction.reinit(0);
      if (used->update(now, changed,
                       used->is_condensed() ? DenseMatrix() : response_rows(*problem.A, J, changed)))
        return true;
      drop_used();
    }
    ++factorisations;
    const bool may_condense = !(is_condensed() && !is_earlier && used->changed_points(as_in(*used)).empty());
    return factorise(problem, J, status, may_condense);
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

  DenseMatrix NewtonFactorisation::response_rows(const ContactOperator &of, const NewtonJacobian &J,
                                                 const std::vector<unsigned int> &of_points)
  {
    const DenseMatrix &response = response_of(of, J.points());
    const unsigned int m = J.points().size(), components = J.n_components();
    DenseMatrix rows(components * of_points.size(), J.size());
    for (unsigned int i = 0; i < of_points.size(); ++i)
    {
      const std::array<double, 3> to_approach = J.response_to_approach(of_points[i]);
      for (unsigned int c = 0; c < components; ++c)
      {
        for (unsigned int column = 0; column < components * m; ++column)
          rows(components * i + c, column) = response(c * m + of_points[i], column);
        if (force_given)
          rows(components * i + c, components * m) = approach_factor * to_approach[c];
      }
    }
    return rows;
  }

  std::vector<unsigned int> NewtonFactorisation::points_in_use(const ContactProblem &problem,
                                                               const NewtonJacobian &J) const
  {
    const auto is_few = [&](const std::vector<unsigned int> &points)
    { return points.size() <= (1 + largest_surplus) * J.points().size(); };
    std::vector<unsigned int> result(problem.n_points()), both;
    std::iota(result.begin(), result.end(), 0u);
    if (is_few(result))
      return result;
    result = J.points();
    for (const std::unique_ptr<NewtonFactors> &one : kept)
    {
      both.clear();
      std::set_union(result.begin(), result.end(), one->at().points.begin(), one->at().points.end(),
                     std::back_inserter(both));
      if (is_few(both))
        result = both;
    }
    return result;
  }

  bool NewtonFactorisation::is_of(const ContactProblem &problem) const
  {
    return A.lock() == problem.A && force_given == problem.force_given() &&
           (!force_given || (same(by_approach, problem.by_approach) && same(to_force, problem.to_force)));
  }

  bool NewtonFactorisation::find_inverse(const ContactProblem &problem, const NewtonJacobian &J,
                                         const std::vector<ContactStatus> &status)
  {
    const unsigned int left = condensed_size(on_active.rows, on_active.components);
    const auto pays = [&](const unsigned int n_points)
    {
      const unsigned int n_open = n_points - on_active.points.size();
      return left + on_active.components * n_open <= largest_condensed * on_active.size();
    };
    if (!pays(on_active.points.size()))
      return false;
    if (on_inverse.points.empty() || !pays(on_inverse.points.size()))
    {
      if (n_without_inverse < wanted_without_inverse)
      {
        ++n_without_inverse;
        return false;
      }
      if (inverse)
        wanted_without_inverse = n_by_inverse >= least_by_inverse
                                     ? 1
                                     : std::min(2 * wanted_without_inverse, longest_without_inverse);
      n_without_inverse = n_by_inverse = 0;
      inverse = std::make_shared<InverseResponse>(problem, points_in_use(problem, J));
      kept.erase(
          std::remove_if(kept.begin(), kept.end(), [](const auto &one) { return one->is_condensed(); }),
          kept.end());
      used = nullptr;
      look_at(J, status);
    }
    if (!inverse->is_exact_enough())
      return false;
    ++n_by_inverse;
    return true;
  }

  bool NewtonFactorisation::factorise(const ContactProblem &problem, const NewtonJacobian &J,
                                      const std::vector<ContactStatus> &status, const bool may_condense)
  {
    last_direction.reinit(0);
    is_earlier = is_distrusted = false;
    excess = 0;
    const bool in_single_precision = n_problems > 1 && J.size() >= few_unknowns;
    const bool by_inverse = in_single_precision && may_condense && find_inverse(problem, J, status);
    if (kept.size() == most_kept)
      kept.erase(std::min_element(kept.begin(), kept.end(),
                                  [](const auto &a, const auto &b) { return a->last_used < b->last_used; }));
    kept.push_back(by_inverse ? std::make_unique<NewtonFactors>(on_inverse, inverse)
                              : std::make_unique<NewtonFactors>(on_active, nullptr));
    used = kept.back().get();
    used->last_used = n_problems;
    set_places(J);
    if (used->factorise([&](DenseMatrix &matrix) { J.assemble(response_of(*problem.A, J.points()), matrix); },
                        in_single_precision))
      return true;
    drop_used();
    return false;
  }

  void NewtonFactorisation::set_places(const NewtonJacobian &J)
  {
    const JacobianOnPoints &theirs = used->at();
    const unsigned int m = J.points().size(), n = theirs.points.size(), components = J.n_components();
    places.resize(J.size());
    const std::vector<unsigned int> of_points = places_among(J.points(), theirs.points);
    for (unsigned int c = 0; c < components; ++c)
      for (unsigned int k = 0; k < m; ++k)
        places[c * m + k] = c * n + of_points[k];
    if (!force_given)
      return;
    places[components * m] = components * n;
    approach_factor = theirs.approach_scale / J.approach_scale();
  }

  bool NewtonFactorisation::solve(DenseVector &x)
  {
    ++n_solves;
    const auto take = [&]
    {
      on_points.reinit(used->at().size());
      for (unsigned int i = 0; i < x.size(); ++i)
        on_points[places[i]] = x[i];
    };
    take();
    DenseVector known;
    if (is_earlier)
    {
      if (last_direction.size() == on_points.size() && direction_taken)
      {
        last_residual -= on_points;
        used->pairs.add(last_residual, last_direction);
      }
      last_residual = on_points;
      known = used->pairs.take_known_part(on_points);
    }
    if (!used->solve(on_points))
    {
      drop_used();
      return false;
    }
    if (is_earlier)
      on_points += known;
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = on_points[places[i]];
    if (is_earlier)
    {
      // without what rounding has left at open points
      take();
      last_direction = on_points;
      direction_taken = false;
    }
    if (force_given)
      x[x.size() - 1] *= approach_factor;
    return true;
  }
} // namespace vibrocontact

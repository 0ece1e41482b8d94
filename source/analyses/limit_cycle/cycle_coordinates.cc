#include <vibrocontact/analyses/limit_cycle/cycle_coordinates.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/matrix_parts.h>
#include <vibrocontact/contact/point_rows.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    /// Units to a thousandth of the largest: motions without frequency and rows that hardly yield count as slow and soft ones do.
    void raise_small(std::vector<double> &units)
    {
      double largest = 0;
      for (const double unit : units)
        largest = std::max(largest, unit);
      for (double &unit : units)
        unit = std::max(unit, 1e-3 * largest);
    }

    /// s of each of some rows [sqrt(m/N)]. @param frequency of the modes, above 0
    std::vector<double> roots_of_flexibility(const ContactPair &pair, const std::vector<unsigned int> &rows,
                                             const std::vector<double> &frequency)
    {
      std::vector<double> roots;
      for (const unsigned int row : rows)
      {
        double flexibility = pair.residual(row, row);
        for (unsigned int k = 0; k < pair.n_modes(); ++k)
          flexibility += std::pow(pair.trace(row, k) / frequency[k], 2);
        for (unsigned int k = 0; k < pair.n_poles(); ++k)
          flexibility += 2 * std::abs(pair.right(row, k) * pair.left(row, k) / pair.poles[k]);
        roots.push_back(std::sqrt(flexibility));
      }
      raise_small(roots);
      return roots;
    }
  } // namespace

  CycleCoordinates::CycleCoordinates(const ContactPair &pair, const std::vector<unsigned int> &points,
                                     const bool with_rates)
      : pair(pair), points(points), rows(rows_of_points(pair.n_points(), points)), with_rates(with_rates)
  {
    std::vector<double> frequency = pair.omega, of_poles;
    double fastest = 0;
    for (const double omega : frequency)
      fastest = std::max(fastest, omega);
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
    {
      fastest = std::max(fastest, std::abs(pair.poles[k]));
      of_poles.push_back(2 * std::abs(pair.poles[k]) * amplitude_per_state(pair, k));
    }
    raise_small(frequency);
    raise_small(of_poles);
    const std::vector<double> roots = roots_of_flexibility(pair, rows, frequency);
    units = frequency;
    units.insert(units.end(), pair.n_modes(), 1.);
    for (unsigned int part = 0; part < 2; ++part)
      units.insert(units.end(), of_poles.begin(), of_poles.end());
    units.insert(units.end(), roots.begin(), roots.end());
    for (unsigned int i = points.size(); i < rows.size() && with_rates; ++i)
      units.push_back(1 / (fastest * roots[i]));

    trace = rows_at(pair.trace, rows);
    left_parts.reinit(rows.size(), 2 * pair.n_poles());
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        left_parts(i, k) = pair.left(rows[i], k).real();
        left_parts(i, pair.n_poles() + k) = pair.left(rows[i], k).imag();
      }
  }

  DenseVector CycleCoordinates::pack(const DynamicState &state) const
  {
    const unsigned int n_modes = pair.n_modes(), n_poles = pair.n_poles();
    DenseVector x(size());
    std::copy(state.q.begin(), state.q.end(), x.begin());
    std::copy(state.v.begin(), state.v.end(), x.begin() + n_modes);
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      x[2 * n_modes + k] = state.z[k].real();
      x[2 * n_modes + n_poles + k] = state.z[k].imag();
    }
    for (unsigned int i = 0; i < rows.size(); ++i)
      x[n_motion() + i] = state.R[rows[i]];
    for (unsigned int i = first_rate(); i < size(); ++i)
      x[i] = state.residual_rate[rows[points.size() + i - first_rate()]];
    for (unsigned int i = 0; i < size(); ++i)
      x[i] *= units[i];
    return x;
  }

  DynamicState CycleCoordinates::unpack(const DenseVector &x, DynamicState held) const
  {
    const unsigned int n_modes = pair.n_modes(), n_poles = pair.n_poles();
    const auto physical = [&](const unsigned int i) { return x[i] / units[i]; };
    held.q.clear();
    held.v.clear();
    held.z.clear();
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      held.q.push_back(physical(k));
      held.v.push_back(physical(n_modes + k));
    }
    for (unsigned int k = 0; k < n_poles; ++k)
      held.z.emplace_back(physical(2 * n_modes + k), physical(2 * n_modes + n_poles + k));
    held.R.reinit(3 * pair.n_points());
    for (unsigned int i = 0; i < rows.size(); ++i)
      held.R[rows[i]] = physical(n_motion() + i);
    complete(pair, {}, held);
    for (unsigned int i = first_rate(); i < size(); ++i)
      held.residual_rate[rows[points.size() + i - first_rate()]] = physical(i);
    return held;
  }

  std::vector<unsigned int> CycleCoordinates::force_rows(const std::vector<unsigned int> &some) const
  {
    std::vector<unsigned int> places;
    for (const unsigned int point : some)
      places.push_back(std::lower_bound(points.begin(), points.end(), point) - points.begin());
    std::vector<unsigned int> result = rows_of_points(points.size(), places);
    for (unsigned int &row : result)
      row += n_motion();
    return result;
  }

  std::vector<unsigned int> CycleCoordinates::rate_rows(const std::vector<unsigned int> &some) const
  {
    if (!with_rates)
      return {};
    std::vector<unsigned int> result = force_rows(some);
    result.erase(result.begin(), result.begin() + some.size());
    for (unsigned int &row : result)
      row += 2 * points.size();
    return result;
  }

  void CycleCoordinates::take_motion(const StateChanges &changes, DenseMatrix &x) const
  {
    add_block(x, changes.q, 0, 0);
    add_block(x, changes.v, pair.n_modes(), 0);
    add_block(x, changes.poles, 2 * pair.n_modes(), 0);
    for (unsigned int j = 0; j < x.n(); ++j)
      for (unsigned int i = 0; i < n_motion(); ++i)
        x(i, j) *= units[i];
  }

  void CycleCoordinates::set_motion(const DenseMatrix &x, StateChanges &changes) const
  {
    unsigned int begin = 0;
    const auto next = [&](const unsigned int n_rows)
    {
      DenseMatrix part(n_rows, x.n());
      for (unsigned int j = 0; j < x.n(); ++j)
        for (unsigned int i = 0; i < n_rows; ++i)
          part(i, j) = x(begin + i, j) / units[begin + i];
      begin += n_rows;
      return part;
    };
    changes.q = next(pair.n_modes());
    changes.v = next(pair.n_modes());
    changes.poles = next(2 * pair.n_poles());
    changes.approach.assign(x.n(), 0.);
  }

  DenseMatrix CycleCoordinates::forces_in(const DenseMatrix &x, const std::vector<unsigned int> &some) const
  {
    const std::vector<unsigned int> of_forces = force_rows(some);
    DenseMatrix R(of_forces.size(), x.n());
    for (unsigned int j = 0; j < x.n(); ++j)
      for (unsigned int i = 0; i < of_forces.size(); ++i)
        R(i, j) = x(of_forces[i], j) / units[of_forces[i]];
    return R;
  }

  StateChanges CycleCoordinates::changes_of(const DenseMatrix &x, const StepOnPoints &on) const
  {
    StateChanges changes;
    set_motion(x, changes);
    const DenseMatrix R = forces_in(x, points);
    changes.modal_force.reinit(pair.n_modes(), x.n());
    changes.pole_force.reinit(2 * pair.n_poles(), x.n());
    if (pair.n_modes() > 0)
      trace.Tmmult(changes.modal_force, R);
    if (pair.n_poles() > 0)
      left_parts.Tmmult(changes.pole_force, R);
    const std::vector<unsigned int> on_grid = rows_of_points(pair.n_points(), on.points),
                                    along(on_grid.begin() + on.n_points(), on_grid.end()),
                                    of_rates = rate_rows(on.points);
    changes.rate_reference = product(entries_at(pair.residual, along, rows), R);
    for (unsigned int j = 0; j < x.n(); ++j)
      for (unsigned int i = 0; i < of_rates.size(); ++i)
        changes.rate_reference(i, j) += on.lead * x(of_rates[i], j) / units[of_rates[i]];
    return changes;
  }

  DenseMatrix CycleCoordinates::packed(const StateChanges &changes, const StepOnPoints &on) const
  {
    DenseMatrix x(size(), changes.n_columns());
    take_motion(changes, x);
    const std::vector<unsigned int> of_forces = force_rows(on.points), of_rates = rate_rows(on.points);
    for (unsigned int j = 0; j < x.n(); ++j)
      for (unsigned int i = 0; i < of_forces.size(); ++i)
        x(of_forces[i], j) = units[of_forces[i]] * changes.R(i, j);
    if (of_rates.empty())
      return x;
    const DenseMatrix displacement = product(on.slip_flexibility, changes.R);
    for (unsigned int j = 0; j < x.n(); ++j)
      for (unsigned int i = 0; i < of_rates.size(); ++i)
        x(of_rates[i], j) =
            units[of_rates[i]] * (changes.rate_reference(i, j) - displacement(i, j)) / on.lead;
    return x;
  }

  double CycleCoordinates::unit_of_shapes() const
  {
    return *std::max_element(units.begin() + n_motion(), units.begin() + first_rate());
  }

  std::vector<double> CycleCoordinates::units_along(const StepOnPoints &on) const
  {
    const std::vector<unsigned int> of_forces = force_rows(on.points);
    std::vector<double> result;
    for (unsigned int i = on.n_points(); i < of_forces.size(); ++i)
      result.push_back(1 / units[of_forces[i]]);
    return result;
  }

  unsigned int CycleCoordinates::n_lasting(const StepOnPoints &on) const
  {
    return n_motion() + on.n_loaded + 2 * on.n_points();
  }

  DenseMatrix CycleCoordinates::lasting(const StateChanges &changes, const StepOnPoints &on) const
  {
    const unsigned int first_reference = n_motion() + on.n_loaded;
    const double of_shapes = unit_of_shapes();
    const std::vector<double> along = units_along(on);
    DenseMatrix y(n_lasting(on), changes.n_columns());
    take_motion(changes, y);
    for (unsigned int j = 0; j < y.n(); ++j)
    {
      for (unsigned int k = 0; k < on.n_loaded; ++k)
        y(n_motion() + k, j) = of_shapes * changes.shape_force(k, j);
      for (unsigned int i = 0; i < along.size(); ++i)
        y(first_reference + i, j) = along[i] * changes.rate_reference(i, j);
    }
    return y;
  }

  StateChanges CycleCoordinates::changes_of_lasting(const DenseMatrix &y, const StepOnPoints &on) const
  {
    const unsigned int first_reference = n_motion() + on.n_loaded;
    const double of_shapes = unit_of_shapes();
    const std::vector<double> along = units_along(on);
    StateChanges changes;
    set_motion(y, changes);
    changes.shape_force.reinit(on.rank(), y.n());
    changes.rate_reference.reinit(along.size(), y.n());
    for (unsigned int j = 0; j < y.n(); ++j)
    {
      for (unsigned int k = 0; k < on.n_loaded; ++k)
        changes.shape_force(k, j) = y(n_motion() + k, j) / of_shapes;
      for (unsigned int i = 0; i < along.size(); ++i)
        changes.rate_reference(i, j) = y(first_reference + i, j) / along[i];
    }
    on.feed(changes);
    return changes;
  }

  DenseMatrix CycleCoordinates::lasting_of(const DenseMatrix &x, const StepOnPoints &on) const
  {
    StateChanges changes = changes_of(x, on);
    changes.shape_force.reinit(on.rank(), x.n());
    on.shapes.basis.Tmmult(changes.shape_force, forces_in(x, on.points));
    return lasting(changes, on);
  }
} // namespace vibrocontact

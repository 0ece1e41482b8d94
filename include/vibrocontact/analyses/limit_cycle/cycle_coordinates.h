#pragma once

#include <vibrocontact/analyses/limit_cycle/step_derivative.h>

#include <vector>

namespace vibrocontact
{
  /// The state of a periodic motion as one vector, in units of the root of an energy [sqrt(J)], and changes of it as StateChanges.
  ///
  /// It is all that the next step depends on: w q and v of every mode, real and imaginary parts of the states of the poles, as if these
  /// were modes, then s R of the rows of the points that may touch, s^2 the flexibility of the row itself. With rates r / (s w)
  /// follows, r the rates of the residual displacements of these points along the surface, w the fastest frequency; those of
  /// points that never touch in a period matter to nothing, and CycleMap::march() takes them for zero at its end.
  ///
  /// What of it lasts a period is less, for residual displacements and forces are those of their step: modes and poles as above, then of
  /// the forces what they do to the shapes, and the references of the rate (ContactStepper::reference_of_rate()) of the points that
  /// derivatives stand on.
  class CycleCoordinates
  {
  public:
    /// @param pair is referred to @param points of the grid that may touch, ascending @param with_rates whether the state has them
    CycleCoordinates(const ContactPair &pair, const std::vector<unsigned int> &points, bool with_rates);

    unsigned int size() const { return units.size(); }
    /// of these, modes and poles, which stand first
    unsigned int n_motion() const { return 2 * (pair.n_modes() + pair.n_poles()); }
    DenseVector pack(const DynamicState &state) const;
    /// The state of a vector. @param held what else it has: approach, hub acceleration and given force
    DynamicState unpack(const DenseVector &x, DynamicState held) const;
    /// Rows of the state with the rates of some of the points; none without rates.
    std::vector<unsigned int> rate_rows(const std::vector<unsigned int> &some) const;

    /// Changes of states, one per column, on the points of a step, and back.
    StateChanges changes_of(const DenseMatrix &x, const StepOnPoints &on) const;
    DenseMatrix packed(const StateChanges &changes, const StepOnPoints &on) const;

    // of what lasts:
    unsigned int n_lasting(const StepOnPoints &on) const;
    DenseMatrix lasting(const StateChanges &changes, const StepOnPoints &on) const;
    StateChanges changes_of_lasting(const DenseMatrix &y, const StepOnPoints &on) const;
    /// of changes of the state, one per column
    DenseMatrix lasting_of(const DenseMatrix &x, const StepOnPoints &on) const;

  private:
    unsigned int first_rate() const { return n_motion() + rows.size(); }
    /// Rows of the state with the forces of some of the points.
    std::vector<unsigned int> force_rows(const std::vector<unsigned int> &some) const;
    /// Modes and poles of changes and of the state, n_motion() rows.
    void set_motion(const DenseMatrix &x, StateChanges &changes) const;
    void take_motion(const StateChanges &changes, DenseMatrix &x) const;
    /// Forces on some points, one change per column [N].
    DenseMatrix forces_in(const DenseMatrix &x, const std::vector<unsigned int> &some) const;
    /// of what lasts: of forces on shapes [sqrt(m/N)], and of references of the rate on the points of a step,
    /// 2 n_points [sqrt(N/m)]
    double unit_of_shapes() const;
    std::vector<double> units_along(const StepOnPoints &on) const;

    const ContactPair &pair;
    const std::vector<unsigned int> points;
    /// of points on the grid, 3 n_points, by component
    const std::vector<unsigned int> rows;
    const bool with_rates;
    /// of every entry of the state
    std::vector<double> units;
    /// Psi on the rows; left shapes of the poles there, real parts beside imaginary ones
    DenseMatrix trace, left_parts;
  };
} // namespace vibrocontact

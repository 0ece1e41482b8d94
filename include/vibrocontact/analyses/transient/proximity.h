#pragma once

#include <vibrocontact/analyses/transient/dynamic_state.h>
#include <vibrocontact/analyses/transient/step_operator.h>

#include <vector>

namespace vibrocontact
{
  /// Which points of the grid enter the contact problem of a step, DynamicState::nearby: those loaded or with a small gap, and what
  /// earlier searches found so as long as these are few.
  ///
  /// Gaps of the other points are known from the last look at them, in DynamicState::contact. Open nearby points show how far
  /// gaps have changed since, taken twice: when any other point could have closed, the others are looked at again, and all points
  /// are searched when one of them is closed, when looks come often, and after some steps in any case, which also computes
  /// W~ R anew.
  class Proximity
  {
  public:
    /// @param constant_response gap and slip without forces, 3 n; @param by_approach rows of gap and slip per approach, 3 n; all
    /// are referred to
    Proximity(const ContactPair &pair, const StepMatrices &matrices, const DenseVector &constant_response,
              const DenseVector &by_approach)
        : pair(pair), matrices(matrices), constant_response(constant_response), by_approach(by_approach)
    {
    }

    /// Whether a point that is not nearby had, at the last look, a gap of at most the distance [m].
    bool another_within(const DynamicState &state, double distance) const;
    bool search_is_due(const DynamicState &state) const;
    /// Gaps of all points at the beginning of a step, and from them the nearby ones. @param shapes their amplitudes then
    void search(DynamicState &state, const DenseVector &shapes) const;
    /// Gaps of the others at the beginning of a step. @param nearby of DynamicState::nearby
    void look_at_others(DynamicState &state, const StepOperator &nearby, const DenseVector &shapes) const;
    /// Other points that are closed at the end of a step. @param residual (W~ R)_n of the others [m]
    std::vector<unsigned int> closed_others(const DynamicState &state, const StepOperator &nearby,
                                            const DenseVector &residual, const DenseVector &shapes,
                                            double approach, double force) const;
    /// Fastest change of a gap by displacements of the shapes with these velocities [m/s]; 0 where all points are always nearby.
    double gap_speed(const DenseVector &shape_velocities) const;
    /// How far points that are not nearby move in a step at most [m]; infinite if nobody knows. @param gap_speed at its faster end
    double motion_of_others(const DynamicState &state, const StepOperator &nearby,
                            const ContactSolution &solution, double gap_speed) const;
    /// A step is over, whose state still is that of its beginning. @param gap_speed at its end
    void end_step(DynamicState &state, const StepOperator &nearby, const ContactSolution &solution,
                  double gap_speed) const;

  private:
    /// Gap of a point [m]. @param force Drive::force; @param residual W~ R there [m]
    double gap_at(unsigned int point, const DynamicState &state, double residual, const DenseVector &shapes,
                  double approach, double force) const;
    /// How far open nearby points move in a step [m]; infinite if there is none. @param solution of the step
    double motion_of_open_points(const DynamicState &state, const StepOperator &nearby,
                                 const ContactSolution &solution) const;

    const ContactPair &pair;
    const StepMatrices &matrices;
    const DenseVector &constant_response, &by_approach;
  };
} // namespace vibrocontact

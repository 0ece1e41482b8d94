#pragma once

#include <vibrocontact/marching/dynamic_state.h>
#include <vibrocontact/marching/step_operator.h>

#include <vector>

namespace vibrocontact
{
  /// Which points of the grid enter the contact problem of a step, DynamicState::nearby: those loaded or with a small gap, and what
  /// earlier searches found so as long as these are few.
  ///
  /// Gaps of the other points follow the shapes and the approach in every step. What W~ R adds is known from the last look at them; the
  /// nearby points, where the forces are, show how far it has moved since, taken twice. When any other point could have closed, they
  /// are looked at again, and all points are searched when one of them is closed, when looks come often, and after some
  /// steps in any case, which also computes W~ R anew.
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

    bool search_is_due(const DynamicState &state) const;
    /// Gaps of all points at the beginning of a step, and from them the nearby ones. @param shapes their amplitudes then
    void search(DynamicState &state, const DenseVector &shapes) const;
    /// Gaps of the points that are not nearby [m], but for what W~ R has moved since the last look at them. (Those of the nearby points
    /// have W~ R of the beginning of the step.) @param shapes displacements of the shapes @param force Drive::force
    void set_gaps(const DynamicState &state, const DenseVector &shapes, double approach, double force,
                  DenseVector &gaps) const;
    /// Adds how far W~ R may have moved other points in a step, whose state still is that of its beginning.
    void note_motion(DynamicState &state, const StepOperator &nearby, const ContactSolution &solution) const;
    /// Whether other points may be closed. @param gaps set_gaps() at the end of a step whose motion was noted
    bool may_close_another(const DynamicState &state, const StepOperator &nearby,
                           const DenseVector &gaps) const;
    /// Takes W~ R of the other points at the end of a step [m] into account. @return those that are closed
    std::vector<unsigned int> look_at_others(DynamicState &state, const StepOperator &nearby,
                                             const DenseVector &residual, DenseVector &gaps) const;
    /// A step is over. @param gaps of the other points at its end
    void end_step(DynamicState &state, const StepOperator &nearby, const ContactSolution &solution,
                  const DenseVector &gaps) const;

  private:
    const ContactPair &pair;
    const StepMatrices &matrices;
    const DenseVector &constant_response, &by_approach;
  };
} // namespace vibrocontact

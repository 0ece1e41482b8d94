#pragma once

#include <vibrocontact/analyses/limit_cycle/cycle_family.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>
#include <vibrocontact/analyses/limit_cycle/period_equations.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// A place on a branch, as Newton's method has it: the state less the equilibrium at the value, which changes with it; period, value.
  using BranchPlace = std::vector<double>;

  /// Sizes that places are measured in.
  struct PlaceSizes
  {
    double state, period, value;

    double of(const std::size_t k, const std::size_t n) const
    {
      return k < n ? state : k == n ? period : value;
    }
  };

  /// The equations of follow_cycle(): unknown are the state less the equilibrium, the period and the value. BorderedCycle with both as
  /// the further unknowns.
  class BranchEquations : public PeriodEquations
  {
  public:
    /// @param family is referred to @param start a cycle at `value` @param value_size range of the values
    BranchEquations(const CycleFamily &family, const LimitCycle &start, double value, double value_size,
                    double tolerance);

    /// The last condition: steps are normal to the direction, which is in the sizes.
    void go_along(const BranchPlace &direction, const PlaceSizes &in);

    /// Of the place that was evaluated last: its state, and the size of its motion [sqrt(J)].
    const DenseVector &state() const { return start; }
    double motion() const { return from_rest.l2_norm(); }
    CycleAt &last() { return *at; }

  private:
    CycleMap &take(const std::vector<double> &z) override;
    DenseVector step() override;
    /// To that of the value that was evaluated last.
    void renew_preconditioner();
    /// Derivative of Phi - x by the value, x at its distance from the equilibrium, by a difference.
    DenseVector difference_by_value() const;

    const CycleFamily &family;
    const double value_size;
    std::shared_ptr<CycleAt> at;
    double value;
    const unsigned int n;
    std::unique_ptr<const DenseMatrix> linear;
    BranchPlace tangent;
    PlaceSizes sizes = {};
    /// that of the first place of a direction, kept while Newton's method goes on there; empty: none yet
    DenseVector by_value;
  };
} // namespace vibrocontact

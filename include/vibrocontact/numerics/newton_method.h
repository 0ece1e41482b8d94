#pragma once

#include <limits>
#include <vector>

namespace vibrocontact
{
  /// Size of F where it cannot be evaluated: larger than any other.
  constexpr double not_evaluated = std::numeric_limits<double>::max();

  /// Equations F(x) = 0 as Newton's method sees them. They keep what belongs to the last x that was evaluated: matrices,
  /// factors and work vectors are theirs, and how the step is found.
  class NewtonEquations
  {
  public:
    virtual ~NewtonEquations() = default;
    /// F at x. @return its size, in the measure in which it is to fall; not_evaluated: there is none
    virtual double evaluate(const std::vector<double> &x) = 0;
    /// Of every x that is kept, right after evaluate(). @param size of F there @return whether x will do
    virtual bool keep(const std::vector<double> &x, double size) = 0;
    /// The step -J^-1 F at the last x that was evaluated. @param renew J belongs to this x; false: factors of an earlier
    /// one may serve @return false: there is no step
    virtual bool find_step(bool renew, std::vector<double> &step) = 0;
  };

  struct NewtonSettings
  {
    unsigned int max_iterations = 40;
    /// 1, 1/2, ... down to this; 1: whole steps alone
    double shortest_length = 1. / 512;
    /// what |F| has to lose, relative to the length of the step (Armijo's rule)
    double decrease = 1e-4;
    /// Nonzero: every whole step is taken, until |F| has more than doubled so often.
    unsigned int doublings = 0;
    /// old factors serve while each step with them lowers |F| by ten
    bool keeps_factors = false;
    /// |F| below which no shorter step is tried
    double enough = 0;
  };

  struct NewtonResult
  {
    bool converged = false;
    /// steps that were found
    unsigned int iterations = 0;
    /// of F at x
    double size = 0;
    bool is_evaluated() const { return size < not_evaluated; }
  };

  /// x += length step with the first length 1, 1/2, ... at which |F| falls, until keep() says that x will do. On return x is the last that
  /// was kept; without convergence the equations may have evaluated others after it.
  NewtonResult solve_by_newton(NewtonEquations &equations, const NewtonSettings &settings,
                               std::vector<double> &x);
} // namespace vibrocontact

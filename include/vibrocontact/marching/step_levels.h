#pragma once

#include <vibrocontact/marching/contact_stepper.h>
#include <vibrocontact/marching/drive.h>
#include <vibrocontact/marching/transient_parameters.h>
#include <vibrocontact/marching/transient_result.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// Steps of the modes of a pair, one each, for a step of h [s] as Integrator, Theta and Reaction say.
  std::vector<ModalStep> modal_steps(const TransientParameters &parameters, const ContactPair &pair,
                                     double h);
  /// The same of its poles.
  StepWeights pole_steps(const TransientParameters &parameters, const ContactPair &pair, double h);

  /// Steps of the lengths Time step / 2^k, one level each: a ContactStepper with its operator and a solver with
  /// its factorisations, made when first needed and kept. Without an error tolerance there is one level.
  ///
  /// Times are whole multiples of the shortest step and a step starts at a multiple of its own length, so that
  /// a run that is continued goes the same way and the end is met.
  class StepLevels
  {
  public:
    StepLevels(const TransientParameters &parameters, const ContactSections &contact,
               const ContactSolverParameters &solver, const ContactPair &pair, double speed);

    unsigned int n_levels() const { return levels.size(); }
    /// length of the shortest step [s]
    double shortest() const { return shortest_step; }
    /// time of a state in shortest steps
    long long tick(const DynamicState &state) const;

    /// next <- state after a step of at most the length that result.level says, then <- its drive. The step is
    /// halved while its error is above the tolerance or its contact does not converge; afterwards result.level is
    /// what the next step may try. Counts iterations, repeated steps and those of the shortest length that
    /// stay above the tolerance; result.converged = false if the
    /// shortest step does not converge.
    void advance(const DynamicState &state, const DriveFunction &drive, long long last, DynamicState &next,
                 Drive &then, TransientResult &result);

    /// Forgets what the solvers keep.
    void start_afresh();

  private:
    struct Level
    {
      ContactStepper stepper;
      std::unique_ptr<ContactSolver> solver;
    };
    Level &level(unsigned int k);

    const TransientParameters &parameters;
    const ContactSections contact;
    const ContactSolverParameters &solver;
    const ContactPair &pair;
    const double speed;
    double shortest_step;
    /// shortest first
    std::vector<std::unique_ptr<Level>> levels;
  };

  /// Error of the modes in a step of h [s] over the size of their vibration [-],
  ///
  ///   e^2 = sum w^2 dq^2 / sum (v^2 + (a / w)^2),      a = p - 2 zeta w v - w^2 q
  ///
  /// dq: what the theta method leaves out of the displacement, h^2 / 12 |a1 - a0| (the next term of the
  /// Euler-Maclaurin series) and (theta - 1/2) h |v1 - v0|; for the exact propagator h^2 / 12 |p1 - p0|, the
  /// force's change, since only its course in between is not known.
  double step_error(const TransientParameters &parameters, const ContactPair &pair,
                    const DynamicState &before, const DynamicState &after);
} // namespace vibrocontact

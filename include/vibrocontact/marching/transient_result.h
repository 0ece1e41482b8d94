#pragma once

#include <vibrocontact/marching/energy_account.h>
#include <vibrocontact/marching/march.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Sums of the forces of a run, on body 1 or in one contact.
  struct ForceSums
  {
    /// normal impulse over the run [Ns] and the integral of the normal force's square [N^2 s]
    double impulse = 0, force_square = 0;
    /// integral of the tangential resultant's square [N^2 s]
    double tangential_square = 0;
    /// least gap at the ends of the steps, negative: penetration [m]
    double smallest_gap = 0;
  };

  /// Sums over a run and how it went. Of several contacts the resultants are those on body 1, normal: along z.
  struct TransientResult : ForceSums
  {
    unsigned long steps = 0, iterations = 0, factorisations = 0, fallbacks = 0;
    /// steps that were repeated with half their length; the next step is 2^level of the shortest
    unsigned long rejected = 0;
    /// steps of the shortest length whose error is above the tolerance all the same
    unsigned long above_tolerance = 0;
    unsigned int level = 0;
    double time = 0, seconds = 0;
    /// of each contact
    std::vector<ForceSums> contacts;
    EnergyAccount energy;
    bool converged = true;
    /// why it did not
    std::string message;

    /// Of a mode, over what of the second half of the run counts (TransientMarch): the time, and integrals of q, q^2 and v^2.
    struct ModalMotion
    {
      double time = 0, q = 0, q_square = 0, v_square = 0;
    };
    std::vector<ModalMotion> modal_motions;
    /// the middle of the run that they were begun for [s]
    double middle = 0;

    /// of the normal force, of what it departs from its mean by, and of the tangential resultant, over the run [N]
    double rms_force() const;
    double rms_variation() const;
    double rms_tangential() const;
  };

  /// Errors of a run that its steps are the reason of, relative [-]: what a run with twice the step differs by
  /// (doubled_step_error()), a third of it for schemes of second order. No less than half of the energy share that the time
  /// scheme took, than half of its own root mean square over the last quarter of the run (runs in vibration pass each other,
  /// and agree there by chance), and of the impulse than a fifth of the error of the rms force.
  struct StepErrors : MarchErrors
  {
    /// of the rms that the normal force departs from its mean by, no less than a thousandth of the rms force being its size [-]
    double rms_variation = 0;
    /// of the rms tangential resultant until then; of less than a thousandth of the normal force, of that [-]
    double rms_tangential = 0;
    /// integrals over the last quarter so far: of 1 and of the squares of what both runs tell [s]
    double averaged_time = 0, impulse_square = 0, rms_square = 0;
    /// where that quarter begins [s]: a run that is resumed with another end begins another one
    double last_quarter = 0;
  };
} // namespace vibrocontact

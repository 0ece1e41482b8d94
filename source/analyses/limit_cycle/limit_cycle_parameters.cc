#include <vibrocontact/analyses/limit_cycle/limit_cycle_parameters.h>

namespace vibrocontact
{
  void LimitCycleParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Time step", time_step,
                      "The period of a root is divided into whole steps of at most this length. Their number "
                      "stays while the period is found. Units: s.",
                      Double(1e-12, 1e3));
    prm.add_parameter("Start", start,
                      "Where cycles are sought from: the unstable roots of the rolling equilibrium, or the "
                      "motion that a transient of the scene ends with, which leads to one cycle.",
                      Selection("roots|end of transient"));
    prm.add_parameter("Transient folder", transient_folder,
                      "Folder with the results of that transient; empty: the one in this file.",
                      DirectoryName());
    prm.add_parameter("Roots", roots,
                      "Frequencies of the unstable roots of the rolling equilibrium from which cycles are "
                      "sought, to 1 %; empty: all. Units: Hz.",
                      List(Double(0, 1e9), 0, 1000, ","));
    prm.add_parameter("Tolerance", tolerance,
                      "Change of the state over a period, over its distance from the equilibrium, both as "
                      "the root of an energy. Units: none.",
                      Double(1e-14, 1e-2));
    prm.add_parameter("Max Newton iterations", max_newton_iterations,
                      "Of each start for a cycle, of which there are up to five, and of each number of "
                      "harmonics. Units: none.",
                      Integer(1, 1000));
    prm.add_parameter("Multipliers", n_multipliers,
                      "How many of the Floquet multipliers are listed, the largest; 0: stability is not "
                      "looked at. Units: none.",
                      Integer(0, 1000000));
    prm.add_parameter(
        "Error estimate", error_estimate,
        "Whether each cycle is found once more in half or twice as many steps, which tells the error "
        "of the steps. A cycle with more than 20 % of error, or with an unknown one, has not converged. "
        "Units: none.");
    prm.add_parameter(
        "Harmonics", harmonics,
        "Numbers of harmonics with which each cycle that was found is found by harmonic balance "
        "as well, for instance 1, 3, 5, 10, 20; empty: it is not. Units: none.",
        List(Integer(1, 1000), 0, 100, ","));
    prm.enter_subsection("Branch");
    branch.declare_parameters(prm);
    prm.leave_subsection();
    prm.enter_subsection("Basins");
    basins.declare_parameters(prm);
    prm.leave_subsection();
  }
} // namespace vibrocontact

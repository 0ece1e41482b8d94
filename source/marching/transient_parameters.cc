#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/marching/transient_parameters.h>

#include <sstream>

namespace vibrocontact
{
  void TransientParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Model", model,
                      "What moves. reduced: modes, contact points without mass; finite elements: all dofs, "
                      "contact points with mass, for small scenes (1,500 dofs), with Reaction = end of step. "
                      "Units: none.",
                      Selection("reduced|finite elements"));
    prm.add_parameter("Time step", time_step, "Length of a step. Units: s.", Double(1e-12, 1e3));
    prm.add_parameter(
        "Error tolerance", error_tolerance,
        "0: all steps have the length Time step. Otherwise the step is halved, down to Shortest time "
        "step, while the error of the modes in one step over the size of their vibration is "
        "larger, and doubled again, up to Time step. Units: none.",
        Double(0, 1));
    prm.add_parameter("Shortest time step", shortest_step, "With an Error tolerance. Units: s.",
                      Double(0, 1e3));
    prm.add_parameter(
        "Error estimate", error_estimate,
        "A second run with twice the step beside the run, half as many steps again: their difference "
        "estimates "
        "the error of the impulse and of the rms normal force; false: no estimate. Units: none.",
        Bool());
    prm.add_parameter("End time", end_time, "The run goes from 0 to this time. Units: s.", Double(0, 1e9));
    prm.add_parameter("Integrator", integrator,
                      "Of the modes: Jean's theta method, or their exact solution over a step. Units: none.",
                      Selection("theta method|exact propagator"));
    prm.add_parameter(
        "Theta", theta,
        "Of the theta method: 1/2 has no numerical damping, more subtracts (theta - 1/2) omega^2 h from "
        "the growth rate of every mode. Units: none.",
        Double(0.5, 1));
    prm.add_parameter(
        "Residual theta", residual_theta,
        "Of the rate of what the modes leave out along the surface: 1, a backward difference, whose error is "
        "of first order; 0.6, a fifth of that error, while what rings falls to 2/3 in a step. Units: none.",
        Double(0.55, 1));
    prm.add_parameter(
        "Reaction", reaction,
        "The contact force within a step: weighted as other forces (linear for the exact propagator), or "
        "its value at the end of the step alone, as the paper has it. Units: none.",
        Selection("as other forces|end of step"));
    prm.add_parameter("Initial state", initial_state,
                      "The equilibrium of section Rolling, all bodies without stress and apart, or the end "
                      "of the history of "
                      "section Loading, whose loads stay. Units: none.",
                      Selection("quasi-static|undeformed|quasi-static loading"));
    prm.add_parameter(
        "Release", release,
        "The force that the loading ends with along x and y is taken off at the beginning; a hub "
        "with a mass of its own then springs back. Units: none.");
    prm.add_parameter("Initial gap", initial_gap, "Of undeformed bodies. Units: m.", Double(0, 1e6));
    prm.add_parameter("Initial velocity", initial_velocity,
                      "Of body 1 as a whole along z, negative towards body 2; undeformed only. Units: m/s.",
                      Double(-1e6, 1e6));
    prm.add_parameter(
        "Perturbed mode", perturbed_mode,
        "Mode that the initial state is perturbed by, as body:label, for instance wheel:axial(0,2); the "
        "second of a "
        "pair, axial(0,2)#2 in tables, is written axial(0,2)/2, for # begins a comment; empty: none. Units: "
        "none.",
        Anything());
    prm.add_parameter("Perturbation", perturbation,
                      "Largest displacement of this mode in the contact. Units: m.", Double(-1, 1));
    prm.add_parameter("Perturbation velocity", perturbation_velocity,
                      "Largest velocity of this mode in the contact. Units: m/s.", Double(-1e3, 1e3));
    const auto expression = [&](const std::string &name, std::string &value, const std::string &unit)
    {
      prm.add_parameter(name, value,
                        "Expression of the time t that replaces Rolling/" + name +
                            "; empty: constant. Units: " + unit + ".",
                        Anything());
    };
    expression("Longitudinal creepage", longitudinal_creepage, "none");
    expression("Lateral creepage", lateral_creepage, "none");
    expression("Spin", spin, "1/m");
    expression("Normal force", normal_force, "N");
    expression("Hub displacement", hub_displacement, "m");
    prm.add_parameter(
        "Exciting force", exciting_force,
        "Expression of the time t: force on body 1 at its only contact point along z (of several "
        "contacts that of the first), positive upwards, beside that of the contact; empty: "
        "none. Units: N.",
        Anything());
    prm.add_parameter("Drive table", drive_table,
                      "CSV file with the column time_s and any of longitudinal_creepage, lateral_creepage, "
                      "spin_1_m, normal_force_N, hub_displacement_m, exciting_force_N, which replace the "
                      "constants of section "
                      "Rolling; linear in between; it has to cover the run; empty: none. Units: none.",
                      FileName());
    prm.enter_subsection("Roughness");
    roughness.declare_parameters(prm);
    prm.leave_subsection();
    prm.add_parameter("History interval", history_interval,
                      "Distance of the lines of the histories; 0: every step. Units: s.", Double(0, 1e9));
    prm.add_parameter("Checkpoint interval", checkpoint_interval,
                      "Wall time between checkpoints, from which --resume continues; 0: only when the run is "
                      "stopped and at its end. Units: s.",
                      Double(0, 1e9));
  }

  void TransientParameters::check() const
  {
    if (!(end_time > 0) || time_step > end_time * (1 + 1e-9))
    {
      std::ostringstream text;
      text << "Transient/Time step is " << time_step << " s, but Transient/End time is " << end_time
           << " s, so that not one step would be made: give a later end or a shorter step.";
      throw InputError(text.str());
    }
    if (history_interval > end_time)
    {
      std::ostringstream text;
      text << "Transient/History interval is " << history_interval << " s, but Transient/End time is "
           << end_time << " s, so that the histories would hold the first instant alone: make it shorter.";
      throw InputError(text.str());
    }
    if (!starts_undeformed() && (initial_gap != 0 || initial_velocity != 0))
      throw InputError("Section Transient gives an initial gap or velocity, but its Initial state is " +
                       initial_state + ": set it to undeformed.");
    if (release && !starts_from_loading())
      throw InputError("Transient/Release takes off what section Loading ends with, but Initial state is " +
                       initial_state + ": set it to quasi-static loading, or leave Release out.");
    if (starts_from_loading() && roughness.any())
      throw InputError("Section Transient/Roughness moves the surfaces, but Initial state is quasi-static "
                       "loading, whose bodies rest on smooth ones: leave it out.");
    if (!normal_force.empty() && !hub_displacement.empty())
      throw InputError("Section Transient gives expressions of both Normal force and Hub displacement: empty "
                       "one of them.");
    if (adapts_steps() &&
        !(shortest_step > 0 && shortest_step <= time_step && shortest_step >= 1e-6 * time_step))
      throw InputError(
          "Section Transient gives an Error tolerance, for which the Shortest time step has to be "
          "between a millionth of the Time step and the Time step: give it.");
    roughness.check();
    if (perturbed_mode.empty() && (perturbation != 0 || perturbation_velocity != 0))
      throw InputError("Section Transient gives a perturbation, but no Perturbed mode: name one.");
    if (!perturbed_mode.empty() && perturbation == 0 && perturbation_velocity == 0)
      throw InputError("Transient/Perturbed mode is '" + perturbed_mode +
                       "', but nothing says by how much: give Perturbation or Perturbation velocity.");
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/modal_convolution/modal_convolution_parameters.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/propagators/propagator.h>

namespace vibrocontact
{
  void ModalConvolutionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    std::string names, help;
    for (const PropagatorType &known : *methods)
    {
      names += known.name + "|";
      help += known.name + " (" + known.help + "), ";
    }
    prm.add_parameter(
        "Method", method,
        help + "event located (few rigid contact points: exact motion between touches and releases, "
               "which are found inside the step). Units: none.",
        Selection(names + "event located"));
    prm.add_parameter("Time step", time_step,
                      "Of the stepping methods; of the histories of the event-located one. Units: s.",
                      Double(1e-9, 1e3));
    prm.add_parameter("End time", end_time, "Units: s.", Double(1e-9, 1e9));
    prm.add_parameter(
        "Force shape", force_shape,
        "Interpolation of a contact force in a step: impulse at its beginning (rigid contact), constant "
        "(zero-order hold), or linear from step to step (first-order hold: more accurate, but only below "
        "a critical time step; both for contact with tread or residual flexibility). Units: none.",
        Selection("impulse|constant|linear"));
    prm.add_parameter(
        "Theta", theta,
        "Of the theta method: 1/2 has no numerical damping, more subtracts (theta - 1/2) omega^2 h from "
        "growth rates. Units: none.",
        Double(0.5, 1));
    prm.add_parameter("Memory", memory,
                      "Of the convolutions: time after which a force is forgotten; 0: never. Units: s.",
                      Double(0, 1e9));
    prm.add_parameter("Initial state", initial_state,
                      "at rest (undeformed) or equilibrium (under the loads, without contact). Units: none.",
                      Selection("at rest|equilibrium"));
    prm.add_parameter(
        "Contact solver", contact_solver,
        "automatic (active set; projected Jacobi for hundreds of points evenly apart on a "
        "tread), active set, or common: the solver of section Contact/Solver, which all contact "
        "with friction or with a normal law that yields has anyway. Units: none.",
        Selection("automatic|active set|common"));
    prm.add_parameter("Friction", friction,
                      "Whether the contact points rub along the road, by Contact/Friction law, with "
                      "Road/Sliding speed. Units: none.",
                      Bool());
    prm.add_parameter("History interval", history_interval,
                      "Distance of the lines of the histories, in whole steps, 0: every step. Units: s.",
                      Double(0, 1e9));
    prm.add_parameter("Checkpoint interval", checkpoint_interval,
                      "Wall time between checkpoints, 0: only the one at the end. Units: s.", Double(0, 1e9));
    prm.add_parameter(
        "Error estimate", error_estimate,
        "Whether a second run in twice the steps (half of the cost of a modal recursion) goes on beside "
        "this one and tells its error; if not, results.json says nothing about it. Units: none.",
        Bool());
    prm.enter_subsection("Signals");
    signals.declare_parameters(prm, "the end");
    prm.leave_subsection();
  }

  bool ModalConvolutionParameters::takes_theta() const
  {
    return !is_event_located() && find_named(*methods, method, "propagator").takes_theta;
  }

  bool ModalConvolutionParameters::is_convolution() const
  {
    return !is_event_located() && find_named(*methods, method, "propagator").is_convolution;
  }

  void ModalConvolutionParameters::check() const
  {
    if (is_event_located() && (memory > 0 || force_shape != "impulse" || contact_solver != "automatic"))
      throw InputError(
          std::string("Modal convolution/") +
          (memory > 0                 ? "Memory"
           : force_shape != "impulse" ? "Force shape"
                                      : "Contact solver") +
          " is given, but Method is event located, which has no steps: leave it out or take modal "
          "recursion or a convolution.");
    if (end_time < time_step)
      throw InputError("Modal convolution/End time is before the first Time step: give a later one.");
    if (end_time / time_step > 1e12)
      throw InputError("Modal convolution/Time step asks for more than 1e12 steps: enlarge it.");
    if (history_interval > end_time)
      throw InputError("Modal convolution/History interval is " + number_text(history_interval) +
                       " s, but Modal convolution/End time is " + number_text(end_time) +
                       " s, so that the histories would hold the first instant alone: make it shorter.");
    signals.check("Modal convolution", std::max(time_step, history_interval), end_time);
    if (memory > 0 && memory < time_step)
      throw InputError(
          "Modal convolution/Memory is shorter than Modal convolution/Time step: give the time that "
          "forces are kept, or 0 for all of them.");
    if (memory > 0 && !is_convolution())
      throw InputError("Modal convolution/Memory is given, but the " + method +
                       " forgets nothing: leave it out or take a convolution.");
    if (friction && is_event_located())
      throw InputError(
          "Modal convolution/Friction is true, but Method is event located, which finds touches and "
          "releases only: take modal recursion or a convolution.");
  }

  std::vector<std::complex<double>> ModalConvolutionParameters::first_state(const BodyInContact &model) const
  {
    return initial_state == "at rest" ? state_at_rest(model) : state_in_equilibrium(model);
  }
} // namespace vibrocontact

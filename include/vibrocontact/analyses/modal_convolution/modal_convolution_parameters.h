#pragma once

#include <vibrocontact/marching/signal_windows.h>
#include <vibrocontact/propagators/propagator_types.h>

#include <deal.II/base/parameter_handler.h>

#include <complex>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct BodyInContact;

  /// `subsection Modal convolution`
  struct ModalConvolutionParameters
  {
    /// of `methods`, or event located
    std::string method = "modal recursion";
    /// [s]; the event-located method has no steps, this is then the distance of what it shows
    double time_step = 1e-5, end_time = 0.2;
    std::string force_shape = "impulse";
    /// of the theta method
    double theta = 0.5;
    /// of the convolutions: time after which a force is forgotten, 0: never [s]
    double memory = 0;
    /// at rest or equilibrium (under the loads)
    std::string initial_state = "at rest";
    /// automatic, active set, or common: the solver of section Contact/Solver, which friction and laws that yield have anyway
    std::string contact_solver = "automatic";
    /// along the road, by Contact/Friction law
    bool friction = false;
    /// [s], 0: every step
    double history_interval = 0;
    /// [s] of wall time, 0: none but the last
    double checkpoint_interval = 600;
    /// whether a second march tells the error of the steps
    bool error_estimate = true;
    /// of the forces of all points together
    SignalWindows signals;
    /// no entry: of the event-located method, shortened where poles ask for it [s]
    double longest_piece = 1e300;
    /// that `method` chooses from; never null
    std::shared_ptr<const PropagatorTypes> methods =
        std::make_shared<const PropagatorTypes>(propagator_types());

    void declare_parameters(dealii::ParameterHandler &prm);
    void check() const;
    bool is_event_located() const { return method == "event located"; }
    /// Whether `memory` matters.
    bool is_convolution() const;
    /// whether the Method is the theta method
    bool takes_theta() const;
    /// States of the poles that a motion begins with.
    std::vector<std::complex<double>> first_state(const BodyInContact &model) const;
  };
} // namespace vibrocontact

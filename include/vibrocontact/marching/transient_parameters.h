#pragma once

#include <vibrocontact/marching/roughness.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// `subsection Transient`
  struct TransientParameters
  {
    /// what moves: "reduced" (modes, and residual flexibility without inertia), "finite elements" (all their
    /// modes: contact points with mass, see with_all_modes())
    std::string model = "reduced";
    bool is_reduced() const { return model == "reduced"; }
    /// h, end of the run [s]
    double time_step = 1e-6, end_time = 1e-2;
    /// error per step over the size of the vibration, at which the step is halved, see StepLevels; 0: all
    /// steps are equal; otherwise between this and the time step [s]
    double error_tolerance = 0, shortest_step = 0;
    bool adapts_steps() const { return error_tolerance > 0; }
    double least_step() const { return adapts_steps() ? shortest_step : time_step; }
    /// march with twice the step beside the run, see Companion
    bool error_estimate = true;
    /// "theta method" or "exact propagator"; theta
    std::string integrator = "theta method";
    bool propagates_exactly() const { return integrator == "exact propagator"; }
    double theta = 0.5;
    /// What steps of h take from the growth of a mode, (theta - 1/2) w^2 h (theta_step()) [1/s].
    double growth_taken_by_theta(const double omega, const double h) const
    {
      return propagates_exactly() ? 0. : (theta - 0.5) * omega * omega * h;
    }
    /// of the rate of the residual displacements, see ContactStepper; 1: backward differences
    double residual_theta = 1;
    /// "as other forces" or "end of step", see ReactionWeighting
    std::string reaction = "as other forces";
    bool reacts_at_end_of_step() const { return reaction == "end of step"; }
    /// "quasi-static": the equilibrium of section Rolling, at rest in the moving frame; "undeformed": bodies
    /// without stress, apart by initial_gap, body 1 moving with initial_velocity; "quasi-static loading": the end of the history
    /// of section Loading
    std::string initial_state = "quasi-static";
    bool starts_undeformed() const { return initial_state == "undeformed"; }
    bool starts_from_loading() const { return initial_state == "quasi-static loading"; }
    /// the force that the loading ends with along x and y is taken off at the beginning
    bool release = false;
    /// [m]; along z, positive upwards [m/s]
    double initial_gap = 0, initial_velocity = 0;
    /// stated perturbation of the initial state: name of a mode (body:label), its largest displacement in the
    /// contact [m] and velocity [m/s]
    std::string perturbed_mode;
    double perturbation = 0, perturbation_velocity = 0;
    /// expressions of the time t that replace the constants of section Rolling; empty: constant
    std::string longitudinal_creepage, lateral_creepage, spin, normal_force, hub_displacement;
    /// force on body 1 at its only contact point along z, upwards [N], an expression of the time t; empty: none
    std::string exciting_force;
    /// CSV file that does the same, columns time_s and any of longitudinal_creepage, lateral_creepage,
    /// spin_1_m, normal_force_N, hub_displacement_m, exciting_force_N
    std::string drive_table;
    RoughnessParameters roughness;
    /// distance of the lines of the histories [s], 0: every step
    double history_interval = 0;
    /// wall time between checkpoints [s], 0: only when the run is stopped and at its end
    double checkpoint_interval = 300;

    /// the body that perturbed_mode names
    std::string perturbed_body() const { return perturbed_mode.substr(0, perturbed_mode.find(':')); }
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError for combinations that make no sense
    void check() const;
  };
} // namespace vibrocontact

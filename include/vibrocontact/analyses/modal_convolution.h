#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/response/event_located.h>
#include <vibrocontact/response/response.h>
#include <vibrocontact/scene/road.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Modal convolution`
  struct ModalConvolutionParameters
  {
    /// of response_methods(), or event located
    std::string method = "modal recursion";
    /// [s]; the event-located method has no steps, this is then the distance of what it shows
    double time_step = 1e-5, end_time = 0.2;
    std::string force_shape = "impulse";
    /// of the convolutions: time after which a force is forgotten, 0: never [s]
    double memory = 0;
    /// at rest or equilibrium (under the loads)
    std::string initial_state = "at rest";
    /// active set, or common: the solver of section Contact/Solver, which contact with friction has anyway
    std::string contact_solver = "active set";
    /// Coulomb's along the road, with Contact/Friction coefficient
    bool friction = false;
    /// [s], 0: every step
    double history_interval = 0;
    /// [s] of wall time, 0: none but the last
    double checkpoint_interval = 600;

    void declare_parameters(dealii::ParameterHandler &prm);
    void check() const;
    bool is_event_located() const { return method == "event located"; }
  };

  /// What a run has been through.
  struct ModalConvolutionResult
  {
    unsigned long steps = 0;
    double time = 0;
    /// of stepping with contact and storing histories; of evaluating the road before it; processor
    /// time [s]
    double seconds = 0, road_seconds = 0;
    std::vector<ContactEvent> impacts, releases;
    /// per point [N s]
    std::vector<double> impulse;
    double largest_force = 0;
    /// with friction: the same along the road, forward on body 1; -T slip summed over steps and points [J]; sum over
    /// the steps of closed points that stick
    std::vector<double> tangential_impulse;
    double dissipation = 0;
    unsigned long sticking_points = 0;
    /// sums over the steps: closed points, corrections of the closed set; largest residual of the contact
    unsigned long closed_points = 0, corrections = 0;
    double residual = 0;
  };

  /// Some steps of a run, for whoever writes them. Lines belong to times t_k = k h, k = first_line, ...: the
  /// displacements there and the forces there (of an impulse, which stands at the beginning of its step, that of the step
  /// which begins there). Arrays: n_points per line.
  struct ModalConvolutionLines
  {
    unsigned long first_line;
    unsigned int n_lines, n_points;
    double time_step;
    const double *displacement, *force;
    /// with friction, else null: forward
    const double *tangential_displacement = nullptr, *tangential_force = nullptr;
  };

  /// A body known by its poles on a road, in steps of h: u = u_free + (B + S) q with 0 <= q perp u - u_r >= 0 at the end
  /// of every step (response/response.h, contact/unilateral_contact.h), or from event to event
  /// (response/event_located.h). With friction (two rows of the model per point of the road) by the common solvers
  /// (analyses/road_friction.h).
  class ModalConvolution
  {
  public:
    using Observer = std::function<void(const ModalConvolutionLines &)>;

    /// @param mu friction coefficient, of a model with tangential rows
    /// @throws InputError if the body cannot be in contact in this way. They are referred to.
    ModalConvolution(const ModalConvolutionParameters &parameters, const ContactSolverParameters &solver,
                     const PoleModel &model, const Road &road, double mu = 0);
    ~ModalConvolution();

    /// The next steps, at most n_steps; false: the end is reached. Blocks count from the beginning, so that a resumed
    /// run has the same.
    /// @throws ConvergenceError
    bool advance(unsigned int n_steps, const Observer &observe);

    const ModalConvolutionResult &result() const { return results; }
    unsigned long n_steps() const { return last_step; }
    void exchange(CheckpointFile &file);

  private:
    class Stepper;
    void advance_steps(unsigned int n_steps, const Observer &observe);
    void advance_events(unsigned int n_steps, const Observer &observe);
    void find_events(unsigned int n_steps, const double *force);
    void add_up(unsigned int n_steps);

    const ModalConvolutionParameters &parameters;
    const Road &road;
    const unsigned int n_points;
    const double time_step;
    unsigned long last_step;
    ModalConvolutionResult results;
    std::unique_ptr<Stepper> stepper;
    std::unique_ptr<EventLocated> events;
    /// of the last line so far; whether points were closed
    std::vector<double> last_displacement, last_force;
    std::vector<char> was_closed;
    std::vector<double> heights, displacements, forces;
    /// along the road, with friction: the last line so far, then lines like those above
    const bool has_friction;
    std::vector<double> last_tangential_displacement, last_tangential_force, tangential_displacements,
        tangential_forces;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/analyses/modal_convolution/modal_convolution_parameters.h>
#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/marching/march_checkpoint.h>
#include <vibrocontact/propagators/event_located.h>
#include <vibrocontact/propagators/propagator.h>
#include <vibrocontact/propagators/work_account.h>
#include <vibrocontact/scene/road.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Of all points together, with friction the larger of both components of the impulse, relative to both together.
  struct RoadMarchErrors : MarchErrors
  {
    /// the largest error of one point's impulse over the largest of them [-]
    double worst_point = 0;
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
    /// sums over the steps: closed points, iterations of the contact solver; largest residual of the contact
    unsigned long closed_points = 0, corrections = 0;
    double residual = 0;
    /// whether that can be other than zero: one point by a closed form has none
    bool has_residual = false;
    /// of the normal force of all points together, squared, over time [N^2 s]; of rigid points without impacts and kinks, as
    /// the rms of impulses has no limit
    double square_integral = 0;
    /// the same of what the road between the steps would add to the force
    double unseen_square_integral = 0;
    /// sums over the steps in which points at open sides are closed: of their forces and of all points' [N]
    double forces_at_sides = 0, forces_meanwhile = 0;
    WorkAccount work;
    RoadMarchErrors errors;

    double rms_force() const { return time > 0 ? std::sqrt(square_integral / time) : 0.; }
    /// share of the rms force that lies in waves of the road which the steps do not see [-]
    double unseen_share() const;
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
    /// u_r there
    const double *road;
    /// with friction, else null: forward
    const double *tangential_displacement = nullptr, *tangential_force = nullptr;
  };

  class RoadStepper;

  /// A body known by its poles on a road, in steps of h: u = u_free + (B + S) q with 0 <= q perp u - u_r >= 0 at the end
  /// of every step (propagators/propagator.h, contact/contact_solver.h), or from event to event
  /// (propagators/event_located.h). With friction (two rows of the model per point of the road) by the common solvers
  /// (analyses/modal_convolution/road_contact.h).
  class ModalConvolution : public March
  {
  public:
    using Observer = std::function<void(const ModalConvolutionLines &)>;

    /// @param laws of the contact; friction only of a model with tangential rows
    /// @throws InputError if the body cannot be in contact in this way. Parameters, model and road are referred to.
    ModalConvolution(const ModalConvolutionParameters &parameters, const ContactSolverParameters &solver,
                     const BodyInContact &model, const Road &road, const RoadLaws &laws = {});
    ~ModalConvolution() override;

    /// The next steps, at most n_steps; false: the end is reached. Blocks count from the beginning, so that a resumed
    /// run has the same.
    /// @throws ConvergenceError
    bool advance(unsigned int n_steps, const Observer &observe = {});

    double time() const override { return results.time; }
    double end_time() const override { return last_step * time_step; }
    bool is_over() override { return results.steps >= last_step; }
    /// What takes a tenth of a second, or one step, shown to `recorder`.
    void advance_block() override;
    void exchange(CheckpointFile &file) override;
    Marks marks() const override;

    const ModalConvolutionResult &result() const { return results; }
    unsigned long n_steps() const { return last_step; }
    /// What the second march is; empty without one.
    std::string second_march() const;
    /// follows the blocks; none: nobody does
    Observer recorder;
    /// that are watched (RoadBody::at_open_sides)
    std::vector<unsigned int> at_open_sides;

  private:
    /// Sums that are compared with those of the second march.
    struct Sums
    {
      unsigned long steps = 0;
      std::vector<double> impulse, tangential_impulse;
      double square_integral = 0;
    };

    /// every so many steps the road is looked at between two
    static constexpr unsigned int road_look_interval = 16;

    void check_number_of_pieces() const;
    void begin_second_march(const ContactSolverParameters &solver, const BodyInContact &model,
                            const RoadLaws &laws);
    void advance_second_march();
    void compare_second_march();
    void exchange_second_march(CheckpointFile &file);
    Sums sums() const;
    /// whether some point has no compliance but that of the body's poles
    bool has_rigid_points() const;
    void watch_open_sides(unsigned int n_steps);
    void check_steps_of_the_road(unsigned int n_steps) const;
    void look_between_steps(unsigned int n_steps);
    void account(unsigned int n_steps);
    void show_modal_work(const double *displacement, const double *height);
    void watch_impulses(unsigned int k, double &jump);
    void advance_block_of_steps(unsigned int n_steps, const Observer &observe);
    void advance_steps(unsigned int n_steps, const Observer &observe);
    void advance_events(unsigned int n_steps, const Observer &observe);
    void find_events(unsigned int n_steps, const double *force);
    void add_up(unsigned int n_steps);

    const ModalConvolutionParameters &parameters;
    const BodyInContact &model;
    const Road &road;
    const unsigned int n_points;
    const double time_step;
    unsigned long last_step;
    ModalConvolutionResult results;
    PointLaws<NormalLaw> law;
    std::unique_ptr<RoadStepper> stepper;
    std::unique_ptr<EventLocated> events;
    /// the second march and its parameters, in twice the steps, in half of them where forces would ring in twice, or
    /// (event located) in other pieces; steps of this one per step of that; the sums at its newest step
    std::unique_ptr<ModalConvolutionParameters> second_parameters;
    std::unique_ptr<ModalConvolution> second;
    double steps_ratio = 2;
    Sums compared;
    /// S_ii and what the normal law yields at touch; 1 / (B_ii + that) [m/N, N/m]
    std::vector<double> residual, stiffness;
    /// whether some S_ii is zero; then steps that an impact or a kink still fills with its impulse
    bool is_rigid = false;
    unsigned int impulse_steps = 0;
    std::unique_ptr<SteppedModalWork> modal_work;
    /// of the last line so far; whether points were closed; the road's height there, and the displacement and gap of the
    /// line before it
    std::vector<double> last_displacement, last_force, last_height, older_displacement, older_gap;
    std::vector<char> was_closed;
    std::vector<double> heights, displacements, forces;
    /// along the road, with friction: the last line so far, then lines like those above
    const bool has_friction;
    std::vector<double> last_tangential_displacement, last_tangential_force, tangential_displacements,
        tangential_forces;
  };

  /// In the output folder, modal_convolution.h5.
  MarchCheckpoint road_checkpoint(const std::string &folder);
} // namespace vibrocontact

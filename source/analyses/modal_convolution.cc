#include <vibrocontact/analyses/modal_convolution.h>
#include <vibrocontact/analyses/road_friction.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/processor_clock.h>
#include <vibrocontact/contact/unilateral_contact.h>
#include <vibrocontact/response/step_weights.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    double seconds_of(const std::function<void()> &work)
    {
      const double begin = processor_seconds();
      work();
      return processor_seconds() - begin;
    }
  } // namespace

  void ModalConvolutionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    std::string names, help;
    for (const ResponseMethod &known : response_methods())
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
        "A contact force within a step: impulse at its beginning (rigid contact), constant, or linear "
        "from step to step (contact with tread or residual flexibility: more accurate, but only below "
        "a longest step). Units: none.",
        Selection("impulse|constant|linear"));
    prm.add_parameter("Memory", memory,
                      "Of the convolutions: time after which a force is forgotten; 0: never. Units: s.",
                      Double(0, 1e9));
    prm.add_parameter("Initial state", initial_state,
                      "at rest (undeformed) or equilibrium (under the loads, without contact). Units: none.",
                      Selection("at rest|equilibrium"));
    prm.add_parameter(
        "Contact solver", contact_solver,
        "active set, or common: the solver of section Contact/Solver, which also solves all contact "
        "with friction. Units: none.",
        Selection("active set|common"));
    prm.add_parameter(
        "Friction", friction,
        "Whether the contact points have Coulomb's friction along the road, with Contact/Friction "
        "coefficient and Road/Sliding speed; for bodies that do not roll. Units: none.",
        Bool());
    prm.add_parameter("History interval", history_interval,
                      "Distance of the lines of the histories, 0: every step. Units: s.", Double(0, 1e9));
    prm.add_parameter("Checkpoint interval", checkpoint_interval,
                      "Wall time between checkpoints, 0: only the one at the end. Units: s.", Double(0, 1e9));
  }

  void ModalConvolutionParameters::check() const
  {
    if (is_event_located() && (memory > 0 || force_shape != "impulse" || contact_solver != "active set"))
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
    if (memory > 0 && memory < time_step)
      throw InputError(
          "Modal convolution/Memory is shorter than Modal convolution/Time step: give the time that "
          "forces are kept, or 0 for all of them.");
    if (memory > 0 && method == "modal recursion")
      throw InputError(
          "Modal convolution/Memory is given, but the modal recursion forgets nothing: leave it out or "
          "take a convolution.");
    if (friction && is_event_located())
      throw InputError(
          "Modal convolution/Friction is true, but Method is event located, which finds touches and "
          "releases only: take modal recursion or a convolution.");
  }

  /// The steps of any number of points: response and contact.
  class ModalConvolution::Stepper
  {
  public:
    Stepper(const ModalConvolutionParameters &parameters, const ContactSolverParameters &solver_parameters,
            const PoleModel &model, const unsigned int n_points, const unsigned long n_steps, const double mu,
            const double sliding_speed)
        : response(make_response(parameters, model, n_steps)),
          contact(normal_block(response->compliance(), n_points), at_step(parameters.time_step)), n(n_points),
          step(parameters.time_step), sliding_speed(sliding_speed), solver_parameters(solver_parameters),
          problem(road_contact_problem(response->compliance(), n_points, mu, parameters.time_step)),
          is_linear(force_shape(parameters.force_shape) == ForceShape::linear),
          is_common(parameters.contact_solver == "common" || model.n_rows() > n_points)
    {
      check_force_shape(parameters, model, n_points);
    }

    /// Without friction. @param heights, displacements, forces n_points per step
    void run(const unsigned int n_steps, const double *heights, double *displacements, double *forces)
    {
      if (is_common)
        run_common(n_steps, heights, displacements, forces, nullptr, nullptr);
      else if (n == 1)
        run_one(n_steps, heights, displacements, forces);
      else
        run_many(n_steps, heights, displacements, forces);
    }

    /// By the common solvers. @param tangential_displacements, tangential_forces as the others, the line that the first
    /// step begins with in front of them; null without friction
    void run_common(const unsigned int n_steps, const double *heights, double *displacements, double *forces,
                    double *tangential_displacements, double *tangential_forces)
    {
      // nothing is left of the steps before: a resumed run, which begins with a block, has the same solver
      const std::unique_ptr<ContactSolver> solver = create_contact_solver(solver_parameters);
      ContactSolution solution;
      std::vector<double> q(response->n_rows());
      const double *const free = response->free_displacement();
      const bool has_friction = tangential_forces != nullptr;
      for (unsigned int k = 0; k < n_steps; ++k, heights += n, displacements += n, forces += n)
      {
        const double *const before = tangential_displacements - (has_friction ? n : 0);
        for (unsigned int i = 0; i < n; ++i)
          problem.b[i] = free[i] - heights[i];
        for (unsigned int i = 0; has_friction && i < n; ++i)
          problem.b[n + i] = (free[n + i] - before[i]) / step + sliding_speed;
        solution = solver->solve(problem, solution);
        if (!solution.converged)
          throw ConvergenceError("The contact of a step did not converge, relative residual " +
                                 std::to_string(solution.residual) + ".");
        for (unsigned int i = 0; i < n; ++i)
        {
          forces[i] = q[i] = solution.R[i];
          displacements[i] = solution.y[i] + heights[i];
          closed_points += forces[i] > 0;
        }
        for (unsigned int i = 0; has_friction && i < n; ++i)
        {
          const double slip = solution.y[n + i];
          tangential_forces[i] = q[n + i] = solution.R[n + i];
          tangential_displacements[i] = before[i] + step * (slip - sliding_speed);
          // of linear forces the mean
          const double force = is_linear ? 0.5 * (q[n + i] + (tangential_forces - n)[i]) : q[n + i];
          dissipation -= step * force * slip;
          sticking_points += solution.status[i] == ContactStatus::stick;
        }
        if (has_friction)
        {
          tangential_displacements += n;
          tangential_forces += n;
        }
        response->advance(q.data());
        iterations += solution.iterations;
        residual = std::max(residual, solution.residual);
      }
    }

    std::unique_ptr<Response> response;
    UnilateralContact contact;
    unsigned long closed_points = 0, sticking_points = 0, iterations = 0;
    double residual = 0, dissipation = 0;

  private:
    static DenseMatrix normal_block(const DenseMatrix &matrix, const unsigned int n_points)
    {
      DenseMatrix block(n_points, n_points);
      for (unsigned int i = 0; i < n_points; ++i)
        for (unsigned int j = 0; j < n_points; ++j)
          block(i, j) = matrix(i, j);
      return block;
    }

    static void check_force_shape(const ModalConvolutionParameters &parameters, const PoleModel &model,
                                  const unsigned int n_points)
    {
      const double longest =
          longest_step(model.residual, initial_derivative(model, 1), force_shape(parameters.force_shape));
      if (parameters.time_step <= longest)
        return;
      std::ostringstream text;
      text << "Modal convolution/Force shape is " << parameters.force_shape
           << ", with which the contact forces ring ";
      if (longest > 0)
        text << "at steps above " << longest << " s: take a shorter Time step or Force shape = impulse.";
      else
      {
        unsigned int rigid = 0;
        while (rigid + 1 < model.residual.m() && model.residual(rigid, rigid) > 0)
          ++rigid;
        text << "as contact point " << rigid % n_points << " is rigid"
             << (rigid < n_points ? "" : " along the road") << ": take Force shape = impulse, or give a "
             << (rigid < n_points ? "" : "tangential ") << "tread stiffness.";
      }
      throw InputError(text.str());
    }

    static std::string at_step(const double time_step)
    {
      std::ostringstream text;
      text << "at Modal convolution/Time step " << time_step << " s";
      return text.str();
    }

    static std::unique_ptr<Response> make_response(const ModalConvolutionParameters &parameters,
                                                   const PoleModel &model, const unsigned long n_steps)
    {
      ResponseSettings settings;
      settings.time_step = parameters.time_step;
      settings.shape = force_shape(parameters.force_shape);
      settings.n_steps = n_steps;
      settings.memory = std::lround(parameters.memory / parameters.time_step);
      const double kept =
          double(settings.memory > 0 ? settings.memory : n_steps) * model.n_rows() * model.n_rows();
      if (parameters.method != "modal recursion" && kept > 2e8)
        throw InputError(
            "Modal convolution/Memory asks for more than 200 million samples of the Green's functions: "
            "give a shorter one or take the modal recursion.");
      return create_response(parameters.method, model,
                             parameters.initial_state == "at rest" ? state_at_rest(model)
                                                                   : state_in_equilibrium(model),
                             settings);
    }

    void run_one(const unsigned int n_steps, const double *heights, double *displacements, double *forces)
    {
      closed_points += response->advance_in_contact(n_steps, heights, displacements, forces);
      if (!std::isfinite(response->free_displacement()[0]))
        throw ConvergenceError(
            "The motion is no longer finite: take a shorter Time step or another Force shape.");
    }

    void run_many(const unsigned int n_steps, const double *heights, double *displacements, double *forces)
    {
      const double *const free = response->free_displacement();
      for (unsigned int k = 0; k < n_steps; ++k, heights += n, displacements += n, forces += n)
      {
        for (unsigned int i = 0; i < n; ++i)
          displacements[i] = free[i] - heights[i];
        contact.solve(displacements, forces);
        for (unsigned int i = 0; i < n; ++i)
          displacements[i] += heights[i];
        response->advance(forces);
        closed_points += contact.n_closed();
        residual = std::max(residual, contact.residual());
      }
      iterations = contact.corrections();
    }

    const unsigned int n;
    const double step, sliding_speed;
    const ContactSolverParameters &solver_parameters;
    ContactProblem problem;
    const bool is_linear, is_common;
  };

  ModalConvolution::ModalConvolution(const ModalConvolutionParameters &parameters,
                                     const ContactSolverParameters &solver, const PoleModel &model,
                                     const Road &road, const double mu)
      : parameters(parameters), road(road), n_points(road.n_points()), time_step(parameters.time_step),
        last_step(std::lround(parameters.end_time / parameters.time_step)), was_closed(n_points, 0),
        has_friction(model.n_rows() > n_points)
  {
    results.impulse.assign(n_points, 0.);
    last_force.assign(n_points, 0.);
    const auto state =
        parameters.initial_state == "at rest" ? state_at_rest(model) : state_in_equilibrium(model);
    std::vector<double> displacement(model.n_rows(), 0.);
    for (unsigned int i = 0; i < model.n_rows(); ++i)
      for (unsigned int k = 0; k < model.n_poles(); ++k)
        displacement[i] += 2 * (model.right(i, k) * state[k]).real();
    last_displacement.assign(displacement.begin(), displacement.begin() + n_points);
    if (has_friction)
    {
      check_road_friction(model, time_step, force_shape(parameters.force_shape));
      results.tangential_impulse.assign(n_points, 0.);
      last_tangential_displacement.assign(displacement.begin() + n_points, displacement.end());
      last_tangential_force.assign(n_points, 0.);
    }
    if (parameters.is_event_located())
      events = std::make_unique<EventLocated>(model, state, road, 1e300);
    else
      stepper =
          std::make_unique<Stepper>(parameters, solver, model, n_points, last_step, mu, road.sliding_speed());
  }

  ModalConvolution::~ModalConvolution() = default;

  bool ModalConvolution::advance(const unsigned int n_steps, const Observer &observe)
  {
    const unsigned int n = std::min<unsigned long>(n_steps, last_step - results.steps);
    if (n > 0)
      events ? advance_events(n, observe) : advance_steps(n, observe);
    return results.steps < last_step;
  }

  void ModalConvolution::advance_steps(const unsigned int n_steps, const Observer &observe)
  {
    stepper->contact.renew();
    // one line more than steps: lines join displacements and forces of different steps
    for (auto *array : {&heights, &displacements, &forces})
      array->resize((n_steps + 1) * n_points);
    results.road_seconds += seconds_of(
        [&]
        {
          for (unsigned int k = 0; k < n_steps; ++k)
            road.heights((results.steps + k + 1) * time_step, heights.data() + (k + 1) * n_points);
        });
    std::copy(last_displacement.begin(), last_displacement.end(), displacements.begin());
    std::copy(last_force.begin(), last_force.end(), forces.begin());
    if (has_friction)
    {
      tangential_displacements.resize((n_steps + 1) * n_points);
      tangential_forces.resize((n_steps + 1) * n_points);
      std::copy(last_tangential_displacement.begin(), last_tangential_displacement.end(),
                tangential_displacements.begin());
      std::copy(last_tangential_force.begin(), last_tangential_force.end(), tangential_forces.begin());
    }
    results.seconds += seconds_of(
        [&]
        {
          if (has_friction)
            stepper->run_common(n_steps, heights.data() + n_points, displacements.data() + n_points,
                                forces.data() + n_points, tangential_displacements.data() + n_points,
                                tangential_forces.data() + n_points);
          else
            stepper->run(n_steps, heights.data() + n_points, displacements.data() + n_points,
                         forces.data() + n_points);
        });
    add_up(n_steps);
    find_events(n_steps, forces.data() + n_points);

    const auto show = [&](const unsigned long line, const unsigned int n_lines, const unsigned int first,
                          const unsigned int first_force)
    {
      ModalConvolutionLines lines = {line,
                                     n_lines,
                                     n_points,
                                     time_step,
                                     displacements.data() + first * n_points,
                                     forces.data() + first_force * n_points};
      if (has_friction)
      {
        lines.tangential_displacement = tangential_displacements.data() + first * n_points;
        lines.tangential_force = tangential_forces.data() + first_force * n_points;
      }
      observe(lines);
    };
    if (force_shape(parameters.force_shape) == ForceShape::impulse)
      // lines 0 ... of this block, the last displacement waits for its force
      show(results.steps, n_steps, 0, 1);
    else
    {
      if (results.steps == 0)
        show(0, 1, 0, 0);
      show(results.steps + 1, n_steps, 1, 1);
    }
    std::copy_n(displacements.begin() + n_steps * n_points, n_points, last_displacement.begin());
    std::copy_n(forces.begin() + n_steps * n_points, n_points, last_force.begin());
    if (has_friction)
    {
      std::copy_n(tangential_displacements.begin() + n_steps * n_points, n_points,
                  last_tangential_displacement.begin());
      std::copy_n(tangential_forces.begin() + n_steps * n_points, n_points, last_tangential_force.begin());
    }
    results.steps += n_steps;
    results.time = results.steps * time_step;
  }

  void ModalConvolution::add_up(const unsigned int n_steps)
  {
    const bool linear = force_shape(parameters.force_shape) == ForceShape::linear;
    for (unsigned int k = 0; k < n_steps; ++k)
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const unsigned int before = k * n_points + i, now = before + n_points;
        const auto impulse = [&](const std::vector<double> &force)
        { return time_step * (linear ? 0.5 * (force[now] + force[before]) : force[now]); };
        results.impulse[i] += impulse(forces);
        results.largest_force = std::max(results.largest_force, forces[now]);
        if (has_friction)
          results.tangential_impulse[i] += impulse(tangential_forces);
      }
    results.closed_points = stepper->closed_points;
    results.corrections = stepper->iterations;
    results.residual = stepper->residual;
    results.dissipation = stepper->dissipation;
    results.sticking_points = stepper->sticking_points;
  }

  void ModalConvolution::find_events(const unsigned int n_steps, const double *force)
  {
    // an impulse stands at the beginning of its step
    const double shift = force_shape(parameters.force_shape) == ForceShape::impulse ? 0 : 1;
    for (unsigned int k = 0; k < n_steps; ++k)
      for (unsigned int i = 0; i < n_points; ++i, ++force)
        if ((*force > 0) != bool(was_closed[i]))
        {
          was_closed[i] = *force > 0;
          const double time = (results.steps + k + shift) * time_step;
          if (was_closed[i])
            results.impacts.push_back({time, i, *force * time_step});
          else
            results.releases.push_back({time, i});
        }
  }

  void ModalConvolution::advance_events(const unsigned int n_steps, const Observer &observe)
  {
    displacements.assign((n_steps + 1) * n_points, 0.);
    forces.assign((n_steps + 1) * n_points, 0.);
    unsigned long line = results.steps == 0 ? 0 : results.steps + 1;
    const unsigned long first = line, last = results.steps + n_steps;
    std::vector<double> times, places, u, q;
    results.seconds += seconds_of(
        [&]
        {
          events->advance(last * time_step,
                          [&](const EventLocated::Piece &piece)
                          {
                            const unsigned long begin = line - first;
                            times.clear();
                            // a line at an event shows what follows it
                            for (; line <= last && (line * time_step < piece.end ||
                                                    (line == last && piece.end >= last * time_step));
                                 ++line)
                              times.push_back(std::clamp(line * time_step, piece.begin, piece.end));
                            for (unsigned int i = 0; i < n_points; ++i)
                            {
                              places = times;
                              piece.values(i, places, u, q);
                              for (std::size_t k = 0; k < u.size(); ++k)
                              {
                                double *const force = &forces[(begin + k) * n_points + i];
                                displacements[(begin + k) * n_points + i] = u[k];
                                *force = std::max(0., q[k]);
                                results.largest_force = std::max(results.largest_force, *force);
                                results.closed_points += *force > 0;
                              }
                            }
                          });
        });
    observe({first, static_cast<unsigned int>(line - first), n_points, time_step, displacements.data(),
             forces.data()});
    const auto append = [](std::vector<ContactEvent> &to, const std::vector<ContactEvent> &from)
    { to.insert(to.end(), from.begin() + to.size(), from.end()); };
    append(results.impacts, events->impacts);
    append(results.releases, events->releases);
    results.impulse = events->impulse;
    results.steps += n_steps;
    results.time = results.steps * time_step;
  }

  void ModalConvolution::exchange(CheckpointFile &file)
  {
    ModalConvolutionResult &r = results;
    file("result/steps", r.steps);
    file("result/time", r.time);
    file("result/seconds", r.seconds);
    file("result/road_seconds", r.road_seconds);
    file("result/impulse", r.impulse);
    file("result/largest_force", r.largest_force);
    file("result/closed_points", r.closed_points);
    file("result/corrections", r.corrections);
    file("result/residual", r.residual);
    vibrocontact::exchange(file, "result/impacts", r.impacts);
    vibrocontact::exchange(file, "result/releases", r.releases);
    file("last/displacement", last_displacement);
    file("last/force", last_force);
    file("last/closed", was_closed);
    if (stepper)
    {
      stepper->response->exchange(file);
      stepper->contact.exchange(file);
      file("stepper/closed_points", stepper->closed_points);
      file("stepper/iterations", stepper->iterations);
      file("stepper/residual", stepper->residual);
    }
    if (has_friction)
    {
      file("result/tangential_impulse", r.tangential_impulse);
      file("last/tangential_displacement", last_tangential_displacement);
      file("last/tangential_force", last_tangential_force);
      file("stepper/dissipation", stepper->dissipation);
      file("stepper/sticking_points", stepper->sticking_points);
      r.dissipation = stepper->dissipation;
      r.sticking_points = stepper->sticking_points;
    }
    if (events)
      events->exchange(file);
  }
} // namespace vibrocontact

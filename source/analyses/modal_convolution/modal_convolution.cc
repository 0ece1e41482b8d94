#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/analyses/modal_convolution/road_stepper.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/processor_clock.h>
#include <vibrocontact/propagators/step_weights.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// of the event-located motion, some 3 us each: a day
    constexpr double most_pieces_of_a_run = 3e10;

    double seconds_of(const std::function<void()> &work)
    {
      const double begin = processor_seconds();
      work();
      return processor_seconds() - begin;
    }
  } // namespace

  ModalConvolution::ModalConvolution(const ModalConvolutionParameters &parameters,
                                     const ContactSolverParameters &solver, const BodyInContact &model,
                                     const Road &road, const RoadLaws &laws)
      : parameters(parameters), model(model), road(road), n_points(road.n_points()),
        time_step(parameters.time_step), last_step(steps_until(parameters.end_time, parameters.time_step)),
        law(laws.normal), was_closed(n_points, 0), has_friction(model.n_rows() > n_points)
  {
    results.impulse.assign(n_points, 0.);
    last_force.assign(n_points, 0.);
    const auto state = parameters.first_state(model);
    std::vector<double> displacement(model.n_rows(), 0.);
    for (unsigned int i = 0; i < model.n_rows(); ++i)
      for (unsigned int k = 0; k < model.n_poles(); ++k)
        displacement[i] += 2 * (model.right(i, k) * state[k]).real();
    last_displacement.assign(displacement.begin(), displacement.begin() + n_points);
    if (has_friction)
    {
      results.tangential_impulse.assign(n_points, 0.);
      last_tangential_displacement.assign(displacement.begin() + n_points, displacement.end());
      last_tangential_force.assign(n_points, 0.);
    }
    for (unsigned int i = 0; i < n_points; ++i)
      residual.push_back(law[i].compression(0).compliance +
                         (model.residual.m() > 0 ? model.residual(i, i) : 0.));
    is_rigid = has_rigid_points();
    if (parameters.is_event_located())
    {
      for (unsigned int i = 0; i < n_points; ++i)
        if (!law[i].is_rigid())
          throw InputError(
              "Contact/Normal law is " + law[i].description().name +
              ", but Modal convolution/Method is event located, which knows rigid points only: take modal "
              "recursion or signorini.");
      events = std::make_unique<EventLocated>(model, state, road, parameters.longest_piece);
      check_number_of_pieces();
    }
    else
    {
      stepper = std::make_unique<RoadStepper>(parameters, solver, model, n_points, last_step, laws,
                                              road.sliding_speed(), road.rolling_speed());
      if (has_friction)
        check_road_friction(stepper->compliance);
      for (unsigned int i = 0; i < n_points; ++i)
        stiffness.push_back(1 / (stepper->compliance(i, i) + law[i].compression(0).compliance));
      results.has_residual = n_points > 1 || stepper->is_common;
      last_height.resize(n_points);
      road.heights(0, last_height.data());
      older_displacement = last_displacement;
      older_gap.assign(n_points, 0.);
      if (ModalEnergy::applies(model))
      {
        const ModalEnergy modes(model);
        results.work.initial = modes.energy(modes.from_equilibrium(state));
        results.work.has_modes = parameters.error_estimate && !parameters.takes_theta();
      }
      if (results.work.has_modes)
        modal_work = std::make_unique<SteppedModalWork>(model, state, time_step,
                                                        force_interpolation(parameters.force_shape));
    }
    if (parameters.error_estimate)
      begin_second_march(solver, model, laws);
  }

  ModalConvolution::~ModalConvolution() = default;

  void ModalConvolution::check_number_of_pieces() const
  {
    const double n_pieces = parameters.end_time / events->longest_piece();
    if (n_pieces <= most_pieces_of_a_run)
      return;
    std::ostringstream text;
    text << "The event-located motion over Modal convolution/End time = " << parameters.end_time
         << " s would take " << n_pieces << " pieces of at most " << events->longest_piece()
         << " s (2 over the body's fastest pole), more than a day: take a shorter End time, a heavier or "
            "softer "
            "body, or the modal recursion.";
    throw InputError(text.str());
  }

  void ModalConvolution::advance_block()
  {
    constexpr double most_steps = 4096, most_pieces = 3e4;
    advance(events ? std::clamp(most_pieces * events->longest_piece() / time_step, 1., most_steps)
                   : most_steps,
            recorder);
  }

  bool ModalConvolution::advance(const unsigned int n_steps, const Observer &observe)
  {
    const unsigned int n = std::min<unsigned long>(n_steps, last_step - results.steps);
    if (n > 0)
      events ? advance_events(n, observe) : advance_block_of_steps(n, observe);
    if (n > 0 && second)
      advance_second_march();
    return results.steps < last_step;
  }

  void ModalConvolution::advance_block_of_steps(const unsigned int n_steps, const Observer &observe)
  {
    // heights, displacements and forces of so many steps, a quarter of a megabyte each, stay in the cache
    const unsigned long at_once =
        std::clamp(32768 / n_points / road_look_interval, 1u, 256u) * road_look_interval;
    stepper->begin_block();
    for (const unsigned long end = results.steps + n_steps; results.steps < end;)
      advance_steps(std::min(end - results.steps, at_once - results.steps % at_once), observe);
  }

  void ModalConvolution::advance_steps(const unsigned int n_steps, const Observer &observe)
  {
    // one line more than steps: lines join displacements and forces of different steps
    for (auto *array : {&heights, &displacements, &forces})
      array->resize((n_steps + 1) * n_points);
    results.road_seconds += seconds_of(
        [&]
        {
          for (unsigned int k = 0; k < n_steps; ++k)
            road.heights((results.steps + k + 1) * time_step, heights.data() + (k + 1) * n_points);
        });
    std::copy(last_height.begin(), last_height.end(), heights.begin());
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
            stepper->run_steps(n_steps, heights.data() + n_points, displacements.data() + n_points,
                               forces.data() + n_points, tangential_displacements.data() + n_points,
                               tangential_forces.data() + n_points);
          else
            stepper->run(n_steps, heights.data() + n_points, displacements.data() + n_points,
                         forces.data() + n_points);
        });
    check_steps_of_the_road(n_steps);
    account(n_steps);
    look_between_steps(n_steps);
    add_up(n_steps);
    watch_open_sides(n_steps);
    find_events(n_steps, forces.data() + n_points);

    const auto show = [&](const unsigned long line, const unsigned int n_lines, const unsigned int first,
                          const unsigned int first_force)
    {
      ModalConvolutionLines lines = {line,
                                     n_lines,
                                     n_points,
                                     time_step,
                                     displacements.data() + first * n_points,
                                     forces.data() + first_force * n_points,
                                     heights.data() + first * n_points};
      if (has_friction)
      {
        lines.tangential_displacement = tangential_displacements.data() + first * n_points;
        lines.tangential_force = tangential_forces.data() + first_force * n_points;
      }
      if (observe)
        observe(lines);
    };
    if (force_interpolation(parameters.force_shape) == ForceInterpolation::impulse)
      // lines 0 ... of this block, the last displacement waits for its force
      show(results.steps, n_steps, 0, 1);
    else
    {
      if (results.steps == 0)
        show(0, 1, 0, 0);
      show(results.steps + 1, n_steps, 1, 1);
    }
    std::copy_n(heights.begin() + n_steps * n_points, n_points, last_height.begin());
    std::copy_n(displacements.begin() + (n_steps - 1) * n_points, n_points, older_displacement.begin());
    for (unsigned int i = 0; i < n_points; ++i)
      older_gap[i] = older_displacement[i] - heights[(n_steps - 1) * n_points + i];
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
    const bool linear = force_interpolation(parameters.force_shape) == ForceInterpolation::linear;
    // the newest step that the second march has as well, and its own second one
    const unsigned int stride = !second || steps_ratio < 2 ? 1 : second->second ? 4 : 2;
    const unsigned long common = (results.steps + n_steps) / stride * stride;
    double jump = is_rigid ? road.next_jump(results.steps * time_step) : HUGE_VAL;
    for (unsigned int k = 0; k < n_steps; ++k)
    {
      double whole = 0, whole_before = 0;
      if (is_rigid)
        watch_impulses(k, jump);
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const unsigned int before = k * n_points + i, now = before + n_points;
        if (forces[now] == 0 && forces[before] == 0)
          continue;
        const auto impulse = [&](const std::vector<double> &force)
        { return time_step * (linear ? 0.5 * (force[now] + force[before]) : force[now]); };
        results.impulse[i] += impulse(forces);
        results.largest_force = std::max(results.largest_force, forces[now]);
        const bool counts = residual[i] > 0 || impulse_steps == 0;
        whole += counts ? forces[now] : 0.;
        whole_before += counts ? forces[before] : 0.;
        if (has_friction)
          results.tangential_impulse[i] += impulse(tangential_forces);
      }
      results.square_integral +=
          time_step *
          (linear ? (whole * whole + whole * whole_before + whole_before * whole_before) / 3 : whole * whole);
      impulse_steps -= impulse_steps > 0;
      if (second && results.steps + k + 1 == common)
      {
        compared = sums();
        compared.steps = common;
      }
    }
    results.closed_points = stepper->closed_points;
    results.corrections = stepper->iterations;
    results.residual = stepper->residual;
    results.dissipation = stepper->dissipation;
    results.sticking_points = stepper->sticking_points;
    results.work.friction = results.dissipation;
  }

  void ModalConvolution::watch_open_sides(const unsigned int n_steps)
  {
    for (unsigned int k = 1; k <= n_steps && !at_open_sides.empty(); ++k)
    {
      const double *const force = forces.data() + k * n_points;
      double sum = 0;
      for (const unsigned int point : at_open_sides)
        sum += force[point];
      if (sum == 0)
        continue;
      results.forces_at_sides += sum;
      results.forces_meanwhile += std::accumulate(force, force + n_points, 0.);
    }
  }

  void ModalConvolution::watch_impulses(const unsigned int k, double &jump)
  {
    // a stepped impact takes two steps; points of a dense table are no kinks
    bool begins = false;
    for (unsigned int i = 0; i < n_points; ++i)
      begins =
          begins || (residual[i] == 0 && forces[(k + 1) * n_points + i] > 0 && forces[k * n_points + i] == 0);
    for (const double end = (results.steps + k + 1) * time_step; jump <= end;)
    {
      const double next = road.next_jump(jump);
      begins = begins || next - jump > 8 * time_step;
      jump = next;
    }
    if (begins)
      impulse_steps = 2;
  }

  void ModalConvolution::find_events(const unsigned int n_steps, const double *force)
  {
    // an impulse stands at the beginning of its step
    const double shift = force_interpolation(parameters.force_shape) == ForceInterpolation::impulse ? 0 : 1;
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
    heights.assign((n_steps + 1) * n_points, 0.);
    unsigned long line = results.steps == 0 ? 0 : results.steps + 1;
    const unsigned long first = line, last = results.steps + n_steps;
    std::vector<double> times, places, shown, u, q;
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
                              shown.resize(times.size());
                              road.heights(i, times.data(), times.size(), shown.data());
                              for (std::size_t k = 0; k < shown.size(); ++k)
                                heights[(begin + k) * n_points + i] = shown[k];
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
    if (observe)
      observe({first, static_cast<unsigned int>(line - first), n_points, time_step, displacements.data(),
               forces.data(), heights.data()});
    const auto append = [](std::vector<ContactEvent> &to, const std::vector<ContactEvent> &from)
    { to.insert(to.end(), from.begin() + to.size(), from.end()); };
    append(results.impacts, events->impacts);
    append(results.releases, events->releases);
    results.impulse = events->impulse;
    results.square_integral = events->square_integral;
    results.work = events->work();
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
    file("result/square_integral", r.square_integral);
    file("result/unseen_square_integral", r.unseen_square_integral);
    file("result/forces_at_sides", r.forces_at_sides);
    file("result/forces_meanwhile", r.forces_meanwhile);
    if (stepper)
    {
      file("last/height", last_height);
      file("last/impulse_steps", impulse_steps);
      file("last/older_displacement", older_displacement);
      file("last/older_gap", older_gap);
      r.work.exchange(file);
      if (modal_work)
        modal_work->exchange(file);
      show_modal_work(last_displacement.data(), last_height.data());
      stepper->propagator->exchange(file);
      stepper->solver->exchange(file);
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
      file("stepper/relaxed", stepper->relaxed);
      r.dissipation = stepper->dissipation;
      r.sticking_points = stepper->sticking_points;
    }
    if (events)
    {
      events->exchange(file);
      r.work = events->work();
    }
    exchange_second_march(file);
  }

  Marks ModalConvolution::marks() const
  {
    return {
        {"rows", {double(model.n_rows())}}, {"poles", pole_marks(model)}, {"relaxation", {model.relaxation}}};
  }

  MarchCheckpoint road_checkpoint(const std::string &folder)
  {
    return {folder + "/modal_convolution.h5", "Modal convolution", 9};
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/analyses/modal_convolution/road_stepper.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/processor_clock.h>
#include <vibrocontact/numerics/doubled_step.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

// What a modal convolution tells about itself: its error by a second run, its work, the road between its steps.
namespace vibrocontact
{
  namespace
  {
    /// of the longest that the poles allow: pieces of the event-located second run
    constexpr double shorter_pieces = 0.6;

    /// Linear forces make errors of second order, but for what a cut memory leaves out.
    bool is_of_second_order(const ModalConvolutionParameters &parameters)
    {
      return force_interpolation(parameters.force_shape) == ForceInterpolation::linear &&
             parameters.memory == 0 && !(parameters.takes_theta() && parameters.theta > 0.5);
    }

    double sum_of_points(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.);
    }
  } // namespace

  double ModalConvolutionResult::unseen_share() const
  {
    return square_integral > 0 ? std::sqrt(unseen_square_integral / square_integral) : 0.;
  }

  bool ModalConvolution::has_rigid_points() const
  {
    return std::any_of(residual.begin(), residual.end(), [](const double value) { return value == 0; });
  }

  std::string ModalConvolution::second_march() const
  {
    return !second           ? ""
           : events          ? "a second run with shorter pieces"
           : steps_ratio > 1 ? "a second run with twice the step"
                             : "a second run with half the step";
  }

  void ModalConvolution::begin_second_march(const ContactSolverParameters &solver, const BodyInContact &model,
                                            const RoadLaws &laws)
  {
    second_parameters = std::make_unique<ModalConvolutionParameters>(parameters);
    ModalConvolutionParameters &own = *second_parameters;
    own.error_estimate = false;
    own.end_time = last_step * time_step;
    if (events)
    {
      double fastest = 0;
      for (const auto &pole : model.poles)
        fastest = std::max(fastest, std::abs(pole));
      own.longest_piece = shorter_pieces * 2 / fastest;
    }
    else
    {
      // the recursion forgets nothing, so that what a memory cuts off is seen, unless the Green's functions never end
      const bool ends = std::all_of(model.poles.begin(), model.poles.end(),
                                    [](const std::complex<double> &pole) { return pole.real() < 0; });
      if (parameters.is_convolution() && (parameters.memory == 0 || ends))
      {
        own.method = "modal recursion";
        own.memory = 0;
      }
    }
    const auto make = [&](const double ratio)
    {
      steps_ratio = ratio;
      if (!events)
        own.time_step = ratio * time_step;
      if (own.memory > 0)
        own.memory = std::max(parameters.memory, own.time_step);
      second = std::make_unique<ModalConvolution>(own, solver, model, road, laws);
      // what is left of steps twice as long ends between two of them
      second->last_step = std::floor(last_step / ratio + 1e-9);
    };
    const auto make_finer = [&]
    {
      try
      {
        make(0.5);
      }
      catch (const InputError &error)
      {
        // a second run of twice as many steps may hold too much; the first one is the user's
        results.errors.failure = error.what();
      }
    };
    // the second run of a second run, in four times the step, tells how the error falls; with linear forces it is known
    const bool is_first = parameters.error_estimate;
    try
    {
      make(events ? 1 : 2);
      if (is_first && !events && !is_of_second_order(parameters))
        second->begin_second_march(solver, model, laws);
    }
    catch (const InputError &)
    {
      // forces that ring in steps twice as long do not in the half
      if (is_first)
        make_finer();
    }
    compared = sums();
  }

  ModalConvolution::Sums ModalConvolution::sums() const
  {
    return {results.steps, results.impulse, results.tangential_impulse, results.square_integral};
  }

  void ModalConvolution::advance_second_march()
  {
    if (events)
      compared = sums();
    if (!results.errors.failure.empty())
      return;
    const double begin = processor_seconds();
    try
    {
      const unsigned long wanted = std::lround(compared.steps / steps_ratio);
      while (second->results.steps < wanted)
        second->advance(wanted - second->results.steps);
      compare_second_march();
    }
    catch (const ConvergenceError &error)
    {
      results.errors.failure = error.what();
    }
    results.errors.seconds += processor_seconds() - begin;
  }

  void ModalConvolution::compare_second_march()
  {
    const Sums &one = compared, two = second->sums();
    RoadMarchErrors &errors = results.errors;
    errors.time = one.steps * time_step;
    const ModalConvolution *const third = second->second.get();
    const bool has_third = third && steps_ratio > 1 && second->results.errors.failure.empty() &&
                           4 * third->results.steps == one.steps;
    const Sums coarsest = has_third ? third->sums() : two;
    // how far the first is off, in parts of `size`; of two runs of an exact method by all of their difference, from
    // half the steps by that of the longer ones, with linear forces, of second order, by a third
    const double factor = events                           ? std::sqrt(3.)
                          : steps_ratio < 1                ? std::sqrt(8.)
                          : is_of_second_order(parameters) ? 1 / std::sqrt(3.)
                                                           : 1;
    const auto error = [&](const double a, const double b, const double c, const double size)
    {
      if (!(size > 0))
        return 0.;
      const double largest = std::max(std::abs(a), std::abs(b)),
                   share = has_third ? doubled_step_error(a, b, c) : doubled_step_error(a, b);
      return share * largest / size * factor;
    };
    const auto force = [&](const Sums &sums)
    { return std::hypot(sum_of_points(sums.impulse), sum_of_points(sums.tangential_impulse)); };
    const double whole = std::max(force(one), force(two));
    errors.impulse = std::max(
        error(sum_of_points(one.impulse), sum_of_points(two.impulse), sum_of_points(coarsest.impulse), whole),
        error(sum_of_points(one.tangential_impulse), sum_of_points(two.tangential_impulse),
              sum_of_points(coarsest.tangential_impulse), whole));
    double largest = 0;
    for (unsigned int i = 0; i < n_points; ++i)
      largest = std::max({largest, std::abs(one.impulse[i]), std::abs(two.impulse[i])});
    errors.worst_point = 0;
    for (unsigned int i = 0; i < n_points; ++i)
      errors.worst_point =
          std::max(errors.worst_point, error(one.impulse[i], two.impulse[i], coarsest.impulse[i], largest));
    const double rms = std::sqrt(one.square_integral), other = std::sqrt(two.square_integral);
    errors.rms_force = error(rms, other, std::sqrt(coarsest.square_integral), std::max(rms, other));
  }

  void ModalConvolution::exchange_second_march(CheckpointFile &file)
  {
    if (!second)
      return;
    CheckpointFile own = file.group("second");
    second->exchange(own);
    file("compared/steps", compared.steps);
    file("compared/impulse", compared.impulse);
    file("compared/square_integral", compared.square_integral);
    if (has_friction)
      file("compared/tangential_impulse", compared.tangential_impulse);
    results.errors.exchange(file);
    file("errors/worst_point", results.errors.worst_point);
  }

  void ModalConvolution::check_steps_of_the_road(const unsigned int n_steps) const
  {
    // the last step of those before is looked at once more: only now the force that follows it is known
    const unsigned long again = results.steps > 0;
    const double begin = (results.steps - again) * time_step, end = (results.steps + n_steps) * time_step;
    for (unsigned int i = 0; i < n_points; ++i)
      for (double t = residual[i] == 0 ? road.next_step_up(i, begin) : HUGE_VAL; t <= end;
           t = road.next_step_up(i, t))
      {
        // the first line that is not before it, whatever rounding makes of its time, and the next one
        const double at = std::ceil((t - begin) / time_step - 1e-6) - again;
        const unsigned int line = std::clamp(at, 0., double(n_steps)), next = std::min(line + 1, n_steps);
        if (!(forces[line * n_points + i] > 0 || forces[next * n_points + i] > 0))
          continue;
        std::ostringstream text;
        text << "The road steps up at " << road.distance(t) << " m under contact point " << i << " (t = " << t
             << " s), which is rigid, so that no finite impulse follows it: give the step a ramp, or the "
                "body a "
                "tread.";
        throw InputError(text.str());
      }
  }

  void ModalConvolution::look_between_steps(const unsigned int n_steps)
  {
    constexpr unsigned int every = road_look_interval;
    if (!road.has_profile() || n_steps < 4)
      return;
    const double begin = processor_seconds();
    std::vector<double> between(n_points);
    // in the middle between multiples, where blocks end
    for (unsigned long k = (every + every / 2 - results.steps % every) % every; k + 3 <= n_steps; k += every)
    {
      // somewhere between the ends of the steps, never twice at the same place
      const double golden = 0.6180339887498949 * (results.steps + k), x = golden - std::floor(golden);
      const double weight[4] = {-x * (x - 1) * (x - 2) / 6, (x + 1) * (x - 1) * (x - 2) / 2,
                                -(x + 1) * x * (x - 2) / 2, (x + 1) * x * (x - 1) / 6};
      // at rigid points kinks are impulses
      if (is_rigid && road.next_jump((results.steps + k) * time_step) <= (results.steps + k + 3) * time_step)
        continue;
      road.heights((results.steps + k + 1 + x) * time_step, between.data());
      double force = 0;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        if (!(forces[(k + 1) * n_points + i] > 0 && forces[(k + 2) * n_points + i] > 0))
          continue;
        double unseen = between[i];
        for (unsigned int j = 0; j < 4; ++j)
          unseen -= weight[j] * heights[(k + j) * n_points + i];
        force += unseen * stiffness[i];
      }
      results.unseen_square_integral += every * time_step * force * force;
    }
    results.errors.seconds += processor_seconds() - begin;
  }

  void ModalConvolution::show_modal_work(const double *const displacement, const double *const height)
  {
    if (!modal_work)
      return;
    results.work.stored = modal_work->energy();
    for (unsigned int i = 0; i < n_points; ++i)
      results.work.stored += law[i].potential(displacement[i] - height[i]);
    results.work.damping = modal_work->damping();
  }

  void ModalConvolution::account(const unsigned int n_steps)
  {
    const double begin = processor_seconds();
    const bool impulses = force_interpolation(parameters.force_shape) == ForceInterpolation::impulse;
    WorkAccount &work = results.work;
    std::vector<double> rows((has_friction ? 2 : 1) * n_points);
    std::vector<char> yields;
    for (unsigned int i = 0; i < n_points; ++i)
      yields.push_back(!law[i].is_rigid());
    for (unsigned int k = 0; k < n_steps; ++k)
    {
      const double belt = -time_step * road.sliding_speed();
      double normal = 0, lost = 0, along = 0;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        const unsigned int before = k * n_points + i, now = before + n_points;
        rows[i] = forces[now];
        if (has_friction)
        {
          rows[n_points + i] = tangential_forces[now];
          along += belt * (impulses || parameters.force_shape == "constant"
                               ? tangential_forces[now]
                               : 0.5 * (tangential_forces[now] + tangential_forces[before]));
        }
        if (forces[now] == 0 && (impulses || forces[before] == 0))
          continue;
        if (!impulses)
        {
          const std::vector<double> &moves = yields[i] ? heights : displacements;
          normal += 0.5 * (forces[before] + forces[now]) * (moves[now] - moves[before]);
          continue;
        }
        // the impulse stands at the beginning of the step: by central differences about it
        double older = k > 0 ? displacements[before - n_points] : older_displacement[i],
               gap = k > 0 ? older - heights[before - n_points] : older_gap[i];
        if (results.steps + k == 0)
          gap = older - 2 * heights[before] + heights[now];
        // of a law that yields the road moves the spring
        normal += 0.5 * forces[now] *
                  ((yields[i] ? heights : displacements)[now] - (yields[i] ? older - gap : older));
        if (residual[i] == 0 && gap > 0)
          lost += 0.5 * forces[now] * gap;
      }
      work.impacts += lost;
      work.add_power(normal + lost);
      if (has_friction)
        work.add_power(along);
      work.least_work = std::min(work.least_work, work.work());
      if (modal_work)
        modal_work->add(rows.data());
    }
    work.friction = stepper->dissipation;
    show_modal_work(&displacements[n_steps * n_points], &heights[n_steps * n_points]);
    results.errors.seconds += processor_seconds() - begin;
  }
} // namespace vibrocontact

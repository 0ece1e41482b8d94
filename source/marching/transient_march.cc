#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/marching/step_levels.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/numerics/doubled_step.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

namespace vibrocontact
{
  /// A run step by step, with its sums.
  class TransientMarch::Steps
  {
  public:
    Steps(const TransientParameters &parameters, const ContactSections &contact,
          const ContactSolverParameters &solver, const ContactPair &pair, const DriveFunction &drive,
          DynamicState &state, TransientResult &result)
        : pair(pair), contact(contact), law(normal_law_of_points(contact, pair.interface.contacts)),
          scheme(find_creep_scheme(contact.first().creep_scheme)), drive(drive), state(state), result(result),
          forces(forces_of(state)), now(drive(state.time)),
          step_levels(parameters, contact, solver, pair, now.creepage.speed), next(state),
          half_time(parameters.end_time / 2), propagates_exactly(parameters.propagates_exactly()),
          last(steps_until(parameters.end_time, step_levels.shortest()))
    {
      result.contacts.resize(pair.interface.contacts.all.size());
      if (result.steps > 0)
        return;
      result.energy.initial = result.energy.stored = result.energy.available =
          stored_energy(pair, law, state);
      result.level = step_levels.n_levels() - 1;
    }

    bool is_over() const { return step_levels.tick(state) >= last; }
    void start_afresh() { step_levels.start_afresh(); }

    /// result.converged = false, and the state as it was, if it does not converge
    void step()
    {
      try
      {
        step_levels.advance(state, drive, last, next, then, result);
        check_contact_in_grid(pair.interface.contacts, contact, then.creepage.speed, next.contact.status);
      }
      // what was computed so far is kept, whoever gives up
      catch (const InputError &error)
      {
        result.converged = false;
        result.message = error.what();
      }
      catch (const ConvergenceError &error)
      {
        result.converged = false;
        result.message = error.what();
      }
      if (!result.converged)
        return;
      ++result.steps;
      result.time = next.time;
      const double h = next.time - state.time;
      const Forces then_forces = forces_of(next);
      add(result, h, forces.on_body, then_forces.on_body);
      const PlacedContacts &contacts = pair.interface.contacts;
      double least = std::numeric_limits<double>::infinity();
      unsigned int first = 0;
      for (unsigned int k = 0; k < contacts.all.size(); ++k)
      {
        ForceSums &sums = result.contacts[k];
        const auto local = [&](const Forces &all) -> std::array<double, 3> {
          return {{all.of_contacts[k][1], all.of_contacts[k][2], all.of_contacts[k][0]}};
        };
        add(sums, h, local(forces), local(then_forces));
        const double *const gaps = next.contact.y.data() + first;
        const unsigned int n_points = contacts.all[k].grid.n_points();
        const double gap = *std::min_element(gaps, gaps + n_points);
        take_smallest_gap(gap, sums);
        least = std::min(least, gap);
        first += n_points;
      }
      take_smallest_gap(least, result);
      forces = then_forces;
      add_modal_motions(h);
      add_step(result.energy, pair, law, scheme, state, now, next, then);
      // the next step overwrites the other one
      std::swap(state, next);
      now = then;
    }

  private:
    /// Resultants at an instant [N]: of each contact (normal, x, y), and on body 1 along x, y, z.
    struct Forces
    {
      std::vector<std::array<double, 3>> of_contacts;
      std::array<double, 3> on_body;
    };

    Forces forces_of(const DynamicState &at) const
    {
      const PlacedContacts &contacts = pair.interface.contacts;
      Forces forces;
      forces.of_contacts = contacts.resultants(at.R);
      forces.on_body = contacts.force_on(0, forces.of_contacts);
      return forces;
    }

    void take_smallest_gap(const double gap, ForceSums &sums) const
    {
      sums.smallest_gap = result.steps == 1 ? gap : std::min(sums.smallest_gap, gap);
    }

    /// The exact propagator has no error of modes that nothing touches.
    void add_modal_motions(const double h)
    {
      if (next.time <= half_time)
        return;
      // a run that was resumed with another end has another middle, and may be beyond it
      if (state.time <= half_time || result.modal_motions.empty() || result.middle != half_time)
        result.modal_motions.assign(pair.n_modes(), {});
      result.middle = half_time;
      if (propagates_exactly && next.R.all_zero() && state.R.all_zero())
        return;
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
      {
        TransientResult::ModalMotion &motion = result.modal_motions[k];
        motion.time += h;
        motion.q += h * next.q[k];
        motion.q_square += h * next.q[k] * next.q[k];
        motion.v_square += h * next.v[k] * next.v[k];
      }
    }

    /// Two tangential components, then the normal one.
    static void add(ForceSums &sums, const double h, const std::array<double, 3> &before,
                    const std::array<double, 3> &after)
    {
      const auto tangential_square = [](const std::array<double, 3> &force)
      { return force[0] * force[0] + force[1] * force[1]; };
      sums.tangential_square += h * (tangential_square(before) + tangential_square(after)) / 2;
      sums.impulse += h * (before[2] + after[2]) / 2;
      sums.force_square += h * (before[2] * before[2] + after[2] * after[2]) / 2;
    }

    const ContactPair &pair;
    const ContactSections &contact;
    const PointLaws<NormalLaw> law;
    const CreepScheme &scheme;
    const DriveFunction &drive;
    DynamicState &state;
    TransientResult &result;
    Forces forces;
    Drive now, then;
    StepLevels step_levels;
    DynamicState next;
    const double half_time;
    const bool propagates_exactly;
    const long long last;
  };

  namespace
  {
    /// What the time scheme took from the modes or gave them, as a relative error of velocities and forces: half of its
    /// share in the energy that there was [-]. A scheme that damps as it steps is seen here where two steps agree by far
    /// too little of it (the fronts that theta = 1 wipes out at any step).
    double energy_error(const EnergyAccount &energy)
    {
      return energy.available > 0 ? std::abs(energy.numerical_modes) / energy.available / 2 : 0;
    }

    /// What a step leaves out is of third order: nothing weights the end of a step more than its beginning, as theta > 1/2,
    /// reactions of the end alone and the backward rate of W~ R, in the slip or of rests that relax, do.
    bool is_second_order(const TransientParameters &parameters, const ContactSections &contact,
                         const ContactPair &pair)
    {
      return pair.relaxing.empty() && (parameters.propagates_exactly() || parameters.theta == 0.5) &&
             !parameters.reacts_at_end_of_step() &&
             std::all_of(contact.all.begin(), contact.all.end(),
                         [](const ContactParameters &one) { return one.friction == 0; });
    }

    /// of the error of the rms force, that of the impulse is no less, however well both runs agree in it: forces too early
    /// and too late cancel, and at some steps they do so to nothing
    constexpr double least_of_rms = 0.2;
    /// of the root mean square over the last quarter: runs in vibration pass each other, and agree there by chance
    constexpr double least_of_mean = 0.5;

    void add(StepErrors &errors, const double time, const double impulse, const double rms_force,
             const double end_time)
    {
      const double h = time - errors.time;
      errors.time = time;
      errors.impulse = impulse;
      errors.rms_force = rms_force;
      const double last_quarter = 0.75 * end_time;
      if (errors.last_quarter != last_quarter)
        errors.averaged_time = errors.impulse_square = errors.rms_square = 0;
      errors.last_quarter = last_quarter;
      if (time < last_quarter)
        return;
      errors.averaged_time += h;
      errors.impulse_square += h * impulse * impulse;
      errors.rms_square += h * rms_force * rms_force;
      errors.impulse =
          std::max(impulse, least_of_mean * std::sqrt(errors.impulse_square / errors.averaged_time));
      errors.rms_force =
          std::max(rms_force, least_of_mean * std::sqrt(errors.rms_square / errors.averaged_time));
    }
  } // namespace

  TransientParameters with_doubled_step(TransientParameters parameters)
  {
    parameters.time_step *= 2;
    parameters.shortest_step *= 2;
    parameters.error_tolerance *= 8;
    return parameters;
  }

  TransientMarch::TransientMarch(const TransientParameters &parameters, const ContactSections &contact,
                                 const ContactSolverParameters &solver, const ContactPair &pair,
                                 const DriveFunction &drive, const Observer &observe,
                                 Companion *const companion)
      : parameters(parameters), doubled(with_doubled_step(parameters)), contact(contact), solver(solver),
        pair(pair), drive(drive), observe(observe), companion(companion)
  {
  }

  TransientMarch::~TransientMarch() = default;

  void TransientMarch::prepare()
  {
    if (steps)
      return;
    steps = std::make_unique<Steps>(parameters, contact, solver, pair, drive, state, sums);
    if (companion)
      coarse = std::make_unique<Steps>(doubled, contact, solver, pair, companion->drive, companion->state,
                                       companion->sums);
  }

  bool TransientMarch::is_over()
  {
    prepare();
    return !goes_on || steps->is_over();
  }

  void TransientMarch::follow()
  {
    const auto begin = WallClock::now();
    Companion &run = *companion;
    while (run.sums.converged && !coarse->is_over() && run.state.time < sums.time * (1 - 1e-12))
      coarse->step();
    run.errors.failure = run.sums.message;
    run.errors.seconds += seconds_since(begin);
    if (std::abs(run.sums.time - sums.time) > 1e-12 * sums.time)
      return;
    // of two steps of a second order scheme a third is the error, of any a part of 1 / sqrt(3)
    const double divisor = is_second_order(parameters, contact, pair) ? std::sqrt(3.) : 1;
    const double energy = energy_error(sums.energy);
    const double rms_force =
        std::max(energy, doubled_step_error(sums.rms_force(), run.sums.rms_force()) / divisor);
    const double impulse = std::max(
        {energy, least_of_rms * rms_force, doubled_step_error(sums.impulse, run.sums.impulse) / divisor});
    add(run.errors, sums.time, impulse, rms_force, parameters.end_time);
    constexpr double least_part = 1e-3;
    run.errors.rms_variation = doubled_step_error_of(sums.rms_variation(), run.sums.rms_variation(),
                                                     std::max({sums.rms_variation(), run.sums.rms_variation(),
                                                               least_part * sums.rms_force()})) /
                               divisor;
    run.errors.rms_tangential =
        doubled_step_error_of(sums.rms_tangential(), run.sums.rms_tangential(),
                              std::max(sums.rms_tangential(), least_part * sums.rms_force())) /
        divisor;
  }

  void TransientMarch::advance_block()
  {
    do
      advance_part(steps_between_fresh_starts(sums.steps));
    while (!is_over() && !is_between_blocks());
  }

  void TransientMarch::advance_part(const unsigned int n_steps)
  {
    const auto begin = WallClock::now();
    const double before = sums.seconds;
    prepare();
    const double estimate_before = companion ? companion->errors.seconds : 0;
    if (is_between_blocks())
    {
      steps->start_afresh();
      if (coarse)
        coarse->start_afresh();
    }
    const unsigned long last = sums.steps + n_steps;
    do
    {
      steps->step();
      if (sums.converged && coarse && companion->errors.failure.empty())
        follow();
      goes_on = sums.converged && observe(state, sums);
    } while (!is_over() && !is_between_blocks() && sums.steps < last);
    sums.seconds =
        before + seconds_since(begin) - (companion ? companion->errors.seconds - estimate_before : 0.);
    if (!sums.converged)
      throw ConvergenceError(sums.message);
  }

  std::string TransientMarch::pace() const
  {
    std::ostringstream text;
    text.precision(3);
    text << "t = " << state.time << " s, " << sums.seconds / sums.time << " times real time, "
         << double(sums.iterations) / sums.steps << " iterations per step";
    return text.str();
  }

  TransientResult transient(const TransientParameters &parameters, const ContactSections &contact,
                            const ContactSolverParameters &solver, const ContactPair &pair,
                            const DriveFunction &drive, DynamicState &state,
                            const TransientMarch::Observer &observe, Companion *const companion)
  {
    TransientMarch march(parameters, contact, solver, pair, drive, observe, companion);
    march.state = state;
    try
    {
      while (!march.is_over())
        march.advance_block();
    }
    catch (const ConvergenceError &)
    {
      // the sums say so
    }
    state = march.state;
    return march.sums;
  }
} // namespace vibrocontact

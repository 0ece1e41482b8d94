#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/polynomial.h>
#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/numerics/zero_crossing.h>
#include <vibrocontact/propagators/event_located.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// gaps below it are rounding, in parts of the largest height so far
    constexpr double gap_rounding = 1e-13;
  } // namespace

  void exchange(CheckpointFile &file, const std::string &name, std::vector<ContactEvent> &events)
  {
    std::vector<double> numbers;
    for (const ContactEvent &event : events)
      numbers.insert(numbers.end(), {event.time, double(event.point), event.impulse});
    file(name, numbers);
    events.clear();
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
      events.push_back({numbers[k], static_cast<unsigned int>(numbers[k + 1]), numbers[k + 2]});
  }

  double EventLocated::Piece::u(const unsigned int i, const double t) const
  {
    return polynomial(series.displacement(i), series.n_orders(), place(t));
  }

  double EventLocated::Piece::q(const unsigned int i, const double t) const
  {
    return polynomial(series.force(i), series.n_orders(), place(t));
  }

  void EventLocated::Piece::values(const unsigned int i, std::vector<double> &times,
                                   std::vector<double> &displacements, std::vector<double> &forces) const
  {
    for (double &t : times)
      t = place(t);
    displacements.resize(times.size());
    forces.assign(times.size(), 0.);
    wide_polynomial(series.displacement(i), series.n_orders(), times.data(), displacements.data(),
                    times.size());
    if (closed[i])
      wide_polynomial(series.force(i), series.n_orders(), times.data(), forces.data(), times.size());
  }

  EventLocated::EventLocated(const BodyInContact &model, const std::vector<Complex> &state, const Road &road,
                             const double longest_piece)
      : impulse(model.n_rows(), 0.), model(model), road(road), n(model.n_rows()), n_poles(model.n_poles()),
        piece(longest_piece), first(initial_derivative(model, 1)), second(initial_derivative(model, 2)),
        z(state), is_closed(n, 0), just_open(n, 0), series(model, road), modes(model)
  {
    if (model.residual.m() > 0 && model.residual.linfty_norm() > 0)
      throw InputError(
          "The event-located method needs rigid contact points, but the body has a residual or tread "
          "flexibility at its contact points: leave it out or take the modal recursion.");
    double fastest = 0, size = 0;
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      fastest = std::max(fastest, std::abs(model.poles[k]));
      for (unsigned int i = 0; i < n; ++i)
        size = std::max(size, std::abs(model.right(i, k) * model.left(i, k)));
    }
    if (initial_derivative(model, 0).linfty_norm() > 1e-9 * size * n_poles)
      throw InputError(
          "The event-located method needs Green's functions that begin with zero, but g(0) is not: "
          "identify the body with g(0) = 0 or take the modal recursion.");
    if (!(definiteness(first) > 0))
      throw InputError(
          "The event-located method needs g'(0) (the inverse of the mass that the contact points feel) "
          "positive definite, which it is not: leave out contact points, keep more modes or identify "
          "the body with that condition.");
    smooth_length = piece = std::min(piece, 2 / fastest);
    account_so_far.has_modes = ModalEnergy::applies(model);
    if (account_so_far.has_modes)
      account_so_far.initial = modes.energy(modes.from_equilibrium(z));
    if (!road.singular().empty())
      throw InputError(road.singular() +
                       ", which no impulse follows: give the profile a finite slope, or the "
                       "body a tread and a stepping method.");

    std::vector<unsigned int> touching;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double height = road.after(i, 0).value, distance = displacement(i, 0) - height;
      height_scale = std::max(height_scale, std::abs(height));
      const double rounding = smallest_gap();
      if (distance < -rounding)
      {
        std::ostringstream text;
        text << "Contact point " << i << " begins " << -distance
             << " m below the road: lower Road/Indentation or give a Loading time.";
        throw InputError(text.str());
      }
      if (distance <= rounding)
        touching.push_back(i);
    }
    if (!touching.empty())
      touch(touching);
  }

  double EventLocated::smallest_gap() const
  {
    // the road moves on while the time does not
    return gap_rounding * height_scale + 8 * std::numeric_limits<double>::epsilon() * now * rate_scale;
  }

  double EventLocated::displacement(const unsigned int i, const unsigned int order) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      Complex value = z[k];
      for (unsigned int j = 0; j < order; ++j)
        value = model.poles[k] * value + (j == 0 && !model.pole_load.empty() ? model.pole_load[k] : 0.);
      sum += 2 * (model.right(i, k) * value).real();
    }
    return sum;
  }

  double EventLocated::first_touch(const unsigned int i) const
  {
    const double *const u = series.displacement(i);
    const unsigned int n_orders = series.n_orders();
    const double length = series.length();
    // the piece may begin and end where the road jumps
    const PiecewisePolynomial::Value first_road = road.after(i, now),
                                     last_road = road.before(i, now + length);
    // what has just opened begins with a gap of zero but for rounding
    const double offset = just_open[i] ? u[0] - first_road.value : 0.;
    std::array<double, CrossingSamples::n> values, times, heights;
    for (unsigned int k = 0; k < CrossingSamples::n; ++k)
      times[k] = now + CrossingSamples::x[k] * length;
    wide_polynomial(u, n_orders, CrossingSamples::x.data(), values.data(), CrossingSamples::n);
    road.heights(i, times.data(), CrossingSamples::n, heights.data());
    heights.front() = first_road.value;
    heights.back() = last_road.value;
    for (unsigned int k = 0; k < CrossingSamples::n; ++k)
      values[k] -= heights[k] + offset;
    if (just_open[i])
      values[0] = 0;
    return first_zero_crossing(
        values,
        [&](const double x)
        {
          const double height = x < 1 ? road.height(i, now + x * length) : last_road.value;
          return polynomial(u, n_orders, x) - height - offset;
        },
        [&](const double x)
        {
          const double rate = x <= 0  ? first_road.first
                              : x < 1 ? road.at(i, now + x * length).first
                                      : last_road.first;
          return polynomial_slope(u, n_orders, x) - length * rate;
        },
        smallest_gap());
  }

  double EventLocated::first_release(const unsigned int i) const
  {
    const double *const q = series.force(i);
    const unsigned int n_orders = series.n_orders();
    double largest = 0;
    for (unsigned int k = 0; k < n_orders; ++k)
      largest += std::abs(q[k]);
    std::array<double, CrossingSamples::n> values;
    wide_polynomial(q, n_orders, CrossingSamples::x.data(), values.data(), CrossingSamples::n);
    values[0] = std::max(values[0], 0.);
    return first_zero_crossing(
        values, [&](const double x) { return polynomial(q, n_orders, x); },
        [&](const double x) { return polynomial_slope(q, n_orders, x); }, 1e-13 * largest);
  }

  void EventLocated::advance(const double end, const Observer &observe)
  {
    while (now < end)
    {
      const double jump = road.next_jump(now), target = std::min(end, jump);
      double length = std::min(piece, target - now);
      if (!closed.empty())
        length = std::min(length, smooth_length);
      const auto expand = [&]
      { return series.expand(z, now, length, closed, closed_inverse, length <= 1e-3 * piece); };
      double factor = expand();
      for (; factor < 1; factor = expand())
        length *= factor;
      if (!closed.empty())
        smooth_length = std::min(piece, length * factor);
      double x = 2;
      unsigned int point = 0;
      for (unsigned int i = 0; i < n; ++i)
        height_scale = std::max(height_scale, std::abs(series.displacement(i)[0]));
      for (unsigned int i = 0; i < n; ++i)
      {
        const double own = is_closed[i] ? first_release(i) : first_touch(i);
        if (own < x)
        {
          x = own;
          point = i;
        }
      }
      const bool event = x <= 1;
      x = std::min(x, 1.);
      if (!std::isfinite(series.displacement(0)[0]))
        throw ConvergenceError("The event-located motion is no longer finite.");
      const double begin = now;
      if (x > 0)
      {
        observe({begin, begin + x * length, series, is_closed});
        for (const unsigned int i : closed)
          impulse[i] += series.impulse(i, x);
        account(x);
        series.state(x, z);
        now = event ? begin + x * length : begin + length;
        if (!event && length == target - begin)
          now = target;
      }
      if (event || x * length > 1e-6 * piece)
        stuck = x * length > 1e-6 * piece ? 0 : stuck + 1;
      if (stuck > 1000)
      {
        std::ostringstream text;
        text << "More than 1,000 impacts and releases follow each other at t = " << now
             << " s: the points are too many for the event-located method, take the modal recursion.";
        throw ConvergenceError(text.str());
      }
      for (unsigned int i = 0; i < n; ++i)
        if (x > 1e-9)
          just_open[i] = 0;
      if (!event)
      {
        now == jump ? pass_jump() : project();
        continue;
      }
      if (is_closed[point])
      {
        releases.push_back({now, point});
        is_closed[point] = 0;
        just_open[point] = 1;
        closed.erase(std::find(closed.begin(), closed.end(), point));
        invert_closed();
        project();
        continue;
      }
      // points that touch at the same time, by symmetry for instance
      std::vector<unsigned int> touching;
      for (unsigned int i = 0; i < n; ++i)
        if (i == point || (!is_closed[i] && !just_open[i] &&
                           displacement(i, 0) - road.after(i, now).value <= smallest_gap()))
          touching.push_back(i);
      touch(touching);
    }
  }

  void EventLocated::account(const double x)
  {
    // Gauss's rule of eight points, on [0, 1]
    constexpr std::array<double, 4> offset = {{0.0917173212478249, 0.262766204958164, 0.398333238706813,
                                               0.480144928248768}},
                                    weight = {{0.181341891689181, 0.156853322938944, 0.111190517226687,
                                               0.0506142681451881}};
    for (unsigned int k = 0; k < 8; ++k)
    {
      const double place = x * (0.5 + (k % 2 == 0 ? 1 : -1) * offset[k / 2]),
                   duration = x * series.length() * weight[k / 2];
      double sum = 0, power = 0;
      for (const unsigned int i : closed)
      {
        const double force = polynomial(series.force(i), series.n_orders(), place);
        sum += force;
        power += force * polynomial_slope(series.displacement(i), series.n_orders(), place) / series.length();
      }
      square_integral += duration * sum * sum;
      account_so_far.add_power(duration * power);
      if (account_so_far.has_modes)
      {
        series.state(place, inner);
        account_so_far.damping += duration * modes.damping_power(modes.from_equilibrium(inner));
      }
    }
    account_so_far.least_work = std::min(account_so_far.least_work, account_so_far.work());
  }

  const WorkAccount &EventLocated::work()
  {
    if (account_so_far.has_modes)
      account_so_far.stored = modes.energy(modes.from_equilibrium(z));
    return account_so_far;
  }

  void EventLocated::exchange(CheckpointFile &file)
  {
    file("events", z);
    file("events/time", now);
    file("events/height_scale", height_scale);
    file("events/rate_scale", rate_scale);
    file("events/smooth_length", smooth_length);
    file("events/stuck", stuck);
    file("events/closed", closed);
    file("events/is_closed", is_closed);
    file("events/just_open", just_open);
    file("events/impulse", impulse);
    file("events/square_integral", square_integral);
    account_so_far.exchange(file);
    vibrocontact::exchange(file, "events/impacts", impacts);
    vibrocontact::exchange(file, "events/releases", releases);
    invert_closed();
  }
} // namespace vibrocontact

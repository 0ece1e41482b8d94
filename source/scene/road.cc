#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/expression.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/carried_waves.h>
#include <vibrocontact/scene/road.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    const double pi = std::acos(-1.);

    /// steps of the height below it are none [m]
    constexpr double least_step = 1e-12;

    /// The shortest distance of points that stand apart, 0 of a single one [m].
    double spacing_of(std::vector<double> places)
    {
      std::sort(places.begin(), places.end());
      double spacing = 0;
      for (std::size_t i = 1; i < places.size(); ++i)
        if (const double distance = places[i] - places[i - 1]; distance > 1e-9)
          spacing = spacing > 0 ? std::min(spacing, distance) : distance;
      return spacing;
    }

  } // namespace

  Road::Road(const RoadParameters &parameters, const std::vector<double> &places,
             const std::vector<double> &shapes, const double end_time)
      : places(places), shapes(shapes), speed(parameters.speed), indentation(parameters.indentation),
        loading_time(parameters.loading_time), sliding(parameters.sliding_speed)
  {
    make_speed(parameters, end_time);
    jumps.push_back(loading_time);
    std::sort(jumps.begin(), jumps.end());
    const RoadProfileEntry &kind = parameters.profile_entry();
    if (!kind.make)
      return;
    const auto [first, last] = std::minmax_element(places.begin(), places.end());
    const double begin = *first, end = *last + distance(end_time);
    const double spacing = spacing_of(places);
    const std::string way_out = "the distance of the contact points";
    // before many waves are summed
    if (spacing > 0 && kind.shortest_wave)
      check_carried_wave("The road of Road/" + kind.entry, kind.shortest_wave(parameters), spacing,
                         "lower Road/Last wavenumber, or make " + way_out + " smaller");
    profile = kind.make(parameters, begin, end);
    find_steps();
    if (spacing > 0 && !kind.shortest_wave)
      check_carried_waves(
          "Road/" + kind.entry,
          [&](const double s)
          { return profile.height.value(std::clamp(s, profile.height.begin(), profile.height.end())); },
          begin, end, spacing, way_out);
  }

  void Road::make_speed(const RoadParameters &parameters, const double end_time)
  {
    if (parameters.speed_expression.empty() && parameters.speed_table.empty())
      return;
    PiecewisePolynomial velocity;
    if (!parameters.speed_expression.empty())
    {
      const auto given = read_expression(parameters.speed_expression, "t", "Road/Speed expression",
                                         "the time t in s: write for instance 10+2*t");
      jumps = breaks_of(given, 0, end_time, end_time / 64, "Road/Speed expression", "t", "s").places;
      velocity = PiecewisePolynomial(given, 0, end_time, end_time / 4, jumps);
    }
    else
    {
      const CsvTable file = read_csv_file(parameters.speed_table, "Road/Speed table");
      const std::string source = "The speed of the table \"" + parameters.speed_table + "\"";
      const LinearTable checked(source, file.column("time_s"), file.column("speed_m_s"));
      checked(0);
      checked(end_time);
      // from zero on: the way begins there
      std::vector<double> t = {0}, v = {checked(0)};
      for (std::size_t k = 0; k < file.column("time_s").size(); ++k)
        if (file.column("time_s")[k] > 0)
        {
          t.push_back(file.column("time_s")[k]);
          v.push_back(file.column("speed_m_s")[k]);
        }
      velocity = PiecewisePolynomial::lines(t, v);
      jumps.insert(jumps.end(), t.begin(), t.end());
    }
    for (unsigned int k = 0; k <= 1000; ++k)
      if (!(velocity.value(end_time * k / 1000) >= 0))
        throw InputError("Road/Speed expression or Speed table falls below 0 or is no number at the time " +
                         std::to_string(end_time * k / 1000) + " s: the body rolls forward only.");
    travelled = velocity.integral();
  }

  void Road::find_steps()
  {
    for (const double place : profile.breaks)
      if (profile.height.after(place).value - profile.height.before(place).value > least_step)
        steps_up.push_back(place);
  }

  double Road::time_of(const std::vector<double> &positions, const unsigned int point, const double t) const
  {
    const double here = distance(t) + places[point], later = t * (1 + 1e-15);
    for (auto next = std::lower_bound(positions.begin(), positions.end(), here - 1e-14 * std::abs(here));
         next != positions.end(); ++next)
    {
      const double way = *next - places[point];
      const double time = travelled.empty() ? way / speed : travelled.first_reach(way);
      if (time > later)
        return time;
    }
    return std::numeric_limits<double>::infinity();
  }

  double Road::next_jump(const double t) const
  {
    const auto next = std::upper_bound(jumps.begin(), jumps.end(), t);
    double time = next == jumps.end() ? std::numeric_limits<double>::infinity() : *next;
    for (unsigned int i = 0; i < places.size() && !profile.breaks.empty(); ++i)
      time = std::min(time, time_of(profile.breaks, i, t));
    return time;
  }

  double Road::next_step_up(const unsigned int point, const double t) const
  {
    return time_of(steps_up, point, t);
  }

  double Road::loading(const double t) const
  {
    return t >= loading_time ? 1. : 0.5 * (1 - std::cos(pi * t / loading_time));
  }

  double Road::height(const unsigned int point, const double t) const
  {
    const double z = profile.height.empty() ? 0. : profile.height.value(distance(t) + places[point]);
    return loading(t) * (indentation + z) - shapes[point];
  }

  void Road::heights(const unsigned int point, const double *t, const unsigned int n, double *result) const
  {
    if (!profile.height.empty())
    {
      for (unsigned int k = 0; k < n; ++k)
        result[k] = distance(t[k]) + places[point];
      profile.height.values(result, n, result);
    }
    for (unsigned int k = 0; k < n; ++k)
      result[k] = loading(t[k]) * (indentation + (profile.height.empty() ? 0. : result[k])) - shapes[point];
  }

  void Road::heights(const double t, double *result) const
  {
    const double r = loading(t), s = distance(t);
    std::fill_n(result, places.size(), 0.);
    if (!profile.height.empty())
    {
      for (unsigned int i = 0; i < places.size(); ++i)
        result[i] = s + places[i];
      profile.height.values(result, places.size(), result);
    }
    for (unsigned int i = 0; i < places.size(); ++i)
      result[i] = r * (indentation + result[i]) - shapes[i];
  }

  double Road::profile_height(const unsigned int point, const double t) const
  {
    return profile.height.empty() ? 0. : profile.height.value(distance(t) + places[point]);
  }

  PiecewisePolynomial::Value Road::at(const unsigned int point, const double t) const
  {
    return side(point, t, &PiecewisePolynomial::at, t >= loading_time);
  }

  PiecewisePolynomial::Value Road::before(const unsigned int point, const double t) const
  {
    return side(point, t, &PiecewisePolynomial::before, t > loading_time || loading_time == 0);
  }

  PiecewisePolynomial::Value Road::after(const unsigned int point, const double t) const
  {
    return side(point, t, &PiecewisePolynomial::after, t >= loading_time);
  }

  PiecewisePolynomial::Value Road::side(const unsigned int point, const double t,
                                        PiecewisePolynomial::Value (PiecewisePolynomial::*const of)(double)
                                            const,
                                        const bool is_loaded) const
  {
    PiecewisePolynomial::Value z = {0, 0, 0};
    if (!profile.height.empty())
    {
      PiecewisePolynomial::Value s = {speed * t, speed, 0};
      if (!travelled.empty())
        s = (travelled.*of)(t);
      const PiecewisePolynomial::Value p = (profile.height.*of)(s.value + places[point]);
      z = {p.value, p.first * s.first, p.second * s.first * s.first + p.first * s.second};
    }
    z.value += indentation;
    if (!is_loaded)
    {
      const double w = pi / loading_time, r = 0.5 * (1 - std::cos(w * t)), r1 = 0.5 * w * std::sin(w * t),
                   r2 = 0.5 * w * w * std::cos(w * t);
      z = {r * z.value, r1 * z.value + r * z.first, r2 * z.value + 2 * r1 * z.first + r * z.second};
    }
    z.value -= shapes[point];
    return z;
  }
} // namespace vibrocontact

#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/expression.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/numerics/chebyshev_fit.h>
#include <vibrocontact/scene/carried_waves.h>
#include <vibrocontact/scene/road.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    const double pi = std::acos(-1.);

    /// steps of the height below it are none; no road is higher [m]
    constexpr double least_step = 1e-12, most_height = 1000;

    FunctionBreaks breaks_of(const std::function<double(double)> &f, const double begin, const double end,
                             const double length, const std::string &entry, const std::string &variable,
                             const std::string &unit)
    {
      const FunctionBreaks found = find_breaks(f, begin, end, length);
      if (found.rough)
        throw InputError(entry + " is not smooth nearly anywhere between " + variable + " = " +
                         number_text(begin) + " and " + number_text(end) + " " + unit +
                         " (noise, or ever faster swings): give a table in its place.");
      return found;
    }

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

    /// The height in front of a fit, which would only spread what is no number.
    std::function<double(double)> checked(const std::function<double(double)> &height)
    {
      return [height](const double s)
      {
        const double value = height(s);
        if (!(std::abs(value) <= most_height))
          throw InputError("Road/Expression is " + number_text(value) + " m at s = " + number_text(s) +
                           " m, but heights are finite numbers from " + number_text(-most_height) + " to " +
                           number_text(most_height) + " m: mend it there.");
        return value;
      };
    }
  } // namespace

  void RoadParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Profile", profile,
        "Where the height comes from: the entry Expression, the Table, or waves of the roughness class of "
        "ISO 8608. Units: none.",
        Selection("flat|expression|table|ISO 8608"));
    prm.add_parameter(
        "Expression", expression,
        "Height as an expression of the position s along the road (in m, 0 under the body's contact point "
        "at t = 0), for instance 5e-3*sin(2*pi*s/0.025). Units: m.",
        Anything());
    prm.add_parameter(
        "Table", table,
        "CSV file with the columns position_m and height_m; it has to cover the way and the contact "
        "points. Units: none.",
        FileName());
    prm.add_parameter(
        "Table interpolation", interpolation,
        "Between the points of the table: natural spline (smooth, but it swings beside steps and bends), "
        "linear (with kinks, which a rigid contact feels as impacts) or monotone (cubics without swings, "
        "never beyond the points). Units: none.",
        Selection("natural spline|linear|monotone"));
    prm.add_parameter("Class", iso_class, "Roughness class of ISO 8608. Units: none.",
                      Selection("A|B|C|D|E|F|G|H"));
    prm.add_parameter("First wavenumber", first_wavenumber,
                      "Of the waves of the class: cycles per length. Units: 1/m.", Double(1e-6, 1e6));
    prm.add_parameter("Last wavenumber", last_wavenumber, "Of the waves of the class. Units: 1/m.",
                      Double(1e-6, 1e6));
    prm.add_parameter("Wavenumber step", wavenumber_step,
                      "Distance of the waves; the road repeats itself after its inverse. Units: 1/m.",
                      Double(1e-6, 1e6));
    prm.add_parameter("Seed", seed, "Of the phases of the class's waves. Units: none.",
                      Integer(0, 2147483647));
    prm.add_parameter("Speed", speed, "Of the body over the road, if it is constant. Units: m/s.",
                      Double(0, 1e3));
    prm.add_parameter(
        "Speed expression", speed_expression,
        "Speed as an expression of the time t, for instance 10+2*t, in place of Speed; empty: none. "
        "Units: m/s.",
        Anything());
    prm.add_parameter(
        "Speed table", speed_table,
        "CSV file with the columns time_s and speed_m_s, linear in between, in place of Speed; empty: "
        "none. Units: none.",
        FileName());
    prm.add_parameter(
        "Sliding speed", sliding_speed,
        "How fast the contact points slide forward over the road, with friction only: that of the "
        "road under a locked wheel, negative if the road (a belt) drags them forward. It does not "
        "move the profile. Units: m/s.",
        Double(-1e3, 1e3));
    prm.add_parameter("Indentation", indentation,
                      "How far the road is pushed towards the body, from where both just touch. Units: m.",
                      Double(-1, 1));
    prm.add_parameter(
        "Loading time", loading_time,
        "Time in which road and indentation come to their full height, along half a cosine; 0: they are "
        "there from the beginning. Units: s.",
        Double(0, 1e6));
  }

  void RoadParameters::check() const
  {
    if (profile == "expression" && expression.empty())
      throw InputError("Road/Profile is expression, but Road/Expression is empty: give it.");
    if (profile != "expression" && !expression.empty())
      throw InputError("Road/Expression is given, but Road/Profile is " + profile +
                       ": set it to expression, or leave the expression out.");
    if (profile != "table" && !table.empty())
      throw InputError("Road/Table is given, but Road/Profile is " + profile +
                       ": set it to table, or leave the table out.");
    if (profile != "table" && interpolation != RoadParameters().interpolation)
      throw InputError("Road/Table interpolation is given, but Road/Profile is " + profile +
                       ": set it to table, or leave the interpolation out.");
    if (profile == "table" && table.empty())
      throw InputError("Road/Profile is table, but Road/Table is empty: name a file.");
    if (!speed_expression.empty() && !speed_table.empty())
      throw InputError("Road/Speed expression and Road/Speed table are both given: leave one.");
    if ((!speed_expression.empty() || !speed_table.empty()) && speed != 0)
      throw InputError("Road/Speed is given beside Road/Speed expression or Speed table: leave one.");
    if (first_wavenumber > last_wavenumber)
      throw InputError("Road/First wavenumber is larger than Road/Last wavenumber: exchange them.");
    if ((last_wavenumber - first_wavenumber) / wavenumber_step > 1e5)
      throw InputError("Road/Wavenumber step asks for more than 100,000 waves: enlarge it.");
  }

  Road::Road(const RoadParameters &parameters, const std::vector<double> &places,
             const std::vector<double> &shapes, const double end_time)
      : places(places), shapes(shapes), speed(parameters.speed), indentation(parameters.indentation),
        loading_time(parameters.loading_time), sliding(parameters.sliding_speed)
  {
    make_speed(parameters, end_time);
    jumps.push_back(loading_time);
    std::sort(jumps.begin(), jumps.end());
    if (parameters.profile == "flat")
      return;
    const auto [first, last] = std::minmax_element(places.begin(), places.end());
    make_profile(parameters, *first, *last + distance(end_time));
    find_steps();
    if (const double spacing = spacing_of(places); spacing > 0)
    {
      const std::string way_out = "the distance of the contact points";
      if (parameters.profile == "ISO 8608")
        check_carried_wave("The road of Road/Class", 1 / parameters.last_wavenumber, spacing,
                           "lower Road/Last wavenumber, or make " + way_out + " smaller");
      else
        check_carried_waves(
            "Road/" + std::string(parameters.profile == "table" ? "Table" : "Expression"),
            [&](const double s) { return profile.value(std::clamp(s, profile.begin(), profile.end())); },
            *first, *last + distance(end_time), spacing, way_out);
    }
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

  void Road::make_profile(const RoadParameters &parameters, const double begin, const double end)
  {
    if (parameters.profile == "table")
    {
      const CsvTable file = read_csv_file(parameters.table, "Road/Table");
      const std::vector<double> &x = file.column("position_m"), &z = file.column("height_m");
      const LinearTable covered("The road of the table \"" + parameters.table + "\"", x, z);
      covered(begin);
      covered(end);
      for (std::size_t i = 0; i < z.size(); ++i)
        if (std::abs(z[i]) > most_height)
          throw InputError(file.source + ", line " + std::to_string(file.lines[i]) + ", has a height of " +
                           number_text(z[i]) + " m, more than " + number_text(most_height) +
                           " m: give heights in m.");
      profile = parameters.interpolation == "linear"     ? PiecewisePolynomial::lines(x, z)
                : parameters.interpolation == "monotone" ? PiecewisePolynomial::monotone(x, z)
                                                         : PiecewisePolynomial::spline(x, z);
      if (parameters.interpolation != "natural spline")
        breaks.assign(x.begin() + 1, x.end() - 1);
      return;
    }
    // a point road still needs an interval
    const double last = std::max(end, begin + 1e-3);
    if (parameters.profile == "expression")
    {
      const auto height = checked(read_expression(parameters.expression, "s", "Road/Expression",
                                                  "the position s along the road: write for instance "
                                                  "5e-3*sin(2*pi*s/0.025)"));
      for (unsigned int k = 0; k <= 1000; ++k)
        height(begin + (last - begin) * k / 1000);
      // long enough for 200,000 intervals
      const double length = std::max(std::clamp((last - begin) / 64, 1e-4, 5e-3), 5e-6 * (last - begin));
      const FunctionBreaks found = breaks_of(height, begin, last, length, "Road/Expression", "s", "m");
      breaks = found.places;
      if (!found.singular.empty())
        singular_place =
            "Road/Expression has no finite slope at s = " + number_text(found.singular[0]) + " m";
      profile = PiecewisePolynomial(height, begin, last, length, breaks);
      return;
    }
    const unsigned int number = parameters.iso_class[0] - 'A';
    const unsigned int n_waves =
        1 +
        std::lround(std::floor(
            (parameters.last_wavenumber - parameters.first_wavenumber) / parameters.wavenumber_step + 1e-6));
    // the sum over k of a_k e^(j phi_k) (e^(j 2 pi dn x))^k, by Horner's rule
    std::vector<std::complex<double>> wave;
    std::uint32_t state = parameters.seed;
    for (unsigned int k = 0; k < n_waves; ++k)
    {
      const double n = parameters.first_wavenumber + k * parameters.wavenumber_step;
      state = 1664525u * state + 1013904223u;
      wave.push_back(std::polar(
          std::sqrt(2 * 16e-6 * std::pow(4., number) * std::pow(n / 0.1, -2) * parameters.wavenumber_step),
          2 * pi * state / 4294967296.));
    }
    profile = PiecewisePolynomial(
        [&](const double x)
        {
          const std::complex<double> step = std::polar(1., 2 * pi * parameters.wavenumber_step * x);
          double real = 0, imaginary = 0;
          for (unsigned int k = n_waves; k-- > 0;)
          {
            const double next = real * step.real() - imaginary * step.imag() + wave[k].real();
            imaginary = real * step.imag() + imaginary * step.real() + wave[k].imag();
            real = next;
          }
          const double angle = 2 * pi * parameters.first_wavenumber * x;
          return real * std::cos(angle) - imaginary * std::sin(angle);
        },
        begin, last, 0.5 / parameters.last_wavenumber);
  }

  void Road::find_steps()
  {
    for (const double place : breaks)
      if (profile.after(place).value - profile.before(place).value > least_step)
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
    for (unsigned int i = 0; i < places.size() && !breaks.empty(); ++i)
      time = std::min(time, time_of(breaks, i, t));
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
    const double z = profile.empty() ? 0. : profile.value(distance(t) + places[point]);
    return loading(t) * (indentation + z) - shapes[point];
  }

  void Road::heights(const unsigned int point, const double *t, const unsigned int n, double *result) const
  {
    if (!profile.empty())
    {
      for (unsigned int k = 0; k < n; ++k)
        result[k] = distance(t[k]) + places[point];
      profile.values(result, n, result);
    }
    for (unsigned int k = 0; k < n; ++k)
      result[k] = loading(t[k]) * (indentation + (profile.empty() ? 0. : result[k])) - shapes[point];
  }

  void Road::heights(const double t, double *result) const
  {
    const double r = loading(t), s = distance(t);
    std::fill_n(result, places.size(), 0.);
    if (!profile.empty())
    {
      for (unsigned int i = 0; i < places.size(); ++i)
        result[i] = s + places[i];
      profile.values(result, places.size(), result);
    }
    for (unsigned int i = 0; i < places.size(); ++i)
      result[i] = r * (indentation + result[i]) - shapes[i];
  }

  double Road::profile_height(const unsigned int point, const double t) const
  {
    return profile.empty() ? 0. : profile.value(distance(t) + places[point]);
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
    if (!profile.empty())
    {
      PiecewisePolynomial::Value s = {speed * t, speed, 0};
      if (!travelled.empty())
        s = (travelled.*of)(t);
      const PiecewisePolynomial::Value p = (profile.*of)(s.value + places[point]);
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

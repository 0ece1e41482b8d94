#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/expression.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/scene/road_profile.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>

namespace vibrocontact
{
  namespace
  {
    /// no road is higher [m]
    constexpr double most_height = 1000;

    /// A way between the points of a table.
    struct Interpolation
    {
      std::string name;
      PiecewisePolynomial (*through)(const std::vector<double> &x, const std::vector<double> &z);
      /// slope and curvature of a natural spline are continuous, for which it may swing
      bool breaks_at_points;
    };

    const std::vector<Interpolation> &interpolations()
    {
      static const std::vector<Interpolation> rows = {{"natural spline", PiecewisePolynomial::spline, false},
                                                      {"linear", PiecewisePolynomial::lines, true},
                                                      {"monotone", PiecewisePolynomial::monotone, true}};
      return rows;
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

    /// A point road still needs an interval.
    double end_of_interval(const double begin, const double end)
    {
      return std::max(end, begin + 1e-3);
    }

    /// A spline may swing where a table has a hole, or its corners alone.
    /// @param begin @param end of the way
    void check_swings(const CsvTable &file, const std::vector<double> &x, const std::vector<double> &z,
                      const PiecewisePolynomial &height, const double begin, const double end)
    {
      constexpr double most_beyond = 0.5, rounding = 1e-9;
      constexpr unsigned int n_looks = 16;
      const auto [least, most] = std::minmax_element(z.begin(), z.end());
      const double beyond =
          most_beyond * (*most - *least) + rounding * std::max(std::abs(*least), std::abs(*most));
      for (std::size_t i = 0; i + 1 < x.size(); ++i)
      {
        const double from = std::max(x[i], begin), to = std::min(x[i + 1], end);
        for (unsigned int k = 1; k < n_looks && from < to; ++k)
        {
          const double value = height.at(from + (to - from) * k / n_looks).value;
          if (value < *least - beyond || value > *most + beyond)
            throw InputError(file.source + ", line " + std::to_string(file.lines[i + 1]) + ": from " +
                             number_text(x[i]) + " to " + number_text(x[i + 1]) +
                             " m the spline through the points swings to " + number_text(value) +
                             " m, far beyond all heights of the table: give more points there, or set "
                             "Road/Table interpolation = linear or monotone.");
        }
      }
    }

    RoadProfile profile_of_table(const RoadParameters &parameters, const double begin, const double end)
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
      const Interpolation &way = find_named(interpolations(), parameters.interpolation, "interpolation");
      RoadProfile profile;
      profile.height = way.through(x, z);
      if (way.breaks_at_points)
        profile.breaks.assign(x.begin() + 1, x.end() - 1);
      else
        check_swings(file, x, z, profile.height, begin, end);
      return profile;
    }

    RoadProfile profile_of_expression(const RoadParameters &parameters, const double begin, const double end)
    {
      const double last = end_of_interval(begin, end);
      RoadProfile profile;
      const auto height = checked(read_expression(parameters.expression, "s", "Road/Expression",
                                                  "the position s along the road: write for instance "
                                                  "5e-3*sin(2*pi*s/0.025)"));
      for (unsigned int k = 0; k <= 1000; ++k)
        height(begin + (last - begin) * k / 1000);
      // long enough for 200,000 intervals
      const double length = std::max(std::clamp((last - begin) / 64, 1e-4, 5e-3), 5e-6 * (last - begin));
      const FunctionBreaks found = breaks_of(height, begin, last, length, "Road/Expression", "s", "m");
      profile.breaks = found.places;
      if (!found.singular.empty())
        profile.singular_place =
            "Road/Expression has no finite slope at s = " + number_text(found.singular[0]) + " m";
      profile.height = PiecewisePolynomial(height, begin, last, length, profile.breaks);
      return profile;
    }

    RoadProfile profile_of_class(const RoadParameters &parameters, const double begin, const double end)
    {
      const unsigned int number = parameters.iso_class[0] - 'A';
      const unsigned int n_waves =
          1 + std::lround(std::floor((parameters.last_wavenumber - parameters.first_wavenumber) /
                                         parameters.wavenumber_step +
                                     1e-6));
      // the sum over k of a_k e^(j phi_k) (e^(j 2 pi dn x))^k, by Horner's rule
      std::vector<std::complex<double>> wave;
      std::uint32_t state = parameters.seed;
      for (unsigned int k = 0; k < n_waves; ++k)
      {
        const double n = parameters.first_wavenumber + k * parameters.wavenumber_step;
        state = 1664525u * state + 1013904223u;
        wave.push_back(std::polar(
            std::sqrt(2 * 16e-6 * std::pow(4., number) * std::pow(n / 0.1, -2) * parameters.wavenumber_step),
            2 * dealii::numbers::PI * state / 4294967296.));
      }
      RoadProfile profile;
      profile.height = PiecewisePolynomial(
          [&](const double x)
          {
            const std::complex<double> step =
                std::polar(1., 2 * dealii::numbers::PI * parameters.wavenumber_step * x);
            double real = 0, imaginary = 0;
            for (unsigned int k = n_waves; k-- > 0;)
            {
              const double next = real * step.real() - imaginary * step.imag() + wave[k].real();
              imaginary = real * step.imag() + imaginary * step.real() + wave[k].imag();
              real = next;
            }
            const double angle = 2 * dealii::numbers::PI * parameters.first_wavenumber * x;
            return real * std::cos(angle) - imaginary * std::sin(angle);
          },
          begin, end_of_interval(begin, end), 0.5 / parameters.last_wavenumber);
      return profile;
    }

    double shortest_wave_of_class(const RoadParameters &parameters)
    {
      return 1 / parameters.last_wavenumber;
    }
  } // namespace

  const std::vector<RoadProfileEntry> &road_profiles()
  {
    static const std::vector<RoadProfileEntry> rows = {
        {"flat", "", nullptr, "", false, nullptr, nullptr},
        {"expression", "Expression", &RoadParameters::expression, "", false, profile_of_expression, nullptr},
        {"table", "Table", &RoadParameters::table, "Table interpolation", true, profile_of_table, nullptr},
        {"ISO 8608", "Class", nullptr, "Class, First wavenumber, Last wavenumber, Wavenumber step, Seed",
         false, profile_of_class, shortest_wave_of_class}};
    return rows;
  }

  const RoadProfileEntry &RoadParameters::profile_entry() const
  {
    return find_named(road_profiles(), profile, "profile of a road");
  }

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

  void RoadParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Profile", profile,
        "Where the height comes from: the entry Expression, the Table, or waves of the roughness class of "
        "ISO 8608. Units: none.",
        Selection(selection(names_of(road_profiles()))));
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
        Selection(selection(names_of(interpolations()))));
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
    const auto check_taken =
        [&](const bool given, const bool taken, const std::string &entry, const std::string &by)
    {
      if (given && !taken)
        throw InputError("Road/" + entry + " is given, but Road/Profile is " + profile + ": set it to " + by +
                         ", or leave Road/" + entry + " out.");
    };
    for (const RoadProfileEntry &row : road_profiles())
    {
      if (row.value && row.name == profile && (this->*row.value).empty())
        throw InputError("Road/Profile is " + profile + ", but Road/" + row.entry + " is empty: give it.");
      if (row.value)
        check_taken(!(this->*row.value).empty(), row.name == profile, row.entry, row.name);
    }
    check_taken(interpolation != RoadParameters().interpolation, profile_entry().interpolates,
                "Table interpolation", "table");
    if (!speed_expression.empty() && !speed_table.empty())
      throw InputError("Road/Speed expression and Road/Speed table are both given: leave one.");
    if ((!speed_expression.empty() || !speed_table.empty()) && speed != 0)
      throw InputError("Road/Speed is given beside Road/Speed expression or Speed table: leave one.");
    if (first_wavenumber > last_wavenumber)
      throw InputError("Road/First wavenumber is larger than Road/Last wavenumber: exchange them.");
    if ((last_wavenumber - first_wavenumber) / wavenumber_step > 1e5)
      throw InputError("Road/Wavenumber step asks for more than 100,000 waves: enlarge it.");
  }
} // namespace vibrocontact

#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/expression.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/marching/roughness.h>
#include <vibrocontact/scene/carried_waves.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace vibrocontact
{
  namespace
  {
    /// no roughness is higher [m]
    constexpr double most_height = 1;

    /// What is no height is told where it is evaluated.
    std::function<double(double)> checked(const std::string &name,
                                          const std::function<double(double)> &height)
    {
      return [=](const double s)
      {
        const double value = height(s);
        if (!(std::abs(value) <= most_height))
          throw InputError(name + " is " + number_text(value) + " m at s = " + number_text(s) +
                           " m, but heights are finite numbers from " + number_text(-most_height) + " to " +
                           number_text(most_height) + " m: mend it there.");
        return value;
      };
    }
  } // namespace

  void RoughnessParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Expression", expression,
        "Height as an expression of the position s along the track (in m, 0 under the nominal contact "
        "point at t = 0), for instance 1e-6*sin(2*pi*s/0.05); empty: none. Units: m.",
        Anything());
    prm.add_parameter(
        "Table", table,
        "CSV file with the columns position_m and height_m, linear in between; it has to cover the way "
        "and the contact grid; empty: none. Units: none.",
        FileName());
    prm.add_parameter(
        "Spectrum", spectrum,
        "CSV file with the columns wavelength_m and level_dB: 1/3-octave levels, 20 log10 (rms / 1 um); "
        "empty: none. Units: none.",
        FileName());
    prm.add_parameter("Seed", seed, "Of the spectrum's random phases. Units: none.", Integer(0, 2147483647));
  }

  void RoughnessParameters::check() const
  {
    if (!expression.empty() + !table.empty() + !spectrum.empty() > 1)
      throw InputError("Section Transient/Roughness gives more than one of Expression, Table and Spectrum: "
                       "leave one.");
  }

  Roughness::Roughness(const RoughnessParameters &parameters, const ContactGrid &grid)
      : n_points(grid.n_points())
  {
    for (unsigned int i = 0; i < grid.n_x; ++i)
      x.push_back(grid.x(i));
    if (!parameters.expression.empty())
    {
      const std::string entry = "Transient/Roughness/Expression";
      height = checked(
          entry, read_expression(parameters.expression, "s", entry,
                                 "the position s along the track: write for instance 1e-6*sin(2*pi*s/0.05)"));
    }
    else if (!parameters.table.empty())
    {
      const CsvTable file = read_csv_file(parameters.table, "Transient/Roughness/Table");
      const std::string source = file.source + ", the height";
      height = checked(source, LinearTable(source, file.column("position_m"), file.column("height_m")));
    }
    else if (!parameters.spectrum.empty())
      make_waves(parameters.spectrum, parameters.seed);
  }

  void Roughness::make_waves(const std::string &file_name, const unsigned int seed)
  {
    const CsvTable file = read_csv_file(file_name, "Transient/Roughness/Spectrum");
    const std::vector<double> &wavelengths = file.column("wavelength_m"), &levels = file.column("level_dB");
    std::mt19937_64 generator(seed);
    // standard distributions differ between libraries
    const auto random = [&] { return std::ldexp(static_cast<double>(generator() >> 11), -53); };
    constexpr double pi = dealii::numbers::PI;
    // of a third of an octave, in its decimal logarithm
    constexpr double band_width = 0.1;
    for (unsigned int band = 0; band < wavelengths.size(); ++band)
    {
      if (!(wavelengths[band] > 0))
        throw InputError(file.source + " has a wavelength_m that is not positive.");
      const double rms = 1e-6 * std::pow(10., levels[band] / 20), centre = 2 * pi / wavelengths[band];
      const std::string line = file.source + ", line " + std::to_string(file.lines[band]) + ",";
      for (unsigned int other = 0; other < band; ++other)
        if (std::abs(std::log10(wavelengths[band] / wavelengths[other])) < 0.7 * band_width)
          throw InputError(line + " has a band about " + number_text(wavelengths[band]) +
                           " m that overlaps the one about " + number_text(wavelengths[other]) +
                           " m: bands are thirds of an octave, each given once.");
      if (!(rms <= most_height))
        throw InputError(line + " has a level of " + number_text(levels[band]) + " dB, heights of " +
                         number_text(rms) + " m (rms), more than " + number_text(most_height) +
                         " m: give levels over 1 um.");
      const double lower = centre * std::pow(10., -band_width / 2),
                   width = centre * std::pow(10., band_width / 2) - lower;
      if (x.size() > 1)
        check_carried_wave(line, 2 * pi / (lower + width), x[1] - x[0],
                           "leave this band out, or make the Grid spacing of the contact smaller");
      for (unsigned int k = 0; k < waves_per_band; ++k)
      {
        Wave wave;
        wave.amplitude = rms * std::sqrt(2. / waves_per_band);
        wave.wavenumber = lower + width * (k + random()) / waves_per_band;
        wave.phase = 2 * pi * random();
        for (const double position : x)
        {
          wave.cosine.push_back(std::cos(wave.wavenumber * position));
          wave.sine.push_back(std::sin(wave.wavenumber * position));
        }
        waves.push_back(std::move(wave));
      }
    }
  }

  std::vector<double> Roughness::heights(const double travelled) const
  {
    const unsigned int n_x = x.size();
    std::vector<double> result(n_points, 0.);
    if (height)
      for (unsigned int i = 0; i < n_x; ++i)
        result[i] = height(travelled - x[i]);
    for (const Wave &wave : waves)
    {
      const double angle = wave.wavenumber * travelled + wave.phase;
      const double s = wave.amplitude * std::sin(angle), c = wave.amplitude * std::cos(angle);
      for (unsigned int i = 0; i < n_x; ++i)
        result[i] += s * wave.cosine[i] - c * wave.sine[i];
    }
    for (unsigned int i = n_x; i < n_points; ++i)
      result[i] = result[i % n_x];
    return result;
  }
} // namespace vibrocontact

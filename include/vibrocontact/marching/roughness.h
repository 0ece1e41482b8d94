#pragma once

#include <vibrocontact/scene/contact_grid.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Transient / subsection Roughness`: at most one of expression, table and spectrum.
  struct RoughnessParameters
  {
    /// height [m] as an expression of the position s along the track [m]
    std::string expression;
    /// CSV files: position_m, height_m; or wavelength_m, level_dB
    std::string table, spectrum;
    /// of the spectrum's phases
    unsigned int seed = 1;

    void declare_parameters(dealii::ParameterHandler &prm);
    void check() const;
    bool any() const { return !expression.empty() || !table.empty() || !spectrum.empty(); }
  };

  /// Roughness along the track, the heights of both surfaces in one, the same for all y, > 0 towards the
  /// other body: it takes from the gap. The contact travels towards -x at speed V, hence
  ///
  ///   gap_i(t) = g_i - h(V t - x_i),      s = 0 under the nominal contact point at t = 0
  ///
  /// A spectrum is given by levels L in 1/3-octave bands of wavelength, 20 log10(rms / 1 um) at the centres
  /// lambda (bands lambda 10^(+-0.05), EN 15610). Each band is a sum of `waves_per_band` sines of equal
  /// amplitude, whose wavenumbers share the band and whose phases are random; the generator (mt19937_64,
  /// whose numbers the C++ standard fixes) gives the same ones on every machine.
  class Roughness
  {
  public:
    /// @throws InputError for an expression or a file that cannot be read. Collective.
    Roughness(const RoughnessParameters &parameters, const ContactGrid &grid);
    /// Heights at all points when the contact has travelled so far [m]; n.
    std::vector<double> heights(double travelled) const;

    static constexpr unsigned int waves_per_band = 16;

  private:
    struct Wave
    {
      double amplitude, wavenumber, phase;
      /// at the columns of the grid: cos and sin of k x
      std::vector<double> cosine, sine;
    };
    void make_waves(const std::string &file_name, unsigned int seed);

    const unsigned int n_points;
    /// of the grid's columns [m]
    std::vector<double> x;
    std::function<double(double)> height;
    std::vector<Wave> waves;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/numerics/chebyshev_fit.h>
#include <vibrocontact/numerics/piecewise_polynomial.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct RoadProfileEntry;

  /// `subsection Road`: what body 1 rolls over, and how fast.
  struct RoadParameters
  {
    /// of the table of profiles
    std::string profile = "flat";
    /// height [m] as an expression of the position s along the road [m]
    std::string expression;
    /// CSV: position_m, height_m; between its points a natural spline, linear or monotone
    std::string table, interpolation = "natural spline";
    /// A to H, and the wavenumbers of its waves [1/m]; the defaults are the deterministic road of
    /// doc/theory.md, corrections to the tyre paper
    std::string iso_class = "A";
    double first_wavenumber = 2, last_wavenumber = 50, wavenumber_step = 0.1;
    unsigned int seed = 20110525;

    /// [m/s], or as an expression of the time t, or a CSV: time_s, speed_m_s
    double speed = 0;
    std::string speed_expression, speed_table;
    /// of the contact points over the road, forward; with friction only [m/s]
    double sliding_speed = 0;
    /// how far the road is pressed towards the body [m], reached in the loading time [s]
    double indentation = 0, loading_time = 0;

    void declare_parameters(dealii::ParameterHandler &prm);
    void check() const;
    const RoadProfileEntry &profile_entry() const;
  };

  /// Height z over the position s along a road: an expression; a table, by its natural cubic spline (smooth, but it swings beside steps of the table), by
  /// straight lines (with kinks) or by monotone cubics (no swings, steps of the curvature); ISO 8608 (2016) classes A to H, Phi(n) = 4^(1 + number) 4e-6 m^3 (n / 0.1 1/m)^-2 with A = 0: the sum of
  /// waves a_k cos(2 pi n_k x + phi_k), a_k = sqrt(2 Phi(n_k) dn), phi_k = 2 pi s_k / 2^32 by the generator
  /// s_k = (1664525 s_(k-1) + 1013904223) mod 2^32, s_(-1) = seed, the same on every machine.
  struct RoadProfile
  {
    /// empty: flat
    PiecewisePolynomial height;
    /// where the height, its slope or curvature jumps; ascending [m]
    std::vector<double> breaks;
    /// where an expression has no finite slope, its entry in front; empty: nowhere
    std::string singular_place;
  };

  /// A row of the table of profiles.
  struct RoadProfileEntry
  {
    std::string name;
    /// the entry of section Road that gives it; flat: none
    std::string entry;
    /// its value, which has to be empty with other profiles; null: it has a default, which they leave alone
    std::string RoadParameters::*value;
    /// entries that it alone reads
    std::string reads;
    /// between points
    bool interpolates;
    /// Over the way from begin to end [m]; null: flat. @throws InputError for what cannot be read, or ends before. Collective.
    RoadProfile (*make)(const RoadParameters &parameters, double begin, double end);
    /// of its waves [m]; null: they are looked for
    double (*shortest_wave)(const RoadParameters &parameters);
  };
  const std::vector<RoadProfileEntry> &road_profiles();

  /// Of a function that a user gave. @param length of the pieces that it is looked at by
  /// @throws InputError of the entry if there is no end of them
  FunctionBreaks breaks_of(const std::function<double(double)> &f, double begin, double end, double length,
                           const std::string &entry, const std::string &variable, const std::string &unit);
} // namespace vibrocontact

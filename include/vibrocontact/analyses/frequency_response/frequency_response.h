#pragma once

#include <deal.II/base/parameter_handler.h>

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A place where a body is excited and looked at, in one direction.
  struct ResponsePoint
  {
    std::string name;
    /// contact frame [m]; without z a patch of the surface that can come into contact
    double x = 0, y = 0;
    std::optional<double> z;
    /// order of contact components: 0 z, 1 x, 2 y
    unsigned int component = 0;
  };

  /// `subsection Frequency response`: point and transfer mobilities (or receptances) of bodies between some
  /// points.
  ///
  /// A force F e^{i w t} at j moves i by u_i: receptance u_i / F [m/N], mobility i w u_i / F [m/(N s)].
  struct FrequencyResponseParameters
  {
    /// "name: x, y, direction; ..." or "name: x, y, z, direction"
    std::string points = "contact: 0, 0, z";
    /// names of bodies; empty: all meshed ones
    std::string bodies;
    /// [Hz]; the list, if it is not empty, takes the place of first, last, count and spacing
    double first = 50, last = 5000;
    std::vector<double> list;
    unsigned int count = 500;
    /// further ones where the response bends most
    unsigned int n_refined = 0;
    std::string spacing = "logarithmic", quantity = "mobility", method = "modal";
    /// where the direct solution is computed beside the modal ones [Hz]
    std::vector<double> check_frequencies;
    /// modes are left out above these frequencies, one after the other: what that costs [Hz]
    std::vector<double> cut_frequencies;
    /// size of the patch of surface that carries the force, along x and y [m]
    double load_length = 0.08, load_width = 0.02;
    /// rings: sums over the circumferential orders up to each of these are compared with the whole
    std::vector<unsigned int> truncated_orders;
    /// rings: also along the circle
    bool tangential = false;
    /// periodic rails: waves that pass from span to span
    bool pass_bands = false;
    /// impulse responses of bodies known by their Green's functions, 0: none [s]
    double impulse_time = 0, impulse_step = 1e-4;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError
    void check() const;
    std::vector<ResponsePoint> parsed_points() const;
    /// whether `bodies` names it, or none
    bool asks_for(const std::string &body) const;
    std::vector<double> frequencies() const;
    bool is_mobility() const { return quantity == "mobility"; }
    /// of the names of columns
    const char *unit_ending() const { return is_mobility() ? "_m_Ns" : "_m_N"; }
    /// The quantity that a receptance is shown as. @param frequency [Hz]
    std::complex<double> shown(const std::complex<double> &receptance, double frequency) const;
  };
} // namespace vibrocontact

#pragma once

#include <vibrocontact/reduction/modes.h>

#include <array>
#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// What a mode of a wheel looks like: family(m, n), m nodal circles, n nodal diameters.
  struct WheelLabel
  {
    /// direction in which the rim moves most: "axial", "radial", "circumferential" ("torsion" for n = 0)
    std::string family;
    unsigned int nodal_circles = 0, nodal_diameters = 0;

    std::string text() const
    {
      return family + "(" + std::to_string(nodal_circles) + "," + std::to_string(nodal_diameters) + ")";
    }
  };

  /// Where the wheel's parts are.
  struct WheelFrame
  {
    /// height of the axle above the contact point (the axle is parallel to y, over x = 0) [m]
    double axle_height = 0.46;
    /// points beyond this radius are the rim [m]
    double rim_radius = 0.385;
  };

  /// What the label of a mode is read from.
  struct WheelMotion
  {
    unsigned int nodal_diameters = 0;
    /// of the rim: energy of its axial, radial and circumferential motion [m^2 kg], mass [kg]
    std::array<double, 3> rim_energy = {};
    double rim_mass = 0;
    /// axial motion from the bore through the web to the tread, Fourier coefficient of the nodal diameters [m]
    std::vector<std::complex<double>> axial;
  };
  WheelLabel wheel_label(const WheelMotion &motion);

  /// Places of a wheel's section that its labels are read at: a raster of the rim's section and rings along the radius.
  struct WheelRaster
  {
    /// of the section; of the rim alone along the axle [m]
    double r_min, r_max, y_min, y_max, rim_radius;

    static constexpr unsigned int n_rim = 25, n_rings = 40;
    /// @throws InputError if the rim's radius is not one of the wheel
    void check(const std::string &body) const;
    bool is_rim(const double radius) const { return radius > rim_radius; }
    /// cell of the rim's raster, of n_rim
    unsigned int rim_cell(double radius, double y) const;
    /// of n_rings
    unsigned int ring(double radius) const;
  };

  /// Labels from the shapes at the nodes, weighted with the nodes' mass:
  /// - on a coarse raster of the rim's section every component (axial y, radial, circumferential) is
  ///   developed in a Fourier series of the angle round the axle; n is the number of diameters that holds
  ///   most of the rim's energy, the family the component that holds most of it at that n;
  /// - m counts the sign changes of the axial motion (its n-th Fourier coefficient, mean over the section's
  ///   thickness) along the radius, from the bore through the web to the tread. The radial (1,5) of the paper
  ///   has its circle where web and rim meet.
  std::vector<WheelLabel> wheel_labels(const SecondOrderSystem &system, const Modes &modes,
                                       const WheelFrame &frame);

  /// Texts in which a label that comes again gets a number: axial(0,2), axial(0,2)#2 (the second of a pair).
  std::vector<std::string> unique_texts(const std::vector<WheelLabel> &labels);

  /// Eq. 23: damping ratios by nodal diameters.
  std::vector<double> wheel_damping(const std::vector<WheelLabel> &labels, const ModeParameters &parameters);
} // namespace vibrocontact

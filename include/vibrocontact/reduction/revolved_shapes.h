#pragma once

#include <string>
#include <vector>

namespace vibrocontact
{
  /// The modes of a body of revolution on its section, and the strain energy of each element of it between them: what
  /// dampers act by (reduction/damped_wheel.h). Kept beside the modes in the cache (`<body>-section-<hash>.h5`, same key);
  /// replicated. A mode of n waves, at the angle theta from the contact point (fe/revolved_section.h):
  ///
  ///   even   u_a = W cos(n theta),  u_r = U cos(n theta),  u_t =  V sin(n theta)
  ///   odd    u_a = W sin(n theta),  u_r = U sin(n theta),  u_t = -V cos(n theta)
  ///   n = 0  both at once: u_a = W,  u_r = U,  u_t = -V
  struct RevolvedShapes
  {
    /// as in ModalReduction [rad/s]; n, and whether the family is the odd one; n_modes
    std::vector<double> omega;
    std::vector<int> waves, odd;
    /// a, r of one point of the section's boundary after the other [m]; 2 n_points
    std::vector<double> points;
    /// W, U, V of one point after the other, mode after mode [1/sqrt(kg)]; 3 n_points n_modes
    std::vector<double> shapes;
    /// centre a, r [m] and material id of one element after the other; 3 n_cells
    std::vector<double> cells;
    /// pairs of modes of equal n and family, first <= second; all n_pairs
    std::vector<int> first, second;
    /// phi^T K_e phi of a pair [1/s^2] around the axle, element after element; n_cells n_pairs
    std::vector<double> energies;

    /// of its hub, the middle of what is held: axial position in the section, lateral and vertical place from the nominal contact
    /// point [m]; of the whole body: mass [kg], first moment along the axle about the hub [kg m], moments of inertia about the axle and
    /// about a diameter through the hub [kg m^2]
    std::vector<double> hub = std::vector<double>(7, 0.);

    unsigned int n_modes() const { return omega.size(); }
    unsigned int n_points() const { return points.size() / 2; }
    unsigned int n_cells() const { return cells.size() / 3; }
    /// component 0 W, 1 U, 2 V of a mode at a point
    double value(const unsigned int point, const unsigned int component, const unsigned int mode) const
    {
      return shapes[3 * (n_points() * mode + point) + component];
    }
  };
} // namespace vibrocontact

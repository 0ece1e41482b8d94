#pragma once

#include <vibrocontact/bodies/reduced_body.h>
#include <vibrocontact/reduction/revolved_shapes.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/wheel_damper.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  class RevolvedSection;

  /// A mass on a spring k (1 + j eta), or fixed.
  struct SprungMass
  {
    /// [kg]; angular frequency sqrt(k / m), 0: fixed [rad/s]; eta [-]
    double mass = 0, omega = 0, loss_factor = 0;

    bool is_sprung() const { return omega > 0; }
    double stiffness() const { return mass * omega * omega; }
  };

  /// Of a damper along a direction: 0 axial, 1 radial, 2 circumferential.
  SprungMass sprung_mass(const WheelDamper &damper, unsigned int direction);
  /// Of an absorber, from the contact point around the axle [rad].
  double angle_of(const WheelDamper &damper, unsigned int number);

  /// A mass at a place of a body that moves by u = b^T q along one direction:
  ///
  ///   m x'' + k (1 + j eta) (x - b^T q) = 0,      force on q: k (1 + j eta) b (x - b^T q)
  struct AttachedMass : SprungMass
  {
    std::string label;
    /// b; n_modes [1/sqrt(kg)]
    std::vector<double> motion;
    /// translations of the whole body along x, y, z [-] and rotations about them through its hub [m] in terms of its own motion
    std::array<double, 6> along = {{0, 0, 0, 0, 0, 0}};
  };

  /// The points and elements of a section alone.
  RevolvedShapes shapes_without_modes(const RevolvedSection &section);

  /// Number of the point of the section's boundary that a damper stands at, the one next to its place.
  /// @param path of the section that the dampers have in the file, for the message
  /// @throws InputError if the place is not on the section's boundary
  unsigned int point_of(const RevolvedShapes &section, const WheelDamper &damper, const std::string &path);

  /// All masses of some dampers on a wheel; none of layers. Absorbers stand at the point of the
  /// section's boundary that is next to their place, number of them evenly around the axle; along the directions without
  /// spring they are fixed. A ring has its motions wave by wave: around the axle a shape cos(n theta) has the mean square
  /// 1/2, so that half of the ring's mass and stiffness goes with each mode of n > 0, and all of it with n = 0.
  /// @param path of the section that the dampers have in the file, for messages
  /// @throws InputError if a place is not on the section's boundary
  std::vector<AttachedMass> attached_masses(const RevolvedShapes &section,
                                            const std::vector<WheelDamper> &dampers, const std::string &path);

  /// Phi^T H Phi, H = sum over the elements e of eta_e K_e; n_modes square [1/s^2].
  /// @param loss_factor of each element; n_cells
  DenseMatrix loss_of_parts(const RevolvedShapes &section, const std::vector<double> &loss_factor);

  /// eta of each element: that of its material, and of the layers that it lies in.
  std::vector<double> loss_of_materials(const RevolvedShapes &section, const BodyParameters &body);
  std::vector<double> loss_of_layers(const RevolvedShapes &section, const std::vector<WheelDamper> &dampers,
                                     const std::string &path);

  /// Adds a loss to that of the modes: its diagonal to the damping ratios, all of it to `loss` if it couples them.
  void add_loss(ReducedBody &body, const DenseMatrix &added);

  /// The body with the masses attached, by modes again. With y = (q, x) of modes and sprung masses,
  ///
  ///   M = diag(1, m) + fixed masses m b b^T,   K = diag(w^2, 0) + sum k (b, -1)(b, -1)^T,   K X = M X diag(w'^2),  X^T M X = 1
  ///
  /// X carries over trace, loads and the loss, in full: X^T [H + sum eta k (b, -1)(b, -1)^T] X. Springs carry no static force,
  /// so that what forces on the body do statically is what it was. A mode keeps the name of that it is most alike.
  /// What the modes leave out does not feel the masses.
  ReducedBody with_attached(ReducedBody body, const std::vector<AttachedMass> &masses);
} // namespace vibrocontact

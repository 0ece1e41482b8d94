#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/rolling_parameters.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// What a hub that moves adds to the modes q of body 1 relative to it. Its coordinates y begin with the motions of the hub:
  /// translations along x, y, z and, on an axle, rotations about them. With Gamma of ContactPair::participation for these,
  ///
  ///   [ I        Gamma ] [ q'' ]   [ diag(2 zeta w)  0 ] [ q' ]   [ diag(w^2)  0     ] [ q ]
  ///   [ Gamma^T  M     ] [ y'' ] + [ 0  sum c b b^T    ] [ y' ] + [ 0      K + j H   ] [ y ] = forces
  struct HubCoordinates
  {
    /// 3 or 6
    unsigned int n_motions = 3;
    /// M of all that moves with the hub, body 1 included, K and H of what carries it; n square
    DenseMatrix mass, stiffness, loss;
    /// dampers c [Ns/m] and what each is stretched by, n_dampers x n
    DenseMatrix stretch;
    std::vector<double> damping;
    /// of the coordinates; several of one name are numbered by frequency
    std::vector<std::string> names;
    /// modes of body 1 that the last coordinates repeat, those of its copy: w, zeta and loss are theirs
    std::vector<unsigned int> copied;

    unsigned int n() const { return mass.m(); }
  };

  /// Gamma of the modes of body 1, without those that only round-off lets move the hub along a motion; n x n_motions.
  DenseMatrix hub_coupling(const ContactPair &pair, unsigned int n_motions);

  /// A hub that translates with the unsprung mass on its springs.
  HubCoordinates suspended_hub(const SuspensionParameters &suspension);

  /// A hub on an axle with a second wheel, body 1 turned round in a plane across the axle. Coordinates: hub of body 1,
  /// displacement of the other hub against the place where the former would carry it, fixed-interface modes of the axle, modes of
  /// the second wheel that move its hub. A rigid motion of the wheelset is one of the first hub alone:
  ///
  ///   u_2 = T u_1 + d,     T: carried over -length along y
  ///
  /// The second wheel touches nothing.
  /// @throws InputError if the hub of body 1 is not known to turn
  HubCoordinates axle_hub(const ContactPair &pair, const SuspensionParameters &suspension,
                          const AxleParameters &axle);

  /// As RollingParameters::hub says. @pre a hub with mass
  HubCoordinates hub_coordinates(const RollingParameters &rolling, const ContactPair &pair);
} // namespace vibrocontact

#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/hub_coordinates.h>
#include <vibrocontact/fe/axle_elements.h>
#include <vibrocontact/reduction/dense_modes.h>

#include <deal.II/base/numbers.h>

#include <algorithm>

namespace vibrocontact
{
  DenseMatrix hub_coupling(const ContactPair &pair, const unsigned int n_motions)
  {
    /// of the largest
    constexpr double least_participation = 1e-7;
    const unsigned int n = std::count(pair.body.begin(), pair.body.end(), 1);
    DenseMatrix result(n, n_motions);
    for (unsigned int d = 0; d < std::min(n_motions, pair.participation.n()); ++d)
    {
      double largest = 0;
      for (unsigned int k = 0; k < n; ++k)
        largest = std::max(largest, std::abs(pair.participation(k, d)));
      for (unsigned int k = 0; k < n; ++k)
        if (std::abs(pair.participation(k, d)) > least_participation * largest)
          result(k, d) = pair.participation(k, d);
    }
    return result;
  }

  HubCoordinates suspended_hub(const SuspensionParameters &suspension)
  {
    HubCoordinates hub;
    for (auto *const matrix : {&hub.mass, &hub.stiffness, &hub.loss, &hub.stretch})
      matrix->reinit(3, 3);
    for (unsigned int d = 0; d < 3; ++d)
    {
      hub.mass(d, d) = suspension.mass;
      hub.stiffness(d, d) = suspension.stiffness[d];
      hub.stretch(d, d) = 1;
      hub.damping.push_back(suspension.damping[d]);
      hub.names.push_back(std::string("hub:") + "xyz"[d]);
    }
    return hub;
  }

  namespace
  {
    /// Six motions at a distance along y of a rigid body that moves as given at 0.
    DenseMatrix carried(const double distance)
    {
      DenseMatrix T(6, 6);
      for (unsigned int d = 0; d < 6; ++d)
        T(d, d) = 1;
      T(0, 5) = -distance;
      T(2, 3) = distance;
      return T;
    }

    /// A plane across y turns along y and rotations about x and z round.
    double mirrored(const unsigned int motion)
    {
      return motion == 1 || motion == 3 || motion == 5 ? -1 : 1;
    }

    /// Of motions that lie in one plane, or along or about the axle.
    const char *family(const unsigned int motion)
    {
      constexpr const char *families[] = {"axle:x", "axle:y", "axle:z", "axle:z", "axle:torsion", "axle:x"};
      return families[motion];
    }

    /// Of a coordinate, after the motion that it has most to do with.
    template <typename Coupling>
    const char *family_of(const Coupling &coupling, const unsigned int n_motions)
    {
      unsigned int most = 0;
      for (unsigned int d = 0; d < n_motions; ++d)
        if (std::abs(coupling(d)) > std::abs(coupling(most)))
          most = d;
      return family(most % 6);
    }

    /// rows x all: picks `n` coordinates from `first` on
    DenseMatrix picked(const unsigned int first, const unsigned int n, const unsigned int n_all)
    {
      DenseMatrix result(n, n_all);
      for (unsigned int i = 0; i < n; ++i)
        result(i, first + i) = 1;
      return result;
    }

    /// The matrix of some motions in all coordinates, R^T A R.
    void add_seen(DenseMatrix &matrix, const DenseMatrix &A, const DenseMatrix &R)
    {
      matrix.add(1., projected(A, R));
    }
  } // namespace

  HubCoordinates axle_hub(const ContactPair &pair, const SuspensionParameters &suspension,
                          const AxleParameters &axle)
  {
    if (!pair.hub_inertia)
      throw InputError(
          "Rolling/Hub is axle, whose hubs turn, which is known of wheels by harmonics with modes "
          "alone: set Wheel/Model of body 1 to harmonics, or Hub to suspended.");
    const DenseMatrix Gamma = hub_coupling(pair, 6);
    const DenseMatrix &wheel = pair.hub_inertia->mass;
    const AxleMatrices beam = axle_matrices(axle);
    const DenseMatrix basis =
        fixed_interface_basis(beam.stiffness, beam.mass, 12, 2 * dealii::numbers::PI * axle.upper_frequency,
                              "the axle between its hubs");
    const unsigned int n_inner = basis.n() - 12;

    HubCoordinates hub;
    hub.n_motions = 6;
    for (unsigned int k = 0; k < Gamma.m(); ++k)
      for (unsigned int d = 0; d < 6; ++d)
        if (Gamma(k, d) != 0)
        {
          hub.copied.push_back(k);
          break;
        }
    const unsigned int n_copied = hub.copied.size(), n_axle = 12 + n_inner, n = n_axle + n_copied;
    for (auto *const matrix : {&hub.mass, &hub.stiffness, &hub.loss})
      matrix->reinit(n, n);

    // motions of both hubs and the axle's modes in the coordinates
    const DenseMatrix first = picked(0, 6, n);
    DenseMatrix second = picked(6, 6, n);
    add_block(second, carried(-axle.length), 0, 0);
    DenseMatrix both(n_axle, n);
    add_block(both, first, 0, 0);
    add_block(both, second, 6, 0);
    add_block(both, picked(12, n_inner, n), 12, 0);
    add_seen(hub.mass, projected(beam.mass, basis), both);
    add_seen(hub.stiffness, projected(beam.stiffness, basis), both);
    // the axle does not resist motions as a whole
    for (unsigned int d = 0; d < 6; ++d)
      for (unsigned int i = 0; i < n; ++i)
        hub.stiffness(d, i) = hub.stiffness(i, d) = 0;
    hub.loss.add(axle.material.loss_factor, hub.stiffness);

    add_seen(hub.mass, wheel, first);
    DenseMatrix turned(6 + n_copied, 6 + n_copied), moved(6 + n_copied, n);
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        turned(a, b) = mirrored(a) * mirrored(b) * wheel(a, b);
    for (unsigned int k = 0; k < n_copied; ++k)
    {
      turned(6 + k, 6 + k) = 1;
      for (unsigned int d = 0; d < 6; ++d)
        turned(6 + k, d) = turned(d, 6 + k) = mirrored(d) * Gamma(hub.copied[k], d);
      const double w = pair.omega[hub.copied[k]];
      hub.stiffness(n_axle + k, n_axle + k) = w * w;
    }
    add_block(moved, second, 0, 0);
    add_block(moved, picked(n_axle, n_copied, n), 6, 0);
    add_seen(hub.mass, turned, moved);

    hub.stretch.reinit(6, n);
    for (const bool far : {false, true})
    {
      const DenseMatrix box =
          product(carried(far ? -axle.box_distance : axle.box_distance), far ? second : first);
      DenseMatrix inertia(6, 6), springs(6, 6);
      for (unsigned int d = 0; d < 3; ++d)
      {
        inertia(d, d) = axle.box_mass;
        springs(d, d) = suspension.stiffness[d];
        hub.damping.push_back(suspension.damping[d]);
        for (unsigned int i = 0; i < n; ++i)
          hub.stretch(3 * far + d, i) = box(d, i);
      }
      add_seen(hub.mass, inertia, box);
      add_seen(hub.stiffness, springs, box);
    }

    for (unsigned int d = 0; d < 12; ++d)
      hub.names.push_back(family(d % 6));
    for (unsigned int i = 12; i < n_axle; ++i)
      hub.names.push_back(family_of([&](const unsigned int d) { return hub.mass(i, d); }, 12));
    for (const unsigned int k : hub.copied)
      hub.names.push_back(family_of([&](const unsigned int d) { return Gamma(k, d); }, 6));
    return hub;
  }

  HubCoordinates hub_coordinates(const RollingParameters &rolling, const ContactPair &pair)
  {
    return hub_kind(rolling.hub).has_axle ? axle_hub(pair, rolling.suspension, rolling.axle)
                                          : suspended_hub(rolling.suspension);
  }
} // namespace vibrocontact

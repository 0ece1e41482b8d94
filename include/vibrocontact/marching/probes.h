#pragma once

#include <vibrocontact/marching/contact_stepper.h>
#include <vibrocontact/marching/signal_parameters.h>
#include <vibrocontact/reduction/surface_shapes.h>

namespace vibrocontact
{
  /// The motion of a place on a body by its modes (what the residual flexibility adds beside the contact is
  /// left out): displacement against the held boundary (of a suspended hub:
  /// against its place in the equilibrium), velocity.
  struct Probe
  {
    std::string name, body;
    /// the point of the surface that was taken, contact frame [m]
    dealii::Point<3> place;
    /// displacement along the direction per amplitude of the body's modes [1/sqrt(kg)], which begin at
    /// `first` in the pair
    std::vector<double> shape;
    unsigned int first = 0;
    dealii::Tensor<1, 3> direction;

    /// On the modes of a pair whose hub is suspended instead of those of the held one.
    void hang(const SuspendedHub &hub);

    double displacement(const DynamicState &state) const { return product(state.q); }
    double velocity(const DynamicState &state) const { return product(state.v); }

  private:
    double product(const std::vector<double> &amplitudes) const
    {
      double sum = 0;
      for (unsigned int k = 0; k < shape.size(); ++k)
        sum += shape[k] * amplitudes[first + k];
      return sum;
    }
  };

  /// Puts a probe on the nearest point of the surface (linear between the vertices of a triangle).
  /// @param first number of the body's first mode in the pair
  /// @throws InputError if the surface is further from the place than a tenth of the body's size
  Probe place_probe(const ProbeRequest &request, const SurfaceShapes &surface, unsigned int first);

  /// The translations of a suspended hub or that of body 1 on an axle: hub_x, hub_y, hub_z.
  std::vector<Probe> hub_probes(const std::string &body, const SuspendedHub &hub);

  /// Requests for the rim of a wheel: on the middle of its field-side face (larger y) beside the contact,
  /// axial (along y) and radial (away from the axle).
  /// @param axle_height of the axle in the contact frame [m]; @param rim_radius points further from the axle
  /// are the rim [m]
  std::vector<ProbeRequest> rim_probes(const std::string &body, const SurfaceShapes &surface,
                                       double axle_height, double rim_radius);
} // namespace vibrocontact

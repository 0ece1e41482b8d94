#pragma once

#include <vibrocontact/coupled_bodies/sliding_frame.h>
#include <vibrocontact/coupled_bodies/stability_roots.h>
#include <vibrocontact/marching/contact_stepper.h>

#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// How much of each mode of the contact a state holds: its distance from the rolling equilibrium,
  /// x = (q - q_0, v, s - s_0, z - z_0), projected on the left eigenvectors of the linearised contact x' = A x,
  ///
  ///   a_k = y_k^H x / (y_k^H x_k),     y_k^H A = lambda_k y_k^H,     A x_k = lambda_k x_k.
  ///
  /// As long as the contact behaves as linearised, a_k moves as exp(lambda_k t) whatever else moves, so that
  /// two modes of nearly the same frequency are told apart, which no spectrum does.
  class ModeProjection
  {
  public:
    /// @param rest the equilibrium, and what it depends on
    /// @param n_roots of the largest growth rates; the one named `also` beside them
    /// @throws InputError, ConvergenceError of linearised_contact()
    ModeProjection(const ContactPair &pair, const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                   const DynamicState &rest, unsigned int n_roots, const std::string &also = "");

    /// by descending growth, frequency > 0
    const std::vector<StabilityRoot> &roots() const { return kept; }

    /// Velocity amplitude of each of these motions, where it is largest in the contact,
    /// 2 |a_k| max |lambda_k Psi q_k| [m/s].
    std::vector<double> amplitudes(const DynamicState &state) const;

  private:
    const DynamicState rest;
    std::vector<StabilityRoot> kept;
    /// directions of the states z
    std::vector<ContactDirection> across;
    /// coordinates of the forces that rests have relaxed to
    DenseMatrix shares;
    /// of each root, scaled so that |weights^H x| is its amplitude
    std::vector<std::vector<std::complex<double>>> weights;
  };
} // namespace vibrocontact

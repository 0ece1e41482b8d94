#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/propagators/modal_step.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Rolling/Suspension`: what carries a suspended hub. A translation u of the hub from its place
  /// in the rolling equilibrium obeys, along each of x, y, z,
  ///
  ///   m u'' + Gamma . q'' + c u' + k u = sum R - (sum R at equilibrium)
  ///
  /// (q: modes of body 1 relative to its hub, Gamma: ReducedBody::participation). Spring and damper are
  /// without force in the equilibrium: what carries the wheel there is their preload.
  struct SuspensionParameters
  {
    /// all that moves with the hub, body 1 included [kg]
    double mass = 0;
    /// along x, y, z [N/m], [Ns/m]
    double stiffness[3] = {0, 0, 0}, damping[3] = {0, 0, 0};

    void declare_parameters(dealii::ParameterHandler &prm);
    bool any() const;
  };

  /// A hub that translates: the modes of body 1 and of its hub as modes of one system. Its shapes x solve
  ///
  ///   [ diag(w^2)  0 ]       [ I        Gamma ]
  ///   [ 0          k ] x = l [ Gamma^T  m     ] x,    x^T M x = 1.
  ///
  /// Modes that do not move the hub stay what they were. Their modal damping is carried over to the diagonal
  /// of the new modes; the suspension's dampers act exactly, damping_force().
  struct SuspendedHub
  {
    /// amplitudes of the modes of the held body 1, then translations of the hub along x, y, z, per amplitude
    /// of the new modes; square
    DenseMatrix shapes;
    /// [kg], [Ns/m]
    double mass = 0, damping[3] = {0, 0, 0};
    /// modes of body 1 that act, and their participation Gamma, along x, y, z; n x 3 [sqrt(kg)]
    DenseMatrix participation;

    unsigned int n_held_modes() const { return shapes.m() - 3; }
    /// translation of the hub along a direction per amplitude of a mode of the pair, 0 for body 2 [1/sqrt(kg)]
    double motion(const unsigned int direction, const unsigned int mode) const
    {
      return mode < shapes.n() ? shapes(n_held_modes() + direction, mode) : 0.;
    }
    bool is_damped() const { return damping[0] > 0 || damping[1] > 0 || damping[2] > 0; }
    /// forces of the dampers for modal velocities [N]: the modes feel their -modal_force()
    template <typename Velocities>
    std::array<double, 3> damping_force(const Velocities &v) const
    {
      std::array<double, 3> force = {{0, 0, 0}};
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int j = 0; damping[d] > 0 && j < shapes.n(); ++j)
          force[d] += damping[d] * motion(d, j) * v[j];
      return force;
    }
    /// force on a mode of three forces along x, y, z on the hub [N/sqrt(kg)]
    double modal_force(const std::array<double, 3> &force, const unsigned int mode) const
    {
      return motion(0, mode) * force[0] + motion(1, mode) * force[1] + motion(2, mode) * force[2];
    }
    /// Amplitudes of the held body's modes, then hub x, y, z, then the modes of body 2.
    template <typename Number>
    std::vector<Number> held(const std::vector<Number> &amplitudes) const
    {
      std::vector<Number> result = amplitudes;
      for (unsigned int i = 0; i < shapes.m(); ++i)
      {
        result[i] = 0;
        for (unsigned int j = 0; j < shapes.n(); ++j)
          result[i] += shapes(i, j) * amplitudes[j];
      }
      return result;
    }
  };

  /// The dampers of a hub within a time step, at whose end they act on the velocity there: what they take from the
  /// modes is linear in the velocity that these would have without them,
  ///
  ///   v1 <- v1 - g_v S B v1,  q1 <- q1 - g_q S B v1,  S = (1 + C B g_v B^T)^-1 C
  ///
  /// (B: SuspendedHub::motion, C: damping, g: gains of force at the end of the step, ModalStep::g1).
  struct HubDamper
  {
    /// B; 3 x n_modes, empty: no dampers
    DenseMatrix motion;
    /// g_q S, g_v S; n_modes x 3
    DenseMatrix displacement, velocity;

    HubDamper(const SuspendedHub *hub, const std::vector<ModalStep> &steps);
    bool acts() const { return motion.m() > 0; }
    /// Takes from q and v what the dampers take of motion with the velocities `by`.
    void act(const DenseVector &by, DenseVector &q, DenseVector &v) const;
  };

  /// Words about a hub for the terminal: "held", "massless", "suspended", or "none" of half-spaces.
  std::string hub_text(const std::string &hub);
} // namespace vibrocontact

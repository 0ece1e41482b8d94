#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/propagators/modal_step.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Rolling/Suspension`: what carries a suspended hub, or each box of an axle. A translation u of the hub from its place
  /// in the rolling equilibrium obeys, along each of x, y, z,
  ///
  ///   m u'' + Gamma . q'' + c u' + k u = sum R - (sum R at equilibrium)
  ///
  /// (q: modes of body 1 relative to its hub, Gamma: ReducedBody::participation). Spring and damper are
  /// without force in the equilibrium: what carries the wheel there is their preload.
  struct SuspensionParameters
  {
    /// all that moves with a suspended hub, body 1 included [kg]
    double mass = 0;
    /// along x, y, z [N/m], [Ns/m]
    double stiffness[3] = {0, 0, 0}, damping[3] = {0, 0, 0};

    void declare_parameters(dealii::ParameterHandler &prm);
    bool any() const;
  };

  /// A hub that moves: the modes of body 1 and of what moves with its hub as modes of one system. Its shapes x solve
  ///
  ///   [ diag(w^2)  0 ]       [ I        Gamma ]
  ///   [ 0          K ] x = l [ Gamma^T  M     ] x,    x^T M x = 1
  ///
  /// with the matrices of HubCoordinates, whose first coordinates are the hub's translations along x, y, z and, on an axle, its
  /// rotations about them. Modes that do not move the hub stay what they were. The damping matrix of the held modes
  /// has its diagonal among the new modes in their damping ratios. The rest of it is a sum of dampers along its eigenvectors, with
  /// factors of either sign; they act with the dampers of the suspension, damping_force().
  struct SuspendedHub
  {
    /// amplitudes of the modes of the held body 1, then of the hub's coordinates, per amplitude of the new modes; square
    DenseMatrix shapes;
    /// coordinates of the hub, and its motions among them: 3 or 6
    unsigned int n_added = 3, n_motions = 3;
    /// of all that moves with the hub [kg]
    double mass = 0;
    /// where the hub's rotations turn about, from the nominal contact point [m]
    std::array<double, 3> centre = {{0, 0, 0}};
    /// of dampers, first those of the suspension [Ns/m], then those between modes [-]
    std::vector<double> damping;
    /// what each new mode stretches them by, n_dampers x n_modes [1/sqrt(kg)]; between modes [1/sqrt(s)]
    DenseMatrix dampers;
    /// Gamma of the modes of body 1 that act, n x n_added
    DenseMatrix coupling;

    unsigned int n_held_modes() const { return shapes.m() - n_added; }
    /// motion of the hub (0-2 along, 3-5 about x, y, z) per amplitude of a mode of the pair, 0 for body 2 [1/sqrt(kg)]
    double motion(const unsigned int direction, const unsigned int mode) const
    {
      return direction < n_motions && mode < shapes.n() ? shapes(n_held_modes() + direction, mode) : 0.;
    }
    /// How a place is carried along by a motion of the hub, m(direction); its own place from the nominal contact point.
    template <typename Point, typename Motion>
    auto carried(const Point &place, const Motion &m) const
    {
      const double x = place[0] - centre[0], y = place[1] - centre[1], z = place[2] - centre[2];
      return std::array<decltype(m(0)), 3>{
          {m(0) + m(4) * z - m(5) * y, m(1) + m(5) * x - m(3) * z, m(2) + m(3) * y - m(4) * x}};
    }
    bool is_damped() const
    {
      return std::any_of(damping.begin(), damping.end(), [](const double c) { return c != 0; });
    }
    /// What mode j feels of a velocity of mode k through the dampers [1/s].
    double modal_damping(const unsigned int j, const unsigned int k) const
    {
      double sum = 0;
      for (unsigned int d = 0; d < damping.size(); ++d)
        sum += damping[d] * dampers(d, j) * dampers(d, k);
      return sum;
    }
    /// forces of the dampers for modal velocities: the modes feel their -modal_force()
    template <typename Velocities>
    std::vector<double> damping_force(const Velocities &v) const
    {
      std::vector<double> force(damping.size(), 0.);
      for (unsigned int d = 0; d < force.size(); ++d)
        for (unsigned int j = 0; damping[d] != 0 && j < shapes.n(); ++j)
          force[d] += damping[d] * dampers(d, j) * v[j];
      return force;
    }
    /// force on a mode [N/sqrt(kg)] of forces along the dampers
    double modal_force(const std::vector<double> &force, const unsigned int mode) const
    {
      double sum = 0;
      for (unsigned int d = 0; d < force.size() && mode < shapes.n(); ++d)
        sum += dampers(d, mode) * force[d];
      return sum;
    }
    /// Amplitudes of the held body's modes, then of the hub's coordinates, then of the modes of body 2.
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
  /// (B: SuspendedHub::dampers, C: damping, g: gains of force at the end of the step, ModalStep::g1).
  struct HubDamper
  {
    /// B; n_dampers x n_modes, empty: no dampers
    DenseMatrix motion;
    /// g_q S, g_v S; n_modes x n_dampers
    DenseMatrix displacement, velocity;

    HubDamper(const SuspendedHub *hub, const std::vector<ModalStep> &steps);
    bool acts() const { return motion.m() > 0; }
    /// Takes from q and v what the dampers take of motion with the velocities `by`.
    void act(const DenseVector &by, DenseVector &q, DenseVector &v) const;
  };

  /// What becomes of the hub of body 1 in a motion about the equilibrium.
  struct HubKind
  {
    std::string name;
    /// it stays where it is in the equilibrium
    bool keeps_place;
    /// it follows, so that the normal force stays as given
    bool keeps_force;
    /// it moves with Rolling/Suspension/Unsprung mass, or with section Rolling/Axle (HubCoordinates)
    bool has_unsprung_mass, has_axle;
    /// for the terminal
    std::string text;

    bool has_mass() const { return has_unsprung_mass || has_axle; }
    /// half-spaces have none
    bool exists() const { return keeps_place || keeps_force || has_mass(); }
  };

  /// What Rolling/Hub can be.
  const std::vector<HubKind> &hub_kinds();
  /// One of them by its name, or that of half-spaces, "none".
  const HubKind &hub_kind(const std::string &name);
  /// Its name and words for the terminal.
  std::string hub_text(const std::string &name);
} // namespace vibrocontact

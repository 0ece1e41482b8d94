#pragma once

#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/scene/ring.h>

namespace vibrocontact
{
  /// Green's functions of the ring (scene/ring.h) order by order, Eq. 58 with the 1 / (2 pi R) that it lacks:
  ///
  ///   G(theta, omega) = 1/(2 pi R) sum_n [-omega^2 m I + j omega (C + D_n) + L_n]^-1 e^{j n theta}
  ///   C = 2 m Omega [[0, 1], [-1, 0]],     D_n = 2 xi sqrt(m) sqrt(L_n at rest)
  ///
  /// in the frame that turns with the ring; in the frame of the road, where contact points stand still,
  /// theta_ring = theta - Omega t: omega becomes omega + n Omega, a pole lambda becomes lambda - j n Omega with
  /// the same residue, and G(theta) differs from G(-theta). Orders n and -n have conjugate poles: all four of
  /// each n > 0 are kept, and two (of one sign, or real ones) of n = 0.
  enum class RingFrame
  {
    road,
    co_rotating
  };

  /// A point of the mean circle and the direction in which it moves and is pushed: radially inward (up at the
  /// bottom), or along theta.
  struct RingRow
  {
    /// [rad]
    double angle = 0;
    bool tangential = false;
  };

  /// The contact rows of a ring: all inward, then with friction all along theta.
  std::vector<RingRow> ring_rows(const RingParameters &ring, bool with_friction);

  /// Poles of the orders up to Highest order, static residual of those above it (Residual = true) and of the
  /// tread. @param rotation Omega [rad/s]
  /// @throws InputError if a motion is rigid or grows
  BodyInContact ring_poles(const RingParameters &ring, const std::vector<RingRow> &rows, double rotation = 0,
                           RingFrame frame = RingFrame::road);

  /// Gradient of the rows along theta of a rolling ring, the stretch of the material that flows through them:
  ///
  ///   de/ds = (v' + w) / R,     v = v_n e^(j n theta):  (j n v_n + w_n) / R
  ///
  /// in closed form of the orders that have poles. Under a force along the circle the stretch of all orders jumps, so that
  /// that of the residual and of the tread is differenced from the points where the material comes from: at those of the
  /// ring, in front of the first one too; the tread is free there. The tread does not turn with the circle: it shears, and
  /// its compression stretches nothing.
  /// @param body ring_poles() of ring_rows() with friction, in the frame of the road @param rotation not 0 [rad/s]
  /// @param difference upstream coefficients c: du/dx = sum_k c_k u(x - k spacing) / spacing
  void add_gradient(BodyInContact &body, const RingParameters &ring, double rotation,
                    const std::vector<double> &difference);

  /// That of what stands beside the poles: of the band by its static residual, and of the tread.
  /// @param band 2 n rows of the points, then those along theta of the places in front, as many as are known (near the first
  /// point shorter differences take their place), or empty [m/N]
  DenseMatrix residual_gradient(const RingParameters &ring, const DenseMatrix &band, double rotation,
                                const std::vector<double> &difference);

  /// ring_poles() by inversion of the 2 x 2 systems: orders up to Highest order alone, no residual, no tread.
  /// @param omega [rad/s]
  ComplexMatrix ring_receptance(const RingParameters &ring, const std::vector<RingRow> &rows, double rotation,
                                RingFrame frame, double omega);

  /// What forces that stand still in the frame move in orders Highest order + 1 to Residual order [m/N].
  DenseMatrix ring_residual(const RingParameters &ring, const std::vector<RingRow> &rows, double rotation,
                            RingFrame frame);

  /// What stands beside the orders up to Highest order: ring_residual() if the ring has Residual = true, and on the
  /// diagonal the tread, 1 / Tread stiffness for inward rows and 1 / Tread tangential stiffness for those along theta
  /// [m/N].
  DenseMatrix ring_rest(const RingParameters &ring, const std::vector<RingRow> &rows, double rotation,
                        RingFrame frame);

  /// The same ring at rest by its real modes: of each order n > 0 both branches, twice, a quarter of a wave apart.
  /// @throws InputError if a motion is rigid
  BodyInContact ring_modes(const RingParameters &ring, const std::vector<RingRow> &rows);

  /// What of a pole stands for its pair: the upper of two conjugate ones whole, real ones by half, the lower one not (0).
  double share_of_pair(const std::complex<double> &pole);

  /// @param pole of a motion in so many waves @param scale of frequencies of these motions [rad/s]
  /// @throws InputError if it grows
  void check_decay(const std::complex<double> &pole, unsigned int order, double scale, double rotation);
} // namespace vibrocontact

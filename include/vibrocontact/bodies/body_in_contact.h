#pragma once

#include <vibrocontact/base/complex_dense.h>

#include <algorithm>
#include <complex>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A linear body between some rows (displacements at its contact points, at places of forces, at probes), as contacts and
  /// their analyses see it. It moves by real modes, by poles or by both, and has a rest that follows forces at once:
  ///
  ///   modes   q_k'' + 2 zeta_k w_k q_k' + w_k^2 q_k = (trace^T f)_k + modal_load_k
  ///   poles   z_k' = lambda_k z_k + (left^T f)_k + pole_load_k
  ///   rest    relaxation r' + r = residual f + residual_load
  ///   u = trace q + 2 Re sum_k right_k z_k + r
  ///
  /// f and u have the same sign along a row. A mode with w = 0 is a rigid motion. Of two conjugate poles one is kept,
  /// whichever; a real pole carries half its residue. The rest is static but for stiffness-proportional damping C = beta K,
  /// whose relaxation is beta.
  ///
  /// Poles are Green's functions in modal form (Meftah & Duhamel 2011, Eqs 7 and 58; doc/theory.md, "Bodies known by their
  /// Green's functions"), R_k = right_k left_k^T:
  ///
  ///   g(t) = 2 Re sum_k R_k e^(lambda_k t) + residual delta(t),     t >= 0
  ///   G(omega) = sum_k [ R_k / (j omega - lambda_k) + R_k^* / (j omega - lambda_k^*) ] + residual
  ///
  /// One state per shape serves all rows. Rolling rings and identified bodies have left shapes of their own, their G need
  /// not be symmetric. Replicated on all ranks.
  struct BodyInContact
  {
    /// angular frequencies [rad/s] and damping ratios [-]; n_modes
    std::vector<double> omega, damping_ratio;
    /// mass-normalised shapes at the rows; n_rows x n_modes [1/sqrt(kg)]
    DenseMatrix trace;
    /// of constant loads (weight); n_modes or empty [N/sqrt(kg)]
    std::vector<double> modal_load;
    /// static answer of what neither modes nor poles have, tread included; n_rows square or empty [m/N]
    DenseMatrix residual;
    /// of the modes, then of the poles, e.g. n=12, branch 1; or empty
    std::vector<std::string> labels;
    /// its answer to the constant loads; n_rows or empty [m]
    std::vector<double> residual_load = {};
    /// beta [s]; without a residual that of poles which stand for one, see rest_by_poles()
    double relaxation = 0;
    /// lambda_k; n_poles [1/s]
    std::vector<std::complex<double>> poles = {};
    /// right and left shapes, n_rows x n_poles; their product in [m/(N s)]
    ComplexMatrix right = ComplexMatrix(), left = ComplexMatrix();
    /// what constant loads feed into the states; n_poles or empty
    std::vector<std::complex<double>> pole_load = {};
    /// Of bodies whose material flows through rows that stand still: d/dx of the vector that the tangential rows are
    /// components of, x forward, in axes that do not turn with them, of the right shapes and of the rest (normal rows zero).
    /// A rate in place u' is one of the material less V times this. n_rows x n_poles [1/m times right's], n_rows square
    /// [1/N]; or empty: nothing flows, or it is differenced between the points.
    ComplexMatrix gradient = ComplexMatrix();
    DenseMatrix residual_gradient = DenseMatrix();
    /// Phi^T M e of unit translations e of the whole body forward, across and up, and of rotations about these axes through its hub
    /// if it is known (ReducedBody::hub), n_modes x 3 or 6 [sqrt(kg)], [sqrt(kg) m]; or empty
    DenseMatrix participation = DenseMatrix();

    unsigned int n_modes() const { return omega.size(); }
    unsigned int n_poles() const { return poles.size(); }
    /// none if there are no labels
    std::vector<std::string> labels_of_modes() const
    {
      return {labels.begin(), labels.begin() + std::min<std::size_t>(n_modes(), labels.size())};
    }
    unsigned int n_rows() const
    {
      return n_modes() > 0 ? trace.m() : n_poles() > 0 ? right.m() : residual.m();
    }
  };

  /// A row of another body, in its direction or against it; factor 0: a row that does not move.
  struct SignedRow
  {
    unsigned int row;
    double factor;
  };

  /// The body between these rows, each as often as it is named.
  BodyInContact with_rows(const BodyInContact &body, const std::vector<SignedRow> &rows);

  /// Whether something follows forces beside modes and poles.
  bool has_rest(const BodyInContact &body);

  /// Two bodies under the same forces: u = u_first + u_second along each row. With the rows of the second turned
  /// (with_rows(), factor -1) it is the motion of the first relative to the second under the forces between them. A body by
  /// modes beside one by poles goes over to poles. and so does one of two rests that relax at two rates.
  /// @pre as many rows
  BodyInContact together(const BodyInContact &first, const BodyInContact &second);

  /// The same body with a pole for each mode (two real ones if it is damped beyond critical), for analyses that march
  /// in poles. Critical damping is taken for less by a hair and a rigid motion as a pair at +-j 1e-12 rad/s, which after a
  /// day has turned by 1e-7: both poles would be double.
  BodyInContact by_poles(const BodyInContact &body);

  /// The same body with real poles in place of a rest that relaxes, one for each eigenvalue w of the residual W = sum w x x^T
  /// but for those of rounding; a rest that does not relax stays:
  ///
  ///   z' = -z / beta + (w / 2 beta) x^T f,     r = 2 x z     (sums over the eigenvalues)
  ///
  /// The relaxation stays too: steps in time know these poles by it (propagators/step_weights.h).
  /// @pre W is symmetric and nothing flows (gradient is empty)
  BodyInContact rest_by_poles(const BodyInContact &body);

  /// 2 Re sum_k weight_k right_k left_k^T, n_rows square: what every quantity of g at real times is, of a body by poles.
  /// @param weights n_poles
  DenseMatrix sum_over_poles(const BodyInContact &body, const std::vector<std::complex<double>> &weights);
  /// Those of what constant forces do, -1 / lambda. @pre no rigid motion
  std::vector<std::complex<double>> static_weights(const BodyInContact &body);
  /// G(omega), n_rows square [m/N]; @param omega [rad/s]
  ComplexMatrix receptance(const BodyInContact &body, double omega);
  /// g(t) without its residual, n_rows square [m/(N s)], of a body by poles; @param t [s] >= 0
  DenseMatrix impulse_response(const BodyInContact &body, double t);
  /// d^k g / dt^k at t = 0+: 2 Re sum lambda_k^n R_k; n_rows square, of a body by poles. Rigid contact needs that of order 0
  /// to be zero and that of order 1 to be positive definite.
  DenseMatrix initial_derivative(const BodyInContact &body, unsigned int order);

  /// Whether a motion is rigid: nothing holds it against constant forces.
  bool is_rigid_motion(const std::complex<double> &pole);

  /// Numbers that change with the poles and with what their amplitudes mean: lambda and weighted sums of the right shapes,
  /// real and imaginary parts; 4 n_poles. For checkpoints of states.
  std::vector<double> pole_marks(const BodyInContact &body);

  /// Modal amplitude, as of a mode of unit mass, per unit of 2 |z_k|: free of how right and left shape share their size; 0 of a pole
  /// that nothing feeds.
  double amplitude_per_state(const BodyInContact &body, unsigned int k);

  /// Where state k of a body by poles comes to rest under the constant load: -load / lambda; 0 of a rigid motion.
  std::complex<double> rest_of_state(const BodyInContact &body, unsigned int k);
} // namespace vibrocontact

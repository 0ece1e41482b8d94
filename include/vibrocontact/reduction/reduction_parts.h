#pragma once

#include <vibrocontact/bodies/reduced_body.h>
#include <vibrocontact/reduction/modes.h>
#include <vibrocontact/reduction/wheel_labels.h>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// What a static analysis needs of a meshed body; kept in the cache by itself. Replicated.
  struct StaticReduction
  {
    std::string name;
    ContactGrid grid;
    unsigned int n_dofs = 0;
    /// P_c G P_c^T, G = K^-1 or the inertia-relief flexibility; 3 n square [m/N]
    DenseMatrix compliance;
    /// P_c G F, static contact displacement under the body's loads; 3 n [m]
    std::vector<double> load_response;
    /// contact displacement for a unit vertical displacement of the held boundary; 3 n [-]
    std::vector<double> lifting;
    /// 3 n and n, see ReducedBody
    std::vector<double> surface_height;
    /// rigid modes: P_c Phi_R, 3 n x n_rigid [1/sqrt(kg)], and Phi_R^T F [N/sqrt(kg)]
    DenseMatrix rigid_trace;
    std::vector<double> rigid_load;
  };

  /// The modes of a body as contact and results see them; kept in the cache by itself. Rigid modes first.
  /// Replicated.
  struct ModalReduction
  {
    unsigned int n_rigid_modes = 0, n_dofs = 0;
    /// [rad/s], [-], names; n_modes
    std::vector<double> omega, damping_ratio;
    std::vector<std::string> labels;
    /// see ReducedBody::loss
    DenseMatrix loss = DenseMatrix();
    /// what the damping ratios leave out of a viscous damping C: see ModalDamping::coupling [-]
    double damping_coupling = 0;
    /// P_c Phi, 3 n x n_modes [1/sqrt(kg)]; no rows without contact
    DenseMatrix trace;
    /// Phi^T F [N/sqrt(kg)]
    std::vector<double> load;
    /// Phi^T M e of unit translations e along x, y, z, of a body by harmonics also of rotations about them through its hub;
    /// n_modes x 3 or 6 [sqrt(kg)], [sqrt(kg) m]
    DenseMatrix participation;
    /// measured: see Modes
    double orthonormality_error = 0, residual = 0;
    /// wall time of the computation, factorisation included [s]
    double seconds = 0;
  };

  StaticReduction reduce_statically(const SecondOrderSystem &system, Flexibility &flexibility);

  /// Traces, loads and participations of given modes; without names and damping.
  ModalReduction modal_reduction(const SecondOrderSystem &system, const Modes &modes);

  /// Modes, their names and their damping: labels and Eq. 23 with `wheel`, otherwise numbers and strain
  /// energy. `shapes` gets the modes themselves if it is not null.
  ModalReduction reduce_modally(const SecondOrderSystem &system, Flexibility &flexibility,
                                const ModeParameters &parameters, const std::optional<WheelFrame> &wheel,
                                Modes *shapes = nullptr);

  /// The reduced body: residual flexibility W~ = P_c G P_c^T - Psi_e diag(w_e^-2) Psi_e^T over the elastic
  /// modes of `modal` (none if null: then W~ is the whole compliance).
  /// @throws ConvergenceError if W~ is not positive semi-definite to 1e-8 of its largest entry
  ReducedBody combine(const StaticReduction &statics, const ModalReduction *modal);
} // namespace vibrocontact

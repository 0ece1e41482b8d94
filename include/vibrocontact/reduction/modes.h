#pragma once

#include <vibrocontact/reduction/flexibility.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Modes` of a body: how many modes are kept, how they are damped and named.
  struct ModeParameters
  {
    /// all modes up to this frequency, 0: go by the count [Hz]
    double upper_frequency = 0;
    /// number of elastic modes, 0: go by the frequency
    unsigned int count = 0;
    /// damping ratio by the number of nodal diameters (Eq. 23): 0, 1, 2 and more [-]
    double damping_0 = 1e-3, damping_1 = 1e-2, damping_2 = 1e-4;
    /// all damping ratios of the body times this; no part of the reduction [-]
    double damping_factor = 1;
    /// beta of C = beta K: adds beta w / 2 to every damping ratio, after the factor; no part of the reduction [s]
    double stiffness_damping = 0;
    /// points further than this from the axle are the rim, whose motion names the family of a mode; 0: as far out as
    /// on the shipped wheel, see rim_radius() [m]
    double rim_radius = 0;

    /// Damping ratios of modes by the two entries above. @param omega [rad/s]
    std::vector<double> scaled(std::vector<double> damping_ratio, const std::vector<double> &omega) const;
    /// Whether any modes are asked for.
    bool any() const { return upper_frequency > 0 || count > 0; }
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError; `section` is named in it
    void check(const std::string &section) const;
    /// Everything that changes the modes, as text, for the key of the cache.
    std::string key() const;
  };

  /// (K - w^2 M) phi = 0,  phi^T M phi = 1.
  struct Modes
  {
    /// leading modes that are rigid motions, w = 0 exactly
    unsigned int n_rigid_modes = 0;
    /// angular frequencies, ascending [rad/s]
    std::vector<double> omega;
    /// mass-normalised shapes [1/sqrt(kg)]
    std::vector<dealii::PETScWrappers::MPI::Vector> shapes;
    /// largest |phi_i^T M phi_j - delta_ij| [-]
    double orthonormality_error = 0;
    /// largest |K phi - w^2 M phi| / |w^2 M phi| over the elastic modes [-]
    double residual = 0;
    /// solves with the factorised stiffness [-]
    unsigned int n_solves = 0;
    /// wall time of the count of modes below the limit [s]
    double seconds_count = 0;
  };

  /// Lowest modes from the flexibility: G M phi = phi / w^2, G by the factorisation that the static problem
  /// needs anyway (shift 0). A free body's G has the rigid modes in its kernel: they are put in front exactly
  /// and never disturb the others.
  ///
  /// - Completeness: one more factorisation, of K - s M without keeping factors, counts the modes below s
  ///   (Sylvester's law of inertia): before the solution at the frequency limit, which also tells how many
  ///   modes to ask for, or after it in the gap behind the last mode kept.
  /// - A frequency that is exactly double shows once in a single Krylov sequence: what the count misses is
  ///   sought again, deflating the modes found.
  /// - A pair (frequencies within 1e-3) is never split: the partner of the last mode is kept too.
  /// - Pairs within 1e-6 are turned until one mode is symmetric and the other antisymmetric to the plane
  ///   x = 0.
  /// - Signs: the projection of the shape on a fixed field of no symmetry is positive; they do not depend on
  ///   ranks.
  /// @throws ConvergenceError with numbers if modes miss, are not orthonormal or leave a residual
  Modes compute_modes(const SecondOrderSystem &system, Flexibility &flexibility,
                      const ModeParameters &parameters);

  /// Modal damping ratios from the hysteretic loss: zeta = phi^T K'' phi / (2 w^2); 0 for rigid modes and
  /// lossless bodies.
  std::vector<double> strain_energy_damping(const SecondOrderSystem &system, const Modes &modes);

  /// Turns nearly equal pairs and fixes signs, in place; see compute_modes().
  void orient_modes(const SecondOrderSystem &system, Modes &modes);
} // namespace vibrocontact

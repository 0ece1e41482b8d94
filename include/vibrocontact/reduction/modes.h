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
    /// wall time of the count of modes below the limit, or of the second search that stands for it [s]
    double seconds_count = 0;
  };

  /// By ascending frequency; equal ones stay in their order.
  void sort(Modes &modes);

  /// The frequencies of the shapes from number `first` on by Rayleigh's quotient, w^2 = phi^T K phi / phi^T M phi; then all
  /// sorted. Collective.
  /// @throws ConvergenceError where a shape's is not positive
  void take_frequencies_of_shapes(const SecondOrderSystem &system, unsigned int first, Modes &modes);
} // namespace vibrocontact

#pragma once

#include <vibrocontact/analyses/frequency_response/wheel_attachments.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Frequency response of a body of revolution: the sum over n <= N of what the section answers in n waves
  /// (fe/revolved_section.h), one small problem each, shared out over the ranks. Nothing couples different n, so that each has
  /// its own modes, Ritz vectors and loss (see ResponseReduction).
  ///
  /// Points have axial, radial and circumferential amplitudes a_e of the family even and a_o of odd (RevolvedPoint::weights).
  /// The section answers by Y to the wave q_e + i q_o, which runs towards growing theta, and by Y' to q_e - i q_o:
  ///
  ///   H = sum over n of 1/2 (a_e - i a_o) Y (a_e + i a_o)^T + 1/2 (a_e + i a_o) Y' (a_e - i a_o)^T
  ///
  /// At rest Y = Y' and the families stand alone. A body that turns past its points has Coriolis and centripetal forces,
  /// geometric stiffness and a loss that knows what its material sees (wave_response()); n = 0 obeys the same, V being
  /// turned by i. It is not reciprocal: H_ij(Omega) = H_ji(-Omega).
  ///
  /// Damping given by the number of nodal diameters (Eq. 23) is a loss factor 2 zeta_n of the stiffness of n waves, beside
  /// what the materials lose: modes and direct solutions have the same.
  ///
  /// Dampers: layers are a loss of elements, rings answer with each wave, absorbers couple waves and act on the sum, as forces
  /// on further points (wheel_attachments.h). The damping of a run in time has them on its modes instead, as that run does
  /// (reduction/damped_wheel.h).
  class RevolvedResponse
  {
  public:
    /// @param n_waves N @param parameters of the modes, for modal()
    /// @param rotation Omega towards growing theta, 0: at rest [rad/s] @param dampers without masses if it turns
    RevolvedResponse(const RevolvedSection &section, const std::vector<RevolvedPoint> &points,
                     const ModeParameters &parameters, unsigned int n_waves, MPI_Comm communicator,
                     double rotation = 0, const WheelAttachments &dampers = {});

    /// By modes and Ritz vectors as hysteretic_response(), or as time_domain_response(). Collective.
    /// @param highest frequency of modes that are kept [Hz]; 0: all
    /// @throws InputError if the body turns faster than one of its waves runs around it
    std::vector<Receptance> modal(bool hysteretic, double highest, const std::vector<double> &frequency);
    /// Of both families, counted twice, with the frequencies of modal(); collective.
    unsigned int n_modes(double highest);
    /// (K + i K'' - w^2 M) u = f for each n and frequency. Collective. @throws InputError as modal()
    std::vector<Receptance> direct(const std::vector<double> &frequency);

    bool turns() const { return rotation != 0; }

  private:
    using Vector = dealii::PETScWrappers::MPI::Vector;
    /// of one n, at rest, and what rotation does to it
    struct Wave
    {
      ResponseReduction vectors;
      WaveRotation rotation;
    };
    std::unique_ptr<SecondOrderSystem> damped_system(unsigned int n) const;
    void add_rotation(const RevolvedRotation &rotation, SecondOrderSystem &system) const;
    /// null at rest
    std::unique_ptr<RevolvedRotation> rotation_of(unsigned int n) const;
    /// Calls f(n, system) for the n of this rank. Collective.
    void for_each_wave(const std::string &progress_text,
                       const std::function<void(unsigned int, SecondOrderSystem &)> &f) const;
    /// of the n of this rank
    const std::vector<Wave> &waves();
    /// Adds 1/2 of what n waves of one sense answer, [row * n_rows + row] of the section's rows.
    void add_wave(unsigned int n, int sense, const Receptance &answer, Receptance &sum) const;
    /// Sums over all waves: add(frequencies, receptances of all points) adds those of this rank. Then come the absorbers; few
    /// enough frequencies at a time for the memory. Collective.
    std::vector<Receptance>
    summed(const std::vector<double> &frequency,
           const std::function<void(const std::vector<double> &, std::vector<Receptance> &)> &add) const;
    /// modal(), time domain, with masses
    std::vector<Receptance> damped_in_time(double highest, const std::vector<double> &frequency);

    const RevolvedSection &section;
    const WheelAttachments dampers;
    /// those asked for, then places of absorbers
    const unsigned int n_asked;
    std::vector<RevolvedPoint> points;
    const ModeParameters parameters;
    const unsigned int n_waves;
    const MPI_Comm communicator;
    const double rotation;
    /// the section's rows: of rings, then those that the points have, and which these are, by axial, radial and
    /// circumferential amplitude
    std::vector<TraceRow> rows;
    std::vector<std::array<unsigned int, 3>> row_of;
    /// centrifugal_displacement() of a body that turns
    std::optional<Vector> stretched;
    std::vector<Wave> reduced;
    bool is_reduced = false;
  };
} // namespace vibrocontact

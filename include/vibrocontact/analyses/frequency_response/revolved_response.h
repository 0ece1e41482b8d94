#pragma once

#include <vibrocontact/analyses/frequency_response/frequency_response.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/revolved_point.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Frequency response of a body of revolution: the sum over n <= N and both families of what the section answers in n waves
  /// (fe/revolved_section.h), one small problem each, shared out over the ranks. Nothing couples different n or the families,
  /// so that each has its own modes, Ritz vectors and loss (see ResponseReduction). The body is at rest.
  ///
  /// Damping given by the number of nodal diameters (Eq. 23) is a loss factor 2 zeta_n of the stiffness of n waves, beside
  /// what the materials lose: modes and direct solutions have the same.
  class RevolvedResponse
  {
  public:
    /// @param n_waves N @param parameters of the modes, for modal()
    RevolvedResponse(const RevolvedSection &section, const std::vector<RevolvedPoint> &points,
                     const ModeParameters &parameters, unsigned int n_waves, MPI_Comm communicator);

    /// By modes and Ritz vectors as hysteretic_response(), or as time_domain_response(). Collective.
    /// @param highest frequency of modes that are kept [Hz]; 0: all
    std::vector<Receptance> modal(bool hysteretic, double highest, const std::vector<double> &frequency);
    /// Of both families, counted twice, with the frequencies of modal(); collective.
    unsigned int n_modes(double highest);
    /// (K + i K'' - w^2 M) u = f for each n and frequency. Collective.
    std::vector<Receptance> direct(const std::vector<double> &frequency);

  private:
    std::unique_ptr<SecondOrderSystem> damped_system(unsigned int n) const;
    std::vector<TraceRow> rows(unsigned int n, bool odd) const;
    /// Calls f(n, system) for the n of this rank. Collective.
    void for_each_wave(const std::string &progress_text,
                       const std::function<void(unsigned int, const SecondOrderSystem &)> &f) const;
    /// of the n of this rank
    const std::vector<ResponseReduction> &reductions();
    std::vector<Receptance> summed(std::vector<Receptance> own) const;

    const RevolvedSection &section;
    const std::vector<RevolvedPoint> points;
    const ModeParameters parameters;
    const unsigned int n_waves;
    const MPI_Comm communicator;
    std::vector<ResponseReduction> reduced;
    bool is_reduced = false;
  };
} // namespace vibrocontact

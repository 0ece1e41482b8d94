#pragma once

#include <vibrocontact/base/log.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/fe/contact_trace.h>
#include <vibrocontact/fe/revolved_section.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A mode of n waves on the section, mass-normalised over the whole body; replicated.
  struct WaveMode
  {
    unsigned int n = 0;
    /// angular frequency [rad/s]; errors of the eigenproblem of its n [-]
    double omega = 0, orthonormality_error = 0, residual = 0;
    /// see WheelLabel
    std::string family;
    unsigned int nodal_circles = 0;
    /// at the rows of the contact and at the section's boundary [1/sqrt(kg)]
    std::vector<double> tread, boundary;
    /// phi^T F and phi^T M e of unit translations along x, y, z and rotations about them of the family even, of odd
    std::vector<double> load = {0, 0}, even = std::vector<double>(6, 0.), odd = std::vector<double>(6, 0.);
    /// its number among all modes of n; products with these of 2 Omega's matrix, even with odd (of n = 0 with both), and of
    /// that of Omega^2; none without rotation
    unsigned int number = 0;
    std::vector<double> coriolis, of_square;
    /// strain energy of each part of the section with each mode of n, [part * modes of n + number], see RevolvedSection
    std::vector<double> energies;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &n &omega &orthonormality_error &residual &family &nodal_circles &tread &boundary &load &even
          &odd &number &coriolis &of_square &energies;
    }
  };

  /// While it lives this rank reduces one n by itself, and silently.
  struct LoneWave
  {
    SingleRank rank;
    Log::Aside silence{"", false};
  };

  /// Displacements of the section under centrifugal forces per Omega^2 [m s^2], found by this rank alone.
  dealii::PETScWrappers::MPI::Vector centrifugal_displacement(const RevolvedSection &section);

  inline std::vector<double> values_of(const std::vector<TraceRow> &rows,
                                       const dealii::PETScWrappers::MPI::Vector &shape)
  {
    ContactTrace trace;
    trace.rows = rows;
    return contact_trace(trace, shape);
  }
} // namespace vibrocontact

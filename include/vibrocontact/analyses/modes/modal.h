#pragma once

#include <vibrocontact/run/meshed_body.h>

#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// Outcome of the analysis `modes` for one body, as in results.json (analyses.modes.<body>).
  struct ModalResult
  {
    std::string body;
    /// ascending, rigid modes first as 0; with Coriolis forces |lambda| / (2 pi) of the complex modes [Hz]
    std::vector<double> frequencies_Hz;
    /// with Coriolis forces those of the real modes without them [Hz]
    std::vector<double> without_coriolis_Hz;
    /// with Coriolis forces amplitudes of the real modes in each; n_modes x n_poles, of which a mode damped beyond critical has two
    ComplexMatrix amplitudes = ComplexMatrix();
    /// of a body that turns [rad/s]
    double speed = 0;
    std::vector<std::string> labels;
    /// [-]
    std::vector<double> damping_ratio;
    unsigned int n_dofs = 0, n_rigid_modes = 0;
    /// wall time of the computation, also when it was found in the cache [s]
    double seconds = 0;
    double orthonormality_error = 0, residual = 0;
    /// what the ratios leave out of a viscous damping matrix, see ModalDamping::coupling [-]
    double damping_coupling = 0;
    /// wall times of what this run did [s]; empty if all was found
    std::vector<std::pair<std::string, double>> stages;
  };

  /// Modes of one body, printed to the log as well.
  ModalResult modal_analysis(MeshedBody &body);
} // namespace vibrocontact

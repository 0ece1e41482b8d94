#include <vibrocontact/analyses/modes/modal.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <complex>
#include <cstdio>

namespace vibrocontact
{
  namespace
  {
    /// of a damping ratio that is zero
    constexpr double rounding = 1e-12;

    /// @param by_poles the body with its Coriolis forces
    void take_complex_modes(MeshedBody &meshed, const ReducedBody &by_poles, ModalResult &result)
    {
      const ModalReduction &modal = meshed.reduction.modal();
      BodyInContact at_rest;
      at_rest.omega = modal.omega;
      at_rest.damping_ratio = meshed.reduction.request().modes.scaled(modal.damping_ratio, modal.omega);
      result.amplitudes =
          complex_modes(at_rest, *meshed.reduction.flow(), meshed.parameters.rotation.speed).amplitudes;
      for (const double omega : modal.omega)
        result.without_coriolis_Hz.push_back(omega / (2 * dealii::numbers::PI));
      result.damping_ratio.clear();
      for (const std::complex<double> &pole : by_poles.poles)
      {
        result.frequencies_Hz.push_back(std::abs(pole) / (2 * dealii::numbers::PI));
        const double ratio = -pole.real() / std::abs(pole);
        result.damping_ratio.push_back(std::abs(ratio) < rounding ? 0. : ratio);
      }
    }
  } // namespace

  ModalResult modal_analysis(MeshedBody &meshed)
  {
    BodyReduction &body = meshed.reduction;
    Assert(body.request().modes.any(), dealii::ExcInternalError());
    const ModalReduction &modal = body.modal();
    const ReducedBody modes = free_modes(meshed, meshed.parameters);
    ModalResult result;
    result.body = body.request().body;
    result.labels = modes.labels;
    result.damping_ratio = modes.damping_ratio;
    result.n_dofs = modal.n_dofs;
    result.n_rigid_modes = modal.n_rigid_modes;
    result.seconds = modal.seconds;
    result.orthonormality_error = modal.orthonormality_error;
    result.residual = modal.residual;
    result.damping_coupling = modal.damping_coupling;
    result.stages = body.stages();
    result.speed = meshed.parameters.rotation.speed;
    for (const double omega : modes.omega)
      result.frequencies_Hz.push_back(omega / (2 * dealii::numbers::PI));
    if (meshed.parameters.rotation.has_coriolis())
      take_complex_modes(meshed, modes, result);

    Log &log = run_log();
    log.value("dofs", result.n_dofs);
    log.value("modes", static_cast<unsigned int>(result.frequencies_Hz.size()));
    log.value("of them rigid", result.n_rigid_modes);
    if (result.speed != 0)
      log.value("the body turns at", result.speed, "rad/s");
    // all of them are in the table
    constexpr unsigned int most_said = 10;
    if (result.damping_coupling > 0)
      log.line("The damping matrix couples modes by up to " + percent_text(result.damping_coupling) +
               " of what it does to either; the ratios leave that out.");
    const unsigned int n = result.frequencies_Hz.size(), said = n > 2 * most_said ? most_said : n;
    for (unsigned int i = 0; i < said; ++i)
    {
      char line[200];
      std::snprintf(line, sizeof(line), "%4u %12.4f Hz  damping %8.2e  %s", i + 1, result.frequencies_Hz[i],
                    result.damping_ratio[i], result.labels[i].c_str());
      log.line(line);
    }
    if (said < n)
      log.line("... and " + std::to_string(n - said) + " more, to " +
               number_text(result.frequencies_Hz.back()) + " Hz: modes_" + result.body + ".csv");
    for (const auto &[stage, seconds] : result.stages)
      log.value(stage, seconds, "s");
    return result;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/transient/transient.h>

#include <cmath>
#include <complex>

namespace vibrocontact
{
  namespace
  {
    void exchange_complex(CheckpointFile &file, std::vector<std::complex<double>> &values,
                          const std::string &name)
    {
      std::vector<double> parts[2];
      for (const std::complex<double> &value : values)
      {
        parts[0].push_back(value.real());
        parts[1].push_back(value.imag());
      }
      file(name + "/real", parts[0]);
      file(name + "/imaginary", parts[1]);
      values.resize(parts[0].size());
      for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = {parts[0][k], parts[1].at(k)};
    }

    void exchange_state(CheckpointFile &file, DynamicState &state, const std::string &run = "")
    {
      file(run + "state/time", state.time);
      file(run + "state/q", state.q);
      file(run + "state/v", state.v);
      file(run + "state/R", state.R);
      file(run + "state/residual_displacement", state.residual_displacement);
      file(run + "state/force_change", state.force_change);
      file(run + "state/residual_change", state.residual_change);
      file(run + "state/modal_force", state.modal_force);
      exchange_complex(file, state.z, run + "state/poles");
      exchange_complex(file, state.pole_force, run + "state/pole_force");
      file(run + "state/hub_acceleration", state.hub_acceleration);
      file(run + "state/force", state.force);
      file(run + "state/friction_power", state.friction_power);
      file(run + "state/creepage_power", state.creepage_power);
      file(run + "state/transport_power", state.transport_power);
      file(run + "state/roughness", state.roughness);
      file(run + "state/watched", state.nearby);
      file(run + "state/travel", state.moved_since_search);
      file(run + "state/steps_since_look", state.steps_since_search);
      ContactSolution &contact = state.contact;
      file(run + "contact/R", contact.R);
      file(run + "contact/y", contact.y);
      file(run + "contact/status", contact.status);
      file(run + "contact/approach", contact.approach);
      file(run + "contact/converged", contact.converged);
      file(run + "contact/residual", contact.residual);
    }

    void exchange_sums(CheckpointFile &file, TransientResult &result, const std::string &run = "")
    {
      file(run + "result/steps", result.steps);
      file(run + "result/iterations", result.iterations);
      file(run + "result/factorisations", result.factorisations);
      file(run + "result/fallbacks", result.fallbacks);
      file(run + "result/rejected", result.rejected);
      file(run + "result/above_tolerance", result.above_tolerance);
      file(run + "result/rung", result.level);
      file(run + "result/time", result.time);
      file(run + "result/seconds", result.seconds);
      file(run + "result/impulse", result.impulse);
      file(run + "result/force_square", result.force_square);
      file(run + "result/tangential_square", result.tangential_square);
      file(run + "result/smallest_gap", result.smallest_gap);
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
      {
        const std::string contact = run + "result/contact_" + std::to_string(k) + "/";
        ForceSums &sums = result.contacts[k];
        file(contact + "impulse", sums.impulse);
        file(contact + "force_square", sums.force_square);
        file(contact + "tangential_square", sums.tangential_square);
        file(contact + "smallest_gap", sums.smallest_gap);
      }
      EnergyAccount &energy = result.energy;
      file(run + "energy/initial", energy.initial);
      file(run + "energy/stored", energy.stored);
      file(run + "energy/available", energy.available);
      file(run + "energy/creepage", energy.creepage);
      file(run + "energy/transport", energy.transport);
      file(run + "energy/hub", energy.hub);
      file(run + "energy/loads", energy.loads);
      file(run + "energy/friction", energy.friction);
      file(run + "energy/damping", energy.damping);
      file(run + "energy/numerical_modes", energy.numerical_modes);
      file(run + "energy/numerical_upwind", energy.numerical_upwind);
      file(run + "energy/numerical_rate", energy.numerical_rate);
    }

    void exchange_coarse(CheckpointFile &file, CoarseRun &coarse)
    {
      exchange_state(file, coarse.state, "coarse/");
      exchange_sums(file, coarse.sums, "coarse/");
      file("coarse/result/converged", coarse.sums.converged);
      file("coarse/result/message", coarse.sums.message);
      file("coarse/errors/time", coarse.errors.time);
      file("coarse/errors/impulse", coarse.errors.impulse);
      file("coarse/errors/rms_force", coarse.errors.rms_force);
      file("coarse/errors/rms_tangential", coarse.errors.rms_tangential);
      file("coarse/errors/averaged_time", coarse.errors.averaged_time);
      file("coarse/errors/impulse_square", coarse.errors.impulse_square);
      file("coarse/errors/rms_square", coarse.errors.rms_square);
    }

    double weight(const unsigned int row)
    {
      return std::cos(1. + row);
    }

    /// Column by column, or row by row of a symmetric matrix.
    std::vector<double> weighted_sums(const DenseMatrix &matrix)
    {
      std::vector<double> sums(matrix.n());
      for (unsigned int j = 0; j < matrix.n(); ++j)
        for (unsigned int i = 0; i < matrix.m(); ++i)
          sums[j] += weight(i) * matrix(i, j);
      return sums;
    }

    std::vector<double> pole_parts(const BodyInContact &body)
    {
      std::vector<double> parts;
      for (const std::complex<double> &pole : body.poles)
        parts.insert(parts.end(), {pole.real(), pole.imag()});
      return parts;
    }
  } // namespace

  MarchCheckpoint transient_checkpoint(const std::string &folder)
  {
    return {folder + "/checkpoint.h5", "Transient", 11};
  }

  Marks TransientMarch::marks() const
  {
    return {{"frequencies", pair.omega},       {"damping ratios", pair.damping_ratio},
            {"loads", pair.modal_load},        {"mode shapes", weighted_sums(pair.modal_trace)},
            {"poles", pole_parts(pair.poles)}, {"flexibility", weighted_sums(pair.residual_flexibility)},
            {"gap", pair.interface.gap}};
  }

  void TransientMarch::exchange(CheckpointFile &file)
  {
    CoarseRun *const coarse = companion ? &companion->run : nullptr;
    // what is written and what is read hold the sums of every contact
    const std::size_t n_contacts = pair.interface.contacts.all.size();
    sums.contacts.resize(n_contacts);
    if (coarse)
      coarse->sums.contacts.resize(n_contacts);
    exchange_state(file, state);
    exchange_sums(file, sums);
    if (coarse)
      exchange_coarse(file, *coarse);
  }
} // namespace vibrocontact

#include <vibrocontact/marching/transient_checkpoint.h>
#include <vibrocontact/marching/transient_march.h>

#include <cmath>
#include <complex>
#include <filesystem>

namespace vibrocontact
{
  namespace
  {
    void exchange_state(CheckpointFile &file, DynamicState &state)
    {
      file("state/time", state.time);
      file("state/last_step", state.last_step);
      file("state/q", state.q);
      file("state/v", state.v);
      file("state/R", state.R);
      file("state/residual_displacement", state.residual_displacement);
      file("state/residual_rate", state.residual_rate);
      for (std::size_t k = 0; k < state.relaxed.size(); ++k)
        file("state/relaxed_" + std::to_string(k), state.relaxed[k]);
      file("state/force_change", state.force_change);
      file("state/residual_change", state.residual_change);
      file("state/force_change_before", state.force_change_before);
      file("state/residual_change_before", state.residual_change_before);
      file("state/extrapolates_change", state.extrapolates_change);
      file("state/modal_force", state.modal_force);
      file("state/poles", state.z);
      file("state/pole_force", state.pole_force);
      file("state/pole_reaction", state.pole_reaction);
      file("state/hub_acceleration", state.hub_acceleration);
      file("state/force", state.force);
      file("state/friction_power", state.friction_power);
      file("state/creepage_power", state.creepage_power);
      file("state/transport_power", state.transport_power);
      file("state/roughness", state.roughness);
      file("state/nearby", state.nearby);
      file("state/moved_since_look", state.moved_since_look);
      file("state/steps_since_search", state.steps_since_search);
      ContactSolution &contact = state.contact;
      file("contact/R", contact.R);
      file("contact/y", contact.y);
      file("contact/status", contact.status);
      file("contact/approach", contact.approach);
      file("contact/converged", contact.converged);
      file("contact/residual", contact.residual);
    }

    void exchange_forces(CheckpointFile file, ForceSums &sums)
    {
      file("impulse", sums.impulse);
      file("force_square", sums.force_square);
      file("tangential_square", sums.tangential_square);
      file("smallest_gap", sums.smallest_gap);
    }

    void exchange_sums(CheckpointFile &file, TransientResult &result)
    {
      file("result/steps", result.steps);
      file("result/iterations", result.iterations);
      file("result/factorisations", result.factorisations);
      file("result/fallbacks", result.fallbacks);
      file("result/rejected", result.rejected);
      file("result/above_tolerance", result.above_tolerance);
      file("result/level", result.level);
      file("result/time", result.time);
      file("result/seconds", result.seconds);
      std::vector<double> motions;
      for (const TransientResult::ModalMotion &one : result.modal_motions)
        motions.insert(motions.end(), {one.time, one.q, one.q_square, one.v_square});
      file("result/modal_motions", motions);
      file("result/middle", result.middle);
      result.modal_motions.resize(motions.size() / 4);
      for (std::size_t k = 0; k < result.modal_motions.size(); ++k)
        result.modal_motions[k] = {motions[4 * k], motions[4 * k + 1], motions[4 * k + 2],
                                   motions[4 * k + 3]};
      exchange_forces(file.group("result"), result);
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
        exchange_forces(file.group("result/contact_" + std::to_string(k)), result.contacts[k]);
      EnergyAccount &energy = result.energy;
      file("energy/initial", energy.initial);
      file("energy/stored", energy.stored);
      file("energy/available", energy.available);
      file("energy/creepage", energy.creepage);
      file("energy/transport", energy.transport);
      file("energy/hub", energy.hub);
      file("energy/loads", energy.loads);
      file("energy/friction", energy.friction);
      file("energy/damping", energy.damping);
      file("energy/numerical_modes", energy.numerical_modes);
      file("energy/numerical_upwind", energy.numerical_upwind);
      file("energy/numerical_rate", energy.numerical_rate);
    }

    void exchange_companion(CheckpointFile file, Companion &coarse)
    {
      exchange_state(file, coarse.state);
      exchange_sums(file, coarse.sums);
      StepErrors &errors = coarse.errors;
      errors.exchange(file);
      file("errors/rms_variation", errors.rms_variation);
      file("errors/rms_tangential", errors.rms_tangential);
      file("errors/averaged_time", errors.averaged_time);
      file("errors/impulse_square", errors.impulse_square);
      file("errors/rms_square", errors.rms_square);
      file("errors/last_quarter", errors.last_quarter);
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

    std::vector<double> flexibility_marks(const ContactPair &pair)
    {
      if (!pair.half_spaces)
        return weighted_sums(pair.residual);
      DenseVector weights(3 * pair.n_points()), sums(weights.size());
      for (unsigned int i = 0; i < weights.size(); ++i)
        weights[i] = weight(i);
      add_residual_displacement(pair.residual, pair.half_spaces.get(), weights, sums);
      return {sums.begin(), sums.end()};
    }

    /// of what is exchanged
    constexpr int format = 20;

    std::string file_of(const std::string &folder)
    {
      return folder + "/checkpoint.h5";
    }

    Marks marks_of(const ContactPair &pair)
    {
      std::vector<double> relaxations;
      for (const RelaxingRest &rest : pair.relaxing)
        relaxations.push_back(rest.relaxation);
      return {{"frequencies", pair.omega},  {"damping ratios", pair.damping_ratio},
              {"loads", pair.modal_load},   {"mode shapes", weighted_sums(pair.trace)},
              {"poles", pole_marks(pair)},  {"flexibility", flexibility_marks(pair)},
              {"relaxations", relaxations}, {"gap", pair.interface.gap}};
    }
  } // namespace

  MarchCheckpoint transient_checkpoint(const std::string &folder)
  {
    return {file_of(folder), "Transient", format};
  }

  void check_end_of_transient(const std::string &folder, const std::string &entry)
  {
    if (!std::filesystem::exists(file_of(folder)))
      throw InputError("There is no transient in the folder \"" + folder +
                       "\", it has no checkpoint.h5: give " + entry + " that of the results of one.");
  }

  DynamicState end_of_transient(const std::string &folder, const ContactPair &pair, const std::string &entry)
  {
    DynamicState state;
    state.relaxed.resize(pair.relaxing.size());
    const MarchCheckpoint checkpoint(file_of(folder), "Transient", format,
                                     "run the transient of this scene again, or give another " + entry);
    check_end_of_transient(folder, entry);
    checkpoint.read_part(marks_of(pair),
                         [&](CheckpointFile &file, const double) { exchange_state(file, state); });
    return state;
  }

  Marks TransientMarch::marks() const
  {
    return marks_of(pair);
  }

  void TransientMarch::exchange(CheckpointFile &file)
  {
    // what is written and what is read hold the sums of every contact
    sums.contacts.resize(pair.interface.contacts.all.size());
    state.relaxed.resize(pair.relaxing.size());
    exchange_state(file, state);
    exchange_sums(file, sums);
    if (!companion)
      return;
    companion->sums.contacts.resize(sums.contacts.size());
    companion->state.relaxed.resize(pair.relaxing.size());
    exchange_companion(file.group("coarse"), *companion);
  }
} // namespace vibrocontact

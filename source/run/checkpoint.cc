#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/run/checkpoint.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// changes whenever what is exchanged or what it means does
    constexpr int format = 1;

    std::string checkpoint_name(const std::string &folder)
    {
      return folder + "/checkpoint.h5";
    }

    void exchange(CheckpointFile &file, DynamicState &state)
    {
      file("state/time", state.time);
      file("state/q", state.q);
      file("state/v", state.v);
      file("state/R", state.R);
      file("state/residual_displacement", state.residual_displacement);
      file("state/force_change", state.force_change);
      file("state/residual_change", state.residual_change);
      file("state/modal_force", state.modal_force);
      file("state/hub_acceleration", state.hub_acceleration);
      file("state/friction_power", state.friction_power);
      file("state/creepage_power", state.creepage_power);
      file("state/transport_power", state.transport_power);
      file("state/roughness", state.roughness);
      file("state/watched", state.watched);
      file("state/travel", state.travel);
      file("state/steps_since_look", state.steps_since_look);
      ContactSolution &contact = state.contact;
      file("contact/R", contact.R);
      file("contact/y", contact.y);
      file("contact/status", contact.status);
      file("contact/approach", contact.approach);
      file("contact/converged", contact.converged);
      file("contact/residual", contact.residual);
    }

    void exchange(CheckpointFile &file, TransientResult &result)
    {
      file("result/steps", result.steps);
      file("result/iterations", result.iterations);
      file("result/factorisations", result.factorisations);
      file("result/fallbacks", result.fallbacks);
      file("result/rejected", result.rejected);
      file("result/rung", result.rung);
      file("result/time", result.time);
      file("result/seconds", result.seconds);
      file("result/impulse", result.impulse);
      file("result/smallest_gap", result.smallest_gap);
      EnergyAccount &energy = result.energy;
      file("energy/initial", energy.initial);
      file("energy/stored", energy.stored);
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

    /// Frequencies and weighted sums of the traces, which tell bodies, their modes and the grid apart.
    std::vector<double> marks(const ContactPair &pair)
    {
      std::vector<double> result(pair.omega);
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
      {
        double sum = 0;
        for (unsigned int i = 0; i < pair.modal_trace.m(); ++i)
          sum += std::cos(1. + i) * pair.modal_trace(i, k);
        result.push_back(sum);
      }
      double sum = 0;
      for (unsigned int i = 0; i < pair.residual_flexibility.m(); ++i)
        sum += std::cos(1. + i) * pair.residual_flexibility(i, i);
      result.push_back(sum);
      return result;
    }

    bool differ(const std::vector<double> &a, const std::vector<double> &b)
    {
      if (a.size() != b.size())
        return true;
      for (std::size_t i = 0; i < a.size(); ++i)
        if (std::abs(a[i] - b[i]) > 1e-5 * std::max(std::abs(a[i]), std::abs(b[i])) + 1e-8)
          return true;
      return false;
    }
  } // namespace

  void write_checkpoint(const std::string &folder, const ContactPair &pair, DynamicState &state,
                        TransientResult &result, const Recorders &recorders)
  {
    Hdf5Writer writer(checkpoint_name(folder));
    writer.write("format", format);
    writer.write("program", version());
    writer.write("marks", marks(pair));
    CheckpointFile file(writer);
    exchange(file, state);
    exchange(file, result);
    for (const auto &recorder : recorders)
      recorder->exchange(file);
    writer.finish();
  }

  void check_end_time(const std::string &folder, const double end_time)
  {
    if (!std::filesystem::exists(checkpoint_name(folder)))
      return;
    Hdf5Reader reader(checkpoint_name(folder));
    const double reached = reader.has("result/time") ? reader.number("result/time") : 0;
    if (reached > end_time * (1 + 1e-12))
    {
      std::ostringstream text;
      text << "Transient/End time is " << end_time << " s, but the run to be resumed has reached " << reached
           << " s: give a later one.";
      throw InputError(text.str());
    }
  }

  bool read_checkpoint(const std::string &folder, const ContactPair &pair, DynamicState &state,
                       TransientResult &result, const Recorders &recorders)
  {
    const std::string name = checkpoint_name(folder);
    if (!std::filesystem::exists(name))
      return false;
    const std::string advice = ": run the file without --resume.";
    Hdf5Reader reader(name);
    const int written_format = reader.integer("format");
    const std::string written_version = reader.text("program");
    if (written_format != format)
      throw InputError("The checkpoint \"" + name + "\" was written by version " + written_version +
                       " in another format than that of " + version() + advice);
    if (differ(reader.numbers("marks"), marks(pair)))
      throw InputError("The checkpoint \"" + name +
                       "\" belongs to other bodies or modes, though the parameters are the same; a mesh or "
                       "a program has changed" +
                       advice);
    CheckpointFile file(reader);
    exchange(file, state);
    exchange(file, result);
    for (const auto &recorder : recorders)
      recorder->exchange(file);
    return true;
  }
} // namespace vibrocontact

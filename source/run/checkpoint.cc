#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/run/checkpoint.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    /// changes whenever what is exchanged or what it means does
    constexpr int format = 4;

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
      file("state/force", state.force);
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
      file("result/above_tolerance", result.above_tolerance);
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

    using Marks = std::vector<std::pair<std::string, std::vector<double>>>;

    /// What tells bodies, their modes and the grid apart, by name; sums stand for matrices.
    Marks marks(const ContactPair &pair)
    {
      return {{"frequencies", pair.omega},
              {"damping ratios", pair.damping_ratio},
              {"loads", pair.modal_load},
              {"mode shapes", weighted_sums(pair.modal_trace)},
              {"flexibility", weighted_sums(pair.residual_flexibility)},
              {"gap", pair.interface.gap}};
    }

    /// Relative to the number itself, or to the largest of its kind where it is a small one: modes that were
    /// computed again, on another number of ranks, are the same but for round-off.
    bool differ(const std::vector<double> &a, const std::vector<double> &b)
    {
      if (a.size() != b.size())
        return true;
      double largest = 0;
      for (const double value : a)
        largest = std::max(largest, std::abs(value));
      for (std::size_t i = 0; i < a.size(); ++i)
        if (!(std::abs(a[i] - b[i]) <= 1e-5 * std::abs(a[i]) + 1e-7 * largest))
          return true;
      return false;
    }

    const std::string advice = ": run the file without --resume.";

    /// Whatever HDF5 stumbles over in a damaged file is one sentence.
    void whole(const std::string &folder, const std::function<void()> &read)
    {
      try
      {
        read();
      }
      catch (const std::exception &)
      {
        throw InputError("The checkpoint \"" + checkpoint_name(folder) + "\" is damaged or incomplete" +
                         advice);
      }
    }
  } // namespace

  void write_checkpoint(const std::string &folder, const ContactPair &pair, DynamicState &state,
                        TransientResult &result, const Recorders &recorders)
  {
    Hdf5Writer writer(checkpoint_name(folder));
    writer.write("format", format);
    writer.write("program", version());
    for (const auto &[mark, values] : marks(pair))
      writer.write("marks/" + mark, values);
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
    double reached = 0;
    whole(folder, [&] { reached = Hdf5Reader(checkpoint_name(folder)).number("result/time"); });
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
    std::unique_ptr<Hdf5Reader> reader;
    int written_format = 0;
    std::string written_version;
    whole(folder,
          [&]
          {
            reader = std::make_unique<Hdf5Reader>(name);
            written_format = reader->integer("format");
            written_version = reader->text("program");
          });
    if (written_format != format)
      throw InputError("The checkpoint \"" + name + "\" was written by version " + written_version +
                       " in another format than that of " + version() + advice);
    for (const auto &[mark, values] : marks(pair))
    {
      std::vector<double> written;
      whole(folder, [&, &mark = mark] { written = reader->numbers("marks/" + mark); });
      if (differ(written, values))
        throw InputError("The checkpoint \"" + name + "\" belongs to other bodies, their " + mark +
                         " differ though the parameters are the same; a mesh, a section or the program has "
                         "changed" +
                         advice);
    }
    CheckpointFile file(*reader);
    whole(folder,
          [&]
          {
            exchange(file, state);
            exchange(file, result);
          });
    for (const auto &recorder : recorders)
      recorder->exchange(file);
    // the sum is over all that was written, which rank 0 alone has read
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      whole(folder, [&] { reader->verify(); });
    return true;
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/transient/checkpoint.h>
#include <vibrocontact/base/checkpoint_schedule.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/row_file.h>
#include <vibrocontact/base/version.h>

#include <algorithm>
#include <cmath>
#include <complex>
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
    constexpr int format = 10;

    std::string checkpoint_name(const std::string &folder)
    {
      return folder + "/checkpoint.h5";
    }

    void exchange(CheckpointFile &file, std::vector<std::complex<double>> &values, const std::string &name)
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

    void exchange(CheckpointFile &file, DynamicState &state, const std::string &run = "")
    {
      file(run + "state/time", state.time);
      file(run + "state/q", state.q);
      file(run + "state/v", state.v);
      file(run + "state/R", state.R);
      file(run + "state/residual_displacement", state.residual_displacement);
      file(run + "state/force_change", state.force_change);
      file(run + "state/residual_change", state.residual_change);
      file(run + "state/modal_force", state.modal_force);
      exchange(file, state.z, run + "state/poles");
      exchange(file, state.pole_force, run + "state/pole_force");
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

    void exchange(CheckpointFile &file, TransientResult &result, const std::string &run = "")
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

    void exchange(CheckpointFile &file, CoarseRun &coarse)
    {
      exchange(file, coarse.state, "coarse/");
      exchange(file, coarse.sums, "coarse/");
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

    using Marks = std::vector<std::pair<std::string, std::vector<double>>>;

    /// What tells bodies, their modes and the grid apart, by name; sums stand for matrices.
    Marks marks(const ContactPair &pair)
    {
      return {{"frequencies", pair.omega},       {"damping ratios", pair.damping_ratio},
              {"loads", pair.modal_load},        {"mode shapes", weighted_sums(pair.modal_trace)},
              {"poles", pole_parts(pair.poles)}, {"flexibility", weighted_sums(pair.residual_flexibility)},
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

    /// What is written and what is read hold the sums of every contact of the bodies.
    void hold_every_contact(const ContactPair &pair, TransientResult &result, CoarseRun *const coarse)
    {
      const std::size_t n_contacts = pair.interface.contacts.all.size();
      result.contacts.resize(n_contacts);
      if (coarse)
        coarse->sums.contacts.resize(n_contacts);
    }
  } // namespace

  void write_checkpoint(const std::string &folder, const ContactPair &pair, DynamicState &state,
                        TransientResult &result, const Recorders &recorders, CoarseRun *const coarse)
  {
    Hdf5Writer writer(checkpoint_name(folder));
    writer.write("format", format);
    writer.write("program", version());
    for (const auto &[mark, values] : marks(pair))
      writer.write("marks/" + mark, values);
    hold_every_contact(pair, result, coarse);
    CheckpointFile file(writer);
    exchange(file, state);
    exchange(file, result);
    if (coarse)
      exchange(file, *coarse);
    for (const auto &recorder : recorders)
      recorder->exchange(file);
    writer.finish(true);
  }

  void check_end_time(const std::string &folder, const double end_time)
  {
    if (!std::filesystem::exists(checkpoint_name(folder)))
      return;
    double reached = 0;
    read_whole(checkpoint_name(folder),
               [&]
               {
                 Hdf5Reader::check_seal(checkpoint_name(folder));
                 reached = Hdf5Reader(checkpoint_name(folder)).number("result/time");
               });
    if (reached > end_time * (1 + 1e-12))
    {
      std::ostringstream text;
      text << "Transient/End time is " << end_time << " s, but the run to be resumed has reached " << reached
           << " s: give a later one.";
      throw InputError(text.str());
    }
  }

  bool read_checkpoint(const std::string &folder, const ContactPair &pair, DynamicState &state,
                       TransientResult &result, const Recorders &recorders, CoarseRun *const coarse)
  {
    const std::string name = checkpoint_name(folder);
    if (!std::filesystem::exists(name))
      return false;
    std::unique_ptr<Hdf5Reader> reader;
    int written_format = 0;
    std::string written_version;
    read_whole(name,
               [&]
               {
                 // sizes and places are used as they are read
                 Hdf5Reader::check_seal(name);
                 reader = std::make_unique<Hdf5Reader>(name);
                 written_format = reader->integer("format");
                 written_version = reader->text("program");
               });
    if (written_format != format)
      throw InputError("The checkpoint \"" + name + "\" was written by version " + written_version +
                       " in another format than that of " + version() + run_without_resume);
    for (const auto &[mark, values] : marks(pair))
    {
      std::vector<double> written;
      read_whole(name, [&, &mark = mark] { written = reader->numbers("marks/" + mark); });
      if (differ(written, values))
        throw InputError("The checkpoint \"" + name + "\" belongs to other bodies, their " + mark +
                         " differ though the parameters are the same; a mesh, a section or the program has "
                         "changed" +
                         run_without_resume);
    }
    hold_every_contact(pair, result, coarse);
    CheckpointFile file(*reader);
    read_whole(name,
               [&]
               {
                 exchange(file, state);
                 exchange(file, result);
                 if (coarse)
                   exchange(file, *coarse);
                 for (const auto &recorder : recorders)
                   recorder->exchange(file);
               });
    return true;
  }
} // namespace vibrocontact

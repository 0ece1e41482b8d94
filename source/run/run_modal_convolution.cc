#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/output/modal_convolution_output.h>
#include <vibrocontact/run/checkpoint.h>
#include <vibrocontact/run/checkpoint_schedule.h>
#include <vibrocontact/run/judge_road_march.h>
#include <vibrocontact/run/pole_body.h>
#include <vibrocontact/run/run_method_comparison.h>
#include <vibrocontact/run/run_modal_convolution.h>
#include <vibrocontact/run/say_residual_damping.h>
#include <vibrocontact/run/verdict.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int most_point_tables = 10;
    constexpr unsigned long most_table_lines = 1000000, most_spectrum_lines = 20000000;
    constexpr int checkpoint_format = 3;

    std::string checkpoint_name(const std::string &folder)
    {
      return folder + "/modal_convolution.h5";
    }

    /// What tells bodies apart: the rows and the poles.
    std::vector<double> marks(const PoleModel &model)
    {
      std::vector<double> result = {double(model.n_rows())};
      for (const auto &pole : model.poles)
        result.insert(result.end(), {pole.real(), pole.imag()});
      return result;
    }

    class Checkpoints
    {
    public:
      Checkpoints(const std::string &folder, const PoleModel &model, ModalConvolution &motion,
                  std::optional<ModalConvolutionHistory> &history)
          : folder(folder), model(model), motion(motion), history(history)
      {
      }

      /// On rank 0; the others keep nothing.
      void write()
      {
        Hdf5Writer writer(checkpoint_name(folder));
        writer.write("format", checkpoint_format);
        writer.write("marks", marks(model));
        CheckpointFile file(writer);
        motion.exchange(file);
        if (history)
          history->exchange(file);
        writer.finish(true);
      }

      /// On every rank.
      bool read()
      {
        if (!std::filesystem::exists(checkpoint_name(folder)))
          return false;
        std::unique_ptr<Hdf5Reader> reader;
        bool same = false;
        read_whole(checkpoint_name(folder),
                   [&]
                   {
                     // sizes and places are used as they are read
                     Hdf5Reader::check_seal(checkpoint_name(folder));
                     reader = std::make_unique<Hdf5Reader>(checkpoint_name(folder));
                     same = reader->integer("format") == checkpoint_format &&
                            reader->numbers("marks") == marks(model);
                   });
        if (!same)
          throw InputError("The checkpoint \"" + checkpoint_name(folder) +
                           "\" belongs to another body or program: run the file without --resume.");
        read_whole(checkpoint_name(folder),
                   [&]
                   {
                     CheckpointFile file(*reader);
                     motion.exchange(file);
                     if (history)
                       history->exchange(file);
                   });
        if (motion.result().steps > motion.n_steps())
          throw InputError("Modal convolution/End time is before what the run to be resumed has reached, " +
                           std::to_string(motion.result().time) + " s: give a later one.");
        return true;
      }

    private:
      const std::string folder;
      const PoleModel &model;
      ModalConvolution &motion;
      std::optional<ModalConvolutionHistory> &history;
    };

    void print(const ModalConvolutionParameters &parameters, const ModalConvolutionResult &result)
    {
      Log &log = run_log();
      const double steps = std::max(1ul, result.steps);
      log.value("steps", static_cast<unsigned long long>(result.steps));
      log.value("time", result.time, "s");
      log.value("per step", result.seconds / steps * 1e9, "ns");
      log.value("road, per step", result.road_seconds / steps * 1e9, "ns");
      log.value("computing per simulated second", (result.seconds + result.road_seconds) / result.time * 1e3,
                "ms");
      log.value("closed points on average", result.closed_points / steps);
      log.value("impacts", static_cast<unsigned long long>(result.impacts.size()));
      log.value("releases", static_cast<unsigned long long>(result.releases.size()));
      for (unsigned int i = 0; i < std::min<std::size_t>(result.impulse.size(), 3); ++i)
        log.value("impulse of point " + std::to_string(i), result.impulse[i], "N s");
      if (is_contact_iterated(parameters, result.impulse.size()))
        log.value("contact residual", result.residual);
      if (parameters.friction)
      {
        log.value("sticking points on average", result.sticking_points / steps);
        log.value("friction", result.dissipation, "J");
      }
    }
  } // namespace

  void run_modal_convolution(const Parameters &parameters, const MeshedBodies &bodies,
                             const std::optional<MeasuredData> &measured, const std::string &folder,
                             const bool resume, Results &results)
  {
    const PoleBody body = pole_body(parameters, bodies, measured, 0, parameters.road);
    const ModalConvolutionParameters &own = parameters.modal_convolution;
    run_log().block("Modal convolution");
    run_log().value("poles", body.poles.n_poles());
    const unsigned int n_points = body.places.size();
    run_log().value("contact points", n_points);
    run_log().value("method", own.method);
    const RoadParameters road_parameters = road_of(parameters, body);
    const bool by_force = !parameters.rolling.normal_force.empty();
    if (by_force)
    {
      run_log().value("load on a flat road", parameters.rolling.normal_force.front(), "N");
      run_log().value("indentation for it", road_parameters.indentation * 1e3, "mm");
    }
    const Road road(road_parameters, body.places, body.shapes, own.end_time);
    ModalConvolution motion(own, parameters.contact_solver, body.poles, road, parameters.contact.friction);

    const bool first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    std::optional<ModalConvolutionHistory> history;
    if (first)
      history.emplace(own, n_points, folder);
    Checkpoints checkpoints(folder, body.poles, motion, history);
    bool found = false;
    if (resume)
      on_all_ranks([&] { found = checkpoints.read(); });
    if (found)
      run_log().value("resumed at", motion.result().time, "s");

    CheckpointSchedule schedule(own.checkpoint_interval);
    Progress progress("modal convolution", motion.n_steps() - motion.result().steps);
    std::exception_ptr failure;
    const auto observe = [&](const ModalConvolutionLines &lines)
    {
      if (!history || failure)
        return;
      try
      {
        history->add(lines);
      }
      catch (...)
      {
        failure = std::current_exception();
      }
    };
    std::string message;
    bool more = motion.n_steps() > motion.result().steps;
    while (more)
    {
      const unsigned long before = motion.result().steps;
      try
      {
        more = motion.advance(motion.steps_of_a_block(), observe);
      }
      catch (const ConvergenceError &error)
      {
        // the same on every rank
        message = error.what();
        break;
      }
      on_first_rank(
          [&]
          {
            if (failure)
              std::rethrow_exception(failure);
          });
      progress.advance(motion.result().steps - before);
      const bool due = schedule.is_due();
      if (due || !more)
        on_first_rank([&] { checkpoints.write(); });
      if (schedule.stopped_by() != 0 && more)
      {
        results.stopped_by = schedule.stopped_by();
        break;
      }
    }
    const ModalConvolutionResult &result = motion.result();
    nlohmann::ordered_json &json = results.analyses["modal_convolution"];
    json = modal_convolution_json(own, result);
    if (bodies[0] && parameters.scene.bodies[0].is_meshed())
    {
      ReducedBody reduced = bodies[0]->reduction.reduced(true);
      scale_damping(reduced, parameters.modes.at(parameters.scene.bodies[0].name));
      say_residual_damping(parameters, {&reduced}, 0., {}, "modal_convolution", results);
    }
    json["indentation_m"] = road_parameters.indentation;
    if (by_force)
      json["static_normal_force_N"] = parameters.rolling.normal_force.front();
    on_first_rank(
        [&]
        {
          history->finish(message.empty() && results.stopped_by == 0);
          const double lines = result.time / std::max(own.time_step, own.history_interval);
          if (n_points <= most_point_tables && lines <= most_table_lines)
            write_point_tables(folder, n_points, own.friction);
          write_impacts(result, folder);
          if (lines <= most_spectrum_lines)
          {
            write_third_octaves(own, result, folder);
            json["third_octaves"] = "third_octaves.csv";
          }
        });
    print(own, result);
    judge_road_march(own, motion, body.is_passive, message.empty() && results.stopped_by == 0, json, results);
    if (!message.empty())
    {
      std::ostringstream text;
      text << "The modal convolution ended at " << result.time << " s: " << message;
      refuse("modal convolution", text.str(), results);
    }
    if (results.stopped_by != 0)
      run_log().warning("Interrupted; a checkpoint is written, --resume continues.");
    else if (parameters.comparison.any() && message.empty())
      json["method_comparison"] = run_method_comparison(parameters, bodies, measured, folder);
  }
} // namespace vibrocontact

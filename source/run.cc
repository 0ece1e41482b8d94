#include <vibrocontact/analyses/modal.h>
#include <vibrocontact/analyses/quasi_static_rolling.h>
#include <vibrocontact/analyses/rolling_scene.h>
#include <vibrocontact/base/blas.h>
#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/contact/problem_file.h>
#include <vibrocontact/fe/trace_assembly.h>
#include <vibrocontact/meshed_body.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/output/figures.h>
#include <vibrocontact/output/modal_output.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/output/rolling_output.h>
#include <vibrocontact/output/run_record.h>
#include <vibrocontact/output/scene_summary.h>
#include <vibrocontact/parameters.h>
#include <vibrocontact/run.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// contacts of fewer points than this are reported as coarse
    constexpr unsigned int coarse_below = 12;

    bool is_first_rank()
    {
      return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    void banner(const CommandLine &command_line, const Scene &scene)
    {
      Log &log = run_log();
      log.block("Vibrocontact " + version() + " (" + commit() + "), deal.II " + dealii_version());
      log.value("parameter file", command_line.file);
      if (!scene.title.empty())
        log.value("title", scene.title);
      log.value("ranks", dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
      const Blas blas = measure_blas();
      log.value("BLAS", blas.library);
      log.value("BLAS speed per rank", blas.gflops, "Gflop/s");
      if (blas.is_slow())
        log.warning(
            "this BLAS is slow, large factorisations take up to 8 times longer than with OpenBLAS: install "
            "libopenblas0-pthread");
    }

    /// Modes of a body: results, table and, if this run has computed them, the shapes on its surface.
    void run_modes(MeshedBody &body, const bool fields, const std::string &folder, Results &results)
    {
      const std::string &name = body.parameters.name;
      run_log().block("Modes of " + name);
      const ModalResult modes = modal_analysis(body.reduction);
      results.analyses["modes"][name] = modal_json(modes);
      if (is_first_rank())
        modal_table(modes).write(folder + "/modes_" + name + ".csv");
      if (!fields)
        return;
      if (!body.reduction.has_shapes())
      {
        run_log().line(
            "The shapes are not kept in the cache: a run with another Output/Cache directory writes them.");
        return;
      }
      std::vector<FieldState> states;
      for (unsigned int k = 0; k < modes.frequencies_Hz.size(); ++k)
        states.push_back({&body.reduction.shapes().shapes[k], modes.frequencies_Hz[k]});
      write_surface_fields(body.elastic_body(), states, folder, "mode_" + name);
    }

    /// Quasi-static rolling of body 1 on body 2; every rank solves, the first writes. Returns the last case.
    RollingResult run_rolling(const Parameters &parameters,
                              const std::vector<std::unique_ptr<MeshedBody>> &bodies,
                              const std::string &folder, Results &results)
    {
      std::vector<ReducedBody> reduced(2);
      std::vector<ContactBody> pair;
      for (unsigned int k = 0; k < 2; ++k)
      {
        if (bodies[k])
          reduced[k] = bodies[k]->reduction.reduced(false);
        pair.push_back({&parameters.scene.bodies[k], bodies[k] ? &reduced[k] : nullptr});
      }
      Log &log = run_log();
      log.block("Quasi-static rolling");
      const RollingScene scene = rolling_scene(pair[0], pair[1], parameters.contact);
      const ContactInterface &interface = scene.interface;
      log.value("contact points", interface.grid.n_points());
      const unsigned int n_cases = rolling_cases(parameters.rolling, parameters.contact).size();
      Progress progress("rolling cases", n_cases);
      nlohmann::ordered_json cases = nlohmann::ordered_json::array();
      std::vector<std::pair<double, std::string>> patches;
      const auto finished = [&](const RollingResult &result, const ContactProblem &problem)
      {
        const std::string k = std::to_string(cases.size());
        if (is_first_rank())
          contact_patch_table(result, interface).write(folder + "/contact_patch_" + k + ".csv");
        if (is_first_rank() && parameters.output.fields)
        {
          patches.emplace_back(cases.size(), "fields/contact_patch_" + k + ".vtu");
          write_contact_patch_vtu(result, interface, folder + "/" + patches.back().second);
        }
        if (is_first_rank() && parameters.output.contact_problems)
        {
          std::filesystem::create_directories(folder + "/contact_problems");
          write_contact_problem(folder + "/contact_problems/case_" + k + ".h5", problem, result.solution);
        }
        cases.push_back(rolling_case_json(result));
        if (result.solution.converged && result.contact_points < coarse_below)
        {
          std::ostringstream text;
          text << "Case " << k << ": only " << result.contact_points
               << " points touch, too few for the numbers to mean much; refine Contact/Grid spacing or raise "
                  "the load.";
          cases.back()["warning"] = text.str();
          log.warning(text.str());
        }
        if (!result.solution.converged)
        {
          results.converged = false;
          std::ostringstream text;
          text << "Case " << k << " of quasi-static rolling did not converge: residual "
               << result.solution.residual << " after " << result.solution.iterations << " iterations.";
          results.messages.push_back(text.str());
          log.warning(results.messages.back());
        }
        progress.advance();
      };
      const std::vector<RollingResult> all =
          quasi_static_rolling(parameters.rolling, parameters.contact, parameters.contact_solver, interface,
                               scene.operator_at, finished);
      if (is_first_rank())
        rolling_table(all).write(folder + "/rolling.csv");
      if (is_first_rank() && parameters.output.fields)
        write_pvd(patches, folder + "/contact_patch.pvd");
      const RollingResult &last = all.back();
      log.value("cases", n_cases);
      log.value("normal force", last.normal_force, "N");
      log.value("tangential force x", last.tangential_force[0], "N");
      log.value("tangential force y", last.tangential_force[1], "N");
      log.value("utilisation", last.utilisation);
      log.value("largest pressure", last.max_pressure * 1e-6, "MPa");
      log.value("approach", last.approach * 1e3, "mm");
      log.value("points in contact", last.contact_points);
      log.value("of these sticking", last.stick_points);
      results.analyses["quasi_static_rolling"]["cases"] = cases;
      return last;
    }

    /// Deformation and stress of the meshed bodies under the contact forces of a case.
    void write_deformation(const RollingResult &result,
                           const std::vector<std::unique_ptr<MeshedBody>> &bodies, const bool always,
                           const std::string &folder)
    {
      for (unsigned int k = 0; k < bodies.size(); ++k)
        if (bodies[k])
        {
          const std::string &name = bodies[k]->parameters.name;
          run_log().block("Deformation of " + name);
          if (!always && !bodies[k]->reduction.was_factorised())
          {
            run_log().line("The reduction came from the cache, so nothing is factorised; set "
                           "Output/Deformation = always "
                           "to have the deformation all the same.");
            continue;
          }
          DenseVector force = result.solution.R;
          if (k == 1)
            force *= -1;
          dealii::PETScWrappers::MPI::Vector displacement;
          bodies[k]->reduction.flexibility().static_displacement(displacement, force);
          const bool follows_hub = k == 0 && bodies[k]->reduction.system().follows_hub;
          write_fields(bodies[k]->elastic_body(),
                       {{&displacement, 0., follows_hub ? -result.solution.approach : 0.}}, folder,
                       "deformation_" + name);
        }
    }

    /// The meshed bodies of a scene in its order, null for the others; nothing is made yet.
    std::vector<std::unique_ptr<MeshedBody>>
    meshed_bodies(Parameters &parameters, const DeclaredParameters &declared, const ContactGrid &grid)
    {
      const ContactGrid *const contact_grid = parameters.has_contact() ? &grid : nullptr;
      const double lateral_position = parameters.contact.lateral_position;
      std::vector<std::unique_ptr<MeshedBody>> bodies;
      for (const BodyParameters &body : parameters.scene.bodies)
        bodies.push_back(body.is_meshed()
                             ? std::make_unique<MeshedBody>(
                                   body, parameters.modes[body.name], lateral_position, contact_grid,
                                   body_key(declared, body.name, lateral_position, contact_grid),
                                   parameters.output.cache_directory, MPI_COMM_WORLD)
                             : nullptr);
      return bodies;
    }

    /// Makes the meshes and lays the contact grid on them, so that what is wrong there is said before the
    /// expensive steps. Bodies whose reduction is in the cache have passed already.
    void check_meshes(const Parameters &parameters, const std::vector<std::unique_ptr<MeshedBody>> &bodies,
                      const ContactGrid &grid, const bool all)
    {
      for (const auto &body : bodies)
        if (body)
        {
          const bool with_modes = parameters.scene.runs("modes") && body->reduction.request().modes.any();
          if (!all && body->reduction.is_cached(parameters.has_contact(), with_modes))
            continue;
          const ElasticBody<3> &elastic_body = body->elastic_body();
          if (parameters.has_contact())
            make_contact_trace(elastic_body, grid);
        }
    }

    /// What --check shows.
    void print_scene(const Parameters &parameters, const std::vector<std::unique_ptr<MeshedBody>> &bodies,
                     const ContactGrid &grid)
    {
      const ContactGrid *const contact_grid = parameters.has_contact() ? &grid : nullptr;
      for (unsigned int k = 0; k < bodies.size(); ++k)
        print_body(parameters.scene.bodies[k], bodies[k] ? &bodies[k]->elastic_body() : nullptr,
                   contact_grid);
      if (contact_grid)
        print_contact_grid(grid);
      run_log().end_block();
      run_log().line("");
      run_log().line("The file is valid; nothing was run.");
    }
  } // namespace

  int run(const CommandLine &command_line)
  {
    const auto begin = std::chrono::steady_clock::now();
    run_log().set_screen(!command_line.quiet);
    if (command_line.help || command_line.version || command_line.parameters)
    {
      const std::string text = command_line.help      ? command_line_help()
                               : command_line.version ? "vibrocontact " + version() + " (" + commit() + ")\n"
                                                      : all_parameters();
      if (is_first_rank())
        std::cout << text;
      return 0;
    }

    ParameterFile file(command_line.file, read_file_on_all_ranks(command_line.file), command_line.overrides);
    Parameters parameters;
    dealii::ParameterHandler prm;
    read_parameters(file, prm, parameters);
    banner(command_line, parameters.scene);

    const ContactGrid grid = parameters.contact.grid();
    std::vector<std::unique_ptr<MeshedBody>> bodies;
    try
    {
      bodies = meshed_bodies(parameters, declared_parameters(prm), grid);
      check_meshes(parameters, bodies, grid, command_line.check);
      if (command_line.check)
      {
        print_scene(parameters, bodies, grid);
        return 0;
      }
    }
    catch (const InputError &error)
    {
      throw InputError(file.located(error.what()));
    }

    const RunRecord record(parameters.output.folder(command_line.output, command_line.file), file, prm);
    Results results;
    const auto seconds = [&]
    { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
    try
    {
      if (parameters.scene.runs("modes"))
        for (const auto &body : bodies)
          if (body && parameters.modes[body->parameters.name].any())
            run_modes(*body, parameters.output.fields, record.folder, results);
      if (parameters.has_contact())
      {
        const RollingResult last = run_rolling(parameters, bodies, record.folder, results);
        if (parameters.output.fields && parameters.output.deformation != "never")
          write_deformation(last, bodies, parameters.output.deformation == "always", record.folder);
      }
    }
    catch (const InputError &error)
    {
      record.discard();
      throw InputError(file.located(error.what()));
    }
    catch (const ConvergenceError &error)
    {
      results.converged = false;
      results.messages.push_back(error.what());
      run_log().warning(error.what());
    }
    write_results(results, seconds(), record.folder);
    if (parameters.output.figures)
      draw_figures(record.folder);

    run_log().block("Results");
    run_log().value("folder", record.folder);
    run_log().value("status", results.converged ? "converged" : "not converged");
    run_log().value("wall time", time_text(seconds()));
    record.finish();
    return results.converged ? 0 : 2;
  }
} // namespace vibrocontact

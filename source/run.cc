#include <vibrocontact/analyses/modal.h>
#include <vibrocontact/analyses/quasi_static_rolling.h>
#include <vibrocontact/analyses/rolling_scene.h>
#include <vibrocontact/base/blas.h>
#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/output/output_parameters.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/output/rolling_output.h>
#include <vibrocontact/output/run_record.h>
#include <vibrocontact/reduction/meshed_body.h>
#include <vibrocontact/run.h>
#include <vibrocontact/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>

namespace vibrocontact
{
  namespace
  {
    /// Everything that a parameter file sets.
    struct Parameters
    {
      Scene scene;
      OutputParameters output;
      ContactParameters contact;
      ContactSolverParameters contact_solver;
      RollingParameters rolling;
      /// of the meshed bodies, by name
      std::map<std::string, ModeParameters> modes;

      void declare(dealii::ParameterHandler &prm)
      {
        scene.declare_parameters(prm);
        const auto declare = [&](const std::string &section, auto &group)
        {
          prm.enter_subsection(section);
          group.declare_parameters(prm);
          prm.leave_subsection();
        };
        if (scene.runs("modes"))
          for (const BodyParameters &body : scene.bodies)
            if (body.is_meshed())
            {
              prm.enter_subsection(body.name);
              declare("Modes", modes[body.name]);
              prm.leave_subsection();
            }
        declare("Output", output);
        prm.enter_subsection("Contact");
        contact.declare_parameters(prm);
        declare("Solver", contact_solver);
        prm.leave_subsection();
        if (scene.runs("quasi-static rolling"))
          declare("Rolling", rolling);
      }

      void check() const
      {
        scene.check();
        for (const auto &[name, mode] : modes)
          mode.check(name + "/Modes");
        if (scene.runs("quasi-static rolling"))
          rolling.check();
      }
    };

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

    /// Natural frequencies, labels and damping of a meshed body.
    void run_modes(MeshedBody &body, const std::string &folder, Results &results)
    {
      run_log().block("Modes of " + body.parameters.name);
      const ModalResult modes = modal_analysis(body.reduction);
      Table table({"frequency_Hz", "damping_ratio", "label"},
                  {"Natural frequencies of " + modes.body + "; rigid modes have frequency 0"});
      for (unsigned int k = 0; k < modes.frequencies_Hz.size(); ++k)
        table.add_row({modes.frequencies_Hz[k], modes.damping_ratio[k], modes.labels[k]});
      if (is_first_rank())
        table.write(folder + "/modes_" + modes.body + ".csv");
      nlohmann::ordered_json stages;
      for (const auto &[stage, seconds] : modes.stages)
        stages[stage] = seconds;
      results.analyses["modes"][modes.body] = {{"frequencies_Hz", modes.frequencies_Hz},
                                               {"labels", modes.labels},
                                               {"damping_ratio", modes.damping_ratio},
                                               {"n_rigid_modes", modes.n_rigid_modes},
                                               {"n_dofs", modes.n_dofs},
                                               {"orthonormality_error", modes.orthonormality_error},
                                               {"residual", modes.residual},
                                               {"stages_s", stages},
                                               {"seconds", modes.seconds}};
    }

    /// Quasi-static rolling of body 1 on body 2; rank 0 solves and writes. Returns the last case.
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
      const auto finished = [&](const RollingResult &result)
      {
        const std::string k = std::to_string(cases.size());
        if (is_first_rank())
          contact_patch_table(result, interface).write(folder + "/contact_patch_" + k + ".csv");
        if (is_first_rank() && parameters.output.fields)
          write_contact_patch_vtu(result, interface, folder + "/fields/contact_patch_" + k + ".vtu");
        cases.push_back(rolling_case_json(result));
        if (!result.solution.converged)
        {
          results.converged = false;
          results.messages.push_back("Case " + k + " of quasi-static rolling did not converge: residual " +
                                     std::to_string(result.solution.residual) + " after " +
                                     std::to_string(result.solution.iterations) + " iterations.");
          log.warning(results.messages.back());
        }
        progress.advance();
      };
      const std::vector<RollingResult> all =
          quasi_static_rolling(parameters.rolling, parameters.contact, parameters.contact_solver, interface,
                               scene.operator_at, finished);
      if (is_first_rank())
        rolling_table(all).write(folder + "/rolling.csv");
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

    /// All parameters of a scene with one body of each type that needs no file, as a valid file.
    std::string all_parameters()
    {
      std::string lists = "set Analyses = quasi-static rolling\nset Bodies = upper, lower\n";
      ParameterFile file("", lists + "subsection upper\nset Type = half-space\nend\n"
                                     "subsection lower\nset Type = block\nend\n");
      Parameters parameters;
      parameters.scene = read_scene_lists(file);
      dealii::ParameterHandler prm;
      parameters.declare(prm);
      file.parse(prm);
      return "# Every parameter of vibrocontact " + version() +
             "; see README.md for files to start from.\n\n" +
             print_parameters(declared_parameters(prm), ParameterStyle::documented);
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
    try
    {
      parameters.scene = read_scene_lists(file);
      parameters.declare(prm);
      const std::string dropped = file.prefer_option("Rolling", "Normal force", "Hub displacement");
      if (!dropped.empty())
        run_log().line("Rolling/" + dropped + " of the file is left out: an option gives its alternative.");
      file.parse(prm);
      parameters.check();
    }
    catch (const InputError &error)
    {
      throw InputError(file.located(error.what()));
    }
    banner(command_line, parameters.scene);
    if (command_line.check)
      return 0;

    const bool with_contact = parameters.scene.runs("quasi-static rolling");
    const ContactGrid grid = parameters.contact.grid();
    const DeclaredParameters declared = declared_parameters(prm);
    const std::string folder =
        begin_run_record(parameters.output.folder(command_line.output, command_line.file), file, prm);
    Results results;
    std::vector<std::unique_ptr<MeshedBody>> bodies;
    for (const BodyParameters &body : parameters.scene.bodies)
      bodies.push_back(body.is_meshed()
                           ? std::make_unique<MeshedBody>(
                                 body, parameters.modes[body.name], parameters.contact.lateral_position,
                                 with_contact ? &grid : nullptr,
                                 body_key(declared, body.name, parameters.contact.lateral_position,
                                          with_contact ? &grid : nullptr),
                                 parameters.output.cache_directory, MPI_COMM_WORLD)
                           : nullptr);
    if (parameters.scene.runs("modes"))
      for (const auto &body : bodies)
        if (body && parameters.modes[body->parameters.name].any())
          run_modes(*body, folder, results);
    if (with_contact)
      run_rolling(parameters, bodies, folder, results);
    const auto seconds = [&]
    { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
    write_results(results, seconds(), folder);

    run_log().block("Results");
    run_log().value("folder", folder);
    run_log().value("status", results.converged ? "converged" : "not converged");
    run_log().value("wall time", time_text(seconds()));
    end_run_record(folder);
    return results.converged ? 0 : 2;
  }
} // namespace vibrocontact

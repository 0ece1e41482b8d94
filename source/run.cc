#include <vibrocontact/base/blas.h>
#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/output/output_parameters.h>
#include <vibrocontact/output/results.h>
#include <vibrocontact/output/run_record.h>
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

      void declare(dealii::ParameterHandler &prm)
      {
        scene.declare_parameters(prm);
        const auto declare = [&](const std::string &section, auto &group)
        {
          prm.enter_subsection(section);
          group.declare_parameters(prm);
          prm.leave_subsection();
        };
        declare("Output", output);
      }

      void check() const { scene.check(); }
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

    const std::string folder =
        begin_run_record(parameters.output.folder(command_line.output, command_line.file), file, prm);
    Results results;
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

#include <vibrocontact/base/blas.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/folder_lock.h>
#include <vibrocontact/base/input_files.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/output/answer_parts.h>
#include <vibrocontact/output/answers.h>
#include <vibrocontact/output/figures.h>
#include <vibrocontact/output/run_record.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/check_before_run.h>
#include <vibrocontact/run/check_entries.h>
#include <vibrocontact/run/earlier_run.h>
#include <vibrocontact/run/prepare_bodies.h>
#include <vibrocontact/run/run.h>
#include <vibrocontact/run/run_sweep.h>
#include <vibrocontact/run/swept_runs.h>
#include <vibrocontact/run/unreduced_pair.h>
#include <vibrocontact/run/varied_cases.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iostream>
#include <set>

namespace vibrocontact
{
  namespace
  {
    std::string blas_with_kernels()
    {
      const std::string kernels = blas_kernels();
      return loaded_blas() + (kernels.empty() ? "" : ", kernels " + kernels);
    }

    void print_text(const Tables &tables, const CommandLine &command_line)
    {
      const std::string text =
          command_line.help ? command_line_help()
          : command_line.version
              ? "vibrocontact " + version() + " (" + commit() + ")\ndeal.II " + dealii_version() + "; BLAS " +
                    blas_with_kernels() + "\n"
              : all_parameters(tables.analysis_types(), std::make_shared<const EntryTables>(tables));
      on_first_rank([&] { std::cout << text; });
    }

    void banner(const CommandLine &command_line, const Scene &scene)
    {
      Log &log = run_log();
      log.block("Vibrocontact " + version() + " (" + commit() + "), deal.II " + dealii_version());
      log.value("parameter file", command_line.file);
      if (!scene.title.empty())
        log.value("title", scene.title);
      log.value("ranks", dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
      log.value("BLAS", blas_with_kernels());
      const std::string blas = loaded_blas();
      if (is_reference_blas(blas))
        log.line("This is the reference BLAS, large factorisations take up to 8 times longer than with "
                 "OpenBLAS: " +
                 faster_blas_advice(blas));
    }

    /// No file has such numbers. @return whether there were any. Collective.
    bool take_out_what_is_not_finite(Results &results)
    {
      // what ranks hold may differ in the last digit
      std::vector<std::pair<std::string, std::string>> found;
      for (const auto &[key, object] : results.analyses.items())
        try
        {
          check_finite(object, "analyses/" + key);
        }
        catch (const ConvergenceError &error)
        {
          found.emplace_back(key, error.what());
        }
      found = dealii::Utilities::MPI::broadcast(run_communicator(), found, 0);
      for (const auto &[key, reason] : found)
      {
        results.analyses.erase(key);
        // a result that was saved on the way has said so
        if (results.failures.empty() || results.failures.back().message != reason)
          refuse(reason, results);
      }
      return !found.empty();
    }

    /// @param resume whether an earlier run in the folder is continued
    void run_analyses(const Tables &tables, const Parameters &parameters, const MeshedBodies &bodies,
                      const std::optional<MeasuredData> &measured, const std::vector<SweepCases> &sweeps,
                      RunRecord &record, Results &results, const bool resume,
                      const WallClock::time_point begin)
    {
      const auto save = [&]
      {
        results.reductions = reductions_json(bodies);
        record.save(results, seconds_since(begin));
      };
      const SweepCases nothing_swept;
      std::set<std::string> came_to_nothing;
      for (const Analysis &analysis : tables.analyses)
      {
        if (results.stopped_by != 0)
          break;
        const std::string &name = analysis.type.name;
        const std::string first = analysis.begins_after ? analysis.begins_after(parameters) : "";
        if (analysis.continues || !first.empty())
          results.forget(name);
        if (!parameters.scene.runs(name) || results.finished.count(name) > 0)
          continue;
        results.running = name;
        if (came_to_nothing.count(first) > 0)
        {
          refuse("It begins at the end of the " + first + ", which came to nothing.", results);
          results.running.clear();
          came_to_nothing.insert(name);
          continue;
        }
        const std::size_t n_failures = results.failures.size();
        const auto sweep = std::find_if(sweeps.begin(), sweeps.end(),
                                        [&](const SweepCases &one) { return one.analysis == name; });
        const bool swept = sweep != sweeps.end();
        const AnalysisRun on{parameters,
                             bodies,
                             measured,
                             swept ? *sweep : nothing_swept,
                             record.folder,
                             resume,
                             results,
                             save,
                             [&] { record.save_sometimes(results, seconds_since(begin)); },
                             tables.recorders};
        bool came_to_its_end = false;
        try
        {
          if (!swept || sweep->beside_run)
            analysis.run(on);
          if (swept && results.stopped_by == 0)
            run_sweep(analysis, on);
          came_to_its_end = results.stopped_by == 0;
        }
        // the others say what they find all the same
        catch (const ConvergenceError &error)
        {
          refuse(error.what(), results);
          came_to_nothing.insert(name);
        }
        if (take_out_what_is_not_finite(results))
        {
          came_to_its_end = false;
          came_to_nothing.insert(name);
        }
        // what was stopped, or continues and did not converge, goes on from its checkpoint
        if (came_to_its_end && (!analysis.continues || results.failures.size() == n_failures))
          results.finished.insert(name);
        // a signal stops it there
        if (results.stopped_by == 0)
          results.running.clear();
        save();
      }
    }

    std::vector<AnswerKind> kinds_of_answers(const std::vector<Analysis> &analyses)
    {
      std::vector<AnswerKind> kinds;
      for (const Analysis &analysis : analyses)
      {
        kinds.insert(kinds.end(), analysis.answers.begin(), analysis.answers.end());
        if (analysis.swept)
        {
          const std::string key = results_key(analysis.type.name) + "_sweep";
          kinds.push_back({key, analysis.type.name + " sweep", sweep_answer, {key + ".csv"}});
        }
      }
      return kinds;
    }

    /// The answers of the analysis that a signal stopped say so.
    void mark_interrupted(const std::vector<Analysis> &analyses, const std::string &stopped,
                          std::vector<Answer> &said)
    {
      std::set<std::string> own;
      for (const Analysis &analysis : analyses)
        if (analysis.type.name == stopped)
          for (const AnswerKind &kind : kinds_of_answers({analysis}))
            own.insert(kind.analysis);
      for (Answer &answer : said)
        if (own.count(answer.analysis) > 0)
          answer.lines.push_back("INTERRUPTED: this is as far as it came");
    }

    /// Analyses behind one that ended the run.
    void add_what_was_not_run(const std::vector<Analysis> &analyses, const Parameters &parameters,
                              Results &results)
    {
      bool behind = false;
      for (const Analysis &analysis : analyses)
      {
        const std::string &name = analysis.type.name;
        if (behind && parameters.scene.runs(name) && results.finished.count(name) == 0)
          results.failures.push_back({name, "The analysis " + name + " was not run."});
        behind = behind || name == results.running;
      }
    }

    /// Why the answers are not to be trusted, last of all.
    void say_failures(const Results &results)
    {
      using namespace answer_parts;
      if (results.failures.empty())
        return;
      Lines lines;
      for (std::size_t k = 0; k < std::min(most_said, results.failures.size()); ++k)
        lines.push_back((results.failures[k].analysis.empty() ? "" : results.failures[k].analysis + ": ") +
                        results.failures[k].message);
      say_more(results.failures.size(), "reasons in results.json", lines);
      run_log().block("Not converged");
      for (const std::string &line : lines)
        run_log().line(line);
    }

    /// The end of the record: final results, then the figures, which read them, then the time with these, the
    /// answers and why they are not to be trusted.
    void finish(const std::vector<Analysis> &analyses, const bool figures, RunRecord &record,
                Results &results, const WallClock::time_point begin)
    {
      results.peak_memory = peak_memory_of_ranks();
      record.save(results, seconds_since(begin));
      if (figures && results.complete)
      {
        const WallClock::time_point drawing = WallClock::now();
        draw_figures(record.folder);
        results.figures_seconds = seconds_since(drawing);
      }
      run_log().block("Results");
      run_log().value("folder", record.folder);
      run_log().value("status", results.stopped_by != 0 ? "not converged: interrupted, --resume continues"
                                : results.converged()   ? "converged"
                                                        : "not converged");
      run_log().value("wall time", time_text(seconds_since(begin)));
      std::vector<Answer> said = answers(kinds_of_answers(analyses), results.analyses, record.folder);
      if (results.stopped_by != 0)
        mark_interrupted(analyses, results.running, said);
      for (const Answer &answer : said)
      {
        run_log().block("Answer of " + answer.analysis);
        for (const std::string &line : answer.lines)
          run_log().line(line);
      }
      say_failures(results);
      results.answers = answers_json(said);
      record.save(results, seconds_since(begin));
    }
  } // namespace

  int run(const Tables &tables, const CommandLine &command_line)
  {
    const WallClock::time_point begin = WallClock::now();
    run_log().set_screen(!command_line.quiet);
    if (command_line.help || command_line.version || command_line.parameters)
    {
      print_text(tables, command_line);
      return 0;
    }

    ParameterFile file(command_line.file, read_file_on_all_ranks(command_line.file), command_line.overrides);
    Parameters parameters;
    dealii::ParameterHandler prm;
    const DeclaredParameters declared = read_parameters(file, prm, parameters, tables.analysis_types(),
                                                        std::make_shared<const EntryTables>(tables));
    const std::string folder = parameters.output.folder(command_line.output, command_line.file);
    if (command_line.resume)
      check_earlier_run(folder);
    std::vector<SweepCases> sweeps = sweep_cases(parameters, file, command_line.overrides);
    for (const Analysis &analysis : tables.analyses)
      if (analysis.variations && parameters.scene.runs(analysis.type.name))
        if (const std::optional<Variations> asked = analysis.variations(parameters))
          sweeps.push_back(varied_cases(*asked, parameters, file, command_line.overrides));
    const std::vector<std::string> out_of_use =
        entries_out_of_use(file, command_line.overrides, tables.analyses, parameters, declared, sweeps);
    banner(command_line, parameters.scene);
    if (!out_of_use.empty())
      run_log().line("Entries that options have put out of use: " + quoted_list(out_of_use, "and") + ".");
    if (command_line.check)
      for (BodyParameters &body : parameters.scene.bodies)
        body.description->write_no_mesh();

    const DeclaredParameters used = declared.without(out_of_use);
    const ContactGrid grid = parameters.contact_grid();
    MeshedBodies bodies;
    std::optional<MeasuredData> measured;
    try
    {
      check_reach_of_sweeps(tables.analyses, parameters);
      bodies = meshed_bodies(parameters, declared);
      check_transient_files(parameters, bodies);
      check_meshes(parameters, bodies, command_line.check);
      if (parameters.scene.runs("transient") && !parameters.transient.is_reduced())
        check_unreduced_size(bodies);
      measured = measured_data(parameters);
      check_before_run(parameters, bodies, measured);
      if (command_line.check)
      {
        check_places(parameters, bodies, sweeps);
        if (command_line.resume)
          earlier_results(folder, used, parameters);
      }
    }
    catch (const MachineError &)
    {
      throw;
    }
    catch (const InputError &error)
    {
      throw InputError(file.located(error.what()));
    }
    catch (const OutputError &error)
    {
      throw InputError("Write mesh: " + std::string(error.what()));
    }
    if (command_line.check)
    {
      std::optional<FolderLock> picture;
      if (!command_line.output.empty())
        picture.emplace(folder, command_line.file + ", --check", true);
      print_scene(parameters, bodies, grid, command_line.output);
      return 0;
    }

    const FolderLock lock(folder, command_line.file + (command_line.resume ? ", resumed" : ""),
                          !command_line.resume);
    Results results;
    if (command_line.resume)
      results = earlier_results(folder, used, parameters);
    results.title = parameters.scene.title;
    results.input_files = input_files(used);
    RunRecord record(folder, file, used, command_line.resume ? &results : nullptr);
    const auto keep_what_was_done = [&](const std::string &failure)
    {
      // what analyses before this one have computed stays
      const bool others_spoke =
          std::any_of(results.failures.begin(), results.failures.end(),
                      [&](const Results::Verdict &one) { return one.analysis != results.running; });
      if (results.finished.empty() && !others_spoke && results.analyses.size() < 2)
        return record.discard();
      results.failures.push_back({results.running, failure});
      add_what_was_not_run(tables.analyses, parameters, results);
      take_out_what_is_not_finite(results);
      try
      {
        finish(tables.analyses, false, record, results, begin);
      }
      catch (const OutputError &)
      {
        // what has failed first is said
      }
    };
    try
    {
      run_analyses(tables, parameters, bodies, measured, sweeps, record, results, command_line.resume, begin);
    }
    catch (const MachineError &error)
    {
      keep_what_was_done(error.what());
      throw;
    }
    catch (const InputError &error)
    {
      keep_what_was_done(error.what());
      throw InputError(file.located(error.what()));
    }
    catch (const OutputError &error)
    {
      // what was written stays, and says that it is not all
      results.failures.push_back({results.running, error.what()});
      try
      {
        record.save(results, seconds_since(begin));
      }
      catch (const OutputError &)
      {
      }
      throw;
    }
    results.reductions = reductions_json(bodies);
    write_track_fits(bodies, folder);
    results.complete = results.stopped_by == 0;
    finish(tables.analyses, parameters.output.figures, record, results, begin);
    if (results.stopped_by != 0)
      return 128 + results.stopped_by;
    return results.converged() ? 0 : 2;
  }
} // namespace vibrocontact

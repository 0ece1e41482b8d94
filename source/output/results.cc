#include <vibrocontact/base/checksum.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/output/results.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// Letters that are none, of a folder's name for instance, become the mark of an unknown one.
    std::string text_of(const nlohmann::ordered_json &node, const int indent)
    {
      return node.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    }

    /// What the object holds, however it is laid out in the file.
    std::string checksum_of(const nlohmann::ordered_json &top)
    {
      const std::string text = text_of(top, -1);
      Checksum sum;
      sum.add(text.data(), text.size());
      return hexadecimal(sum.value());
    }

    void add_verdicts(const std::vector<Results::Verdict> &verdicts, const std::string &name,
                      nlohmann::ordered_json &top)
    {
      for (const auto &[analysis, message] : verdicts)
      {
        top["messages"].push_back(message);
        top[name].push_back({{"analysis", analysis}, {"message", message}});
      }
    }

    /// About these analyses.
    std::vector<Results::Verdict> verdicts_of(const nlohmann::ordered_json &top, const std::string &name,
                                              const std::set<std::string> &analyses)
    {
      std::vector<Results::Verdict> verdicts;
      for (const auto &one : top.value(name, nlohmann::ordered_json::array()))
      {
        const auto analysis = one.at("analysis").get<std::string>();
        if (analyses.count(analysis) > 0)
          verdicts.push_back({analysis, one.at("message").get<std::string>()});
      }
      return verdicts;
    }
  } // namespace

  void Results::forget(const std::string &analysis)
  {
    finished.erase(analysis);
    for (std::vector<Verdict> *const list : {&failures, &warnings})
      list->erase(std::remove_if(list->begin(), list->end(),
                                 [&](const Verdict &one) { return one.analysis == analysis; }),
                  list->end());
  }

  void check_finite(const nlohmann::ordered_json &node, const std::string &path)
  {
    if (node.is_number_float() && !std::isfinite(node.get<double>()))
      throw ConvergenceError(
          "The result " + path +
          " is not a finite number: numbers of the input lie too far apart for double precision.");
    if (node.is_structured())
      for (const auto &[key, child] : node.items())
        check_finite(child, path + "/" + key);
  }

  void take_from_first_rank(nlohmann::ordered_json &object)
  {
    object = nlohmann::ordered_json::from_cbor(
        dealii::Utilities::MPI::broadcast(run_communicator(), nlohmann::ordered_json::to_cbor(object), 0));
  }

  std::string results_text(const Results &results, const double wall_seconds)
  {
    check_finite(results.analyses);
    nlohmann::ordered_json top;
    if (!results.title.empty())
      top["title"] = results.title;
    top["program"] = {{"name", "vibrocontact"},
                      {"version", version()},
                      {"commit", commit()},
                      {"dealii", dealii_version()},
                      {"ranks", dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)}};
    if (!results.input_files.empty())
      top["input_files"] = results.input_files;
    top["status"] = results.converged() && results.complete ? "converged" : "not converged";
    top["complete"] = results.complete;
    top["wall_s"] = wall_seconds;
    if (results.figures_seconds >= 0)
      top["figures_s"] = results.figures_seconds;
    if (!results.peak_memory.empty())
      top["peak_memory_MB"] = results.peak_memory;
    top["finished"] = results.finished;
    if (results.stopped_by != 0)
      top["interrupted"] = true;
    add_verdicts(results.failures, "not_converged", top);
    add_verdicts(results.warnings, "warnings", top);
    if (!results.answers.empty())
      top["answers"] = results.answers;
    top["analyses"] = results.analyses;
    if (!results.reductions.empty())
      top["reductions"] = results.reductions;
    top["checksum"] = checksum_of(top);
    return text_of(top, 2) + "\n";
  }

  Results results_of_text(const std::string &text)
  {
    try
    {
      auto top = nlohmann::ordered_json::parse(text);
      const std::string sum = top.at("checksum").get<std::string>();
      top.erase("checksum");
      if (sum != checksum_of(top))
        throw InputError(
            "The results.json in the output folder is damaged or was changed: run the file without "
            "--resume");
      Results results;
      results.input_files = top.value("input_files", results.input_files);
      results.finished = top.at("finished").get<std::set<std::string>>();
      results.failures = verdicts_of(top, "not_converged", results.finished);
      results.warnings = verdicts_of(top, "warnings", results.finished);
      if (!results.finished.empty())
        results.analyses = top.at("analyses");
      return results;
    }
    catch (const nlohmann::json::exception &)
    {
      throw InputError("The results.json in the output folder is not what a run of this version leaves: run "
                       "the file without --resume");
    }
  }

  std::vector<double> peak_memory_of_ranks()
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    return dealii::Utilities::MPI::all_gather(run_communicator(), memory.VmHWM * 1024e-6);
  }
} // namespace vibrocontact

#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/version.h>
#include <vibrocontact/output/results.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    void check_finite(const nlohmann::ordered_json &node, const std::string &path)
    {
      if (node.is_number_float())
        AssertThrow(std::isfinite(node.get<double>()),
                    dealii::ExcMessage("the result " + path + " is not a finite number"));
      if (node.is_structured())
        for (const auto &[key, child] : node.items())
          check_finite(child, path + "/" + key);
    }
  } // namespace

  std::string results_text(const Results &results, const double wall_seconds)
  {
    check_finite(results.analyses, "analyses");
    nlohmann::ordered_json top;
    top["program"] = {{"name", "vibrocontact"},
                      {"version", version()},
                      {"commit", commit()},
                      {"dealii", dealii_version()},
                      {"ranks", dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)}};
    top["status"] = results.converged ? "converged" : "not converged";
    top["wall_s"] = wall_seconds;
    if (!results.messages.empty())
      top["messages"] = results.messages;
    top["analyses"] = results.analyses;
    return top.dump(2) + "\n";
  }

  void write_results(const Results &results, const double wall_seconds, const std::string &folder)
  {
    const std::string text = results_text(results, wall_seconds);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      write_file(folder + "/results.json", text);
  }
} // namespace vibrocontact

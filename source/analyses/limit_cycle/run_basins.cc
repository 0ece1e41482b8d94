#include <vibrocontact/analyses/limit_cycle/basins_output.h>
#include <vibrocontact/analyses/limit_cycle/limit_cycle_output.h>
#include <vibrocontact/analyses/limit_cycle/run_basins.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/output/verdict.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace vibrocontact
{
  namespace
  {
    void print(const BasinPath &path, const std::vector<CycleOfBasin> &cycles)
    {
      run_log().line("  from " + number_text(path.share) + " of the way: " +
                     (path.winner            ? number_text(1 / cycles[*path.winner].period) + " Hz wins"
                      : path.message.empty() ? "no cycle has won"
                                             : path.message) +
                     (path.time.empty() ? "" : " after " + number_text(path.time.back()) + " s") + ", " +
                     time_text(path.seconds));
    }

    /// Why a start is undecided, for the user.
    std::string undecided_text(const BasinPath &path, const std::vector<CycleOfBasin> &cycles,
                               const BasinParameters &parameters)
    {
      return "From " + number_text(path.share) + " of the way between the cycles at " +
             number_text(1 / cycles[path.between[0]].period) + " and " +
             number_text(1 / cycles[path.between[1]].period) + " Hz " +
             (path.message.empty() ? "no cycle has won after " + number_text(parameters.longest_time) +
                                         " s (Limit cycle/Basins/Longest time)."
                                   : "the motion was not followed: " + path.message + ".");
    }

    /// Of the pairs from `begin` on one for each rank, as many as are left.
    std::vector<BasinsBetween> basins_of_ranks(BasinMarch &march,
                                               const std::vector<std::array<unsigned int, 2>> &pairs,
                                               const std::size_t begin, const BasinParameters &own)
    {
      const std::size_t mine = begin + dealii::Utilities::MPI::this_mpi_process(run_communicator());
      BasinsBetween between;
      on_all_ranks(
          [&]
          {
            if (mine < pairs.size())
              between = basins_between(march, pairs[mine], own);
          });
      std::vector<BasinsBetween> result = dealii::Utilities::MPI::all_gather(run_communicator(), between);
      result.resize(std::min(result.size(), pairs.size() - begin));
      return result;
    }
  } // namespace

  void run_basins(const CycleSearch &search, const std::vector<CycleOfBasin> &cycles)
  {
    const AnalysisRun &on = search.on;
    const CycleScene &scene = search.scene;
    const BasinParameters &own = search.own().basins;
    if (cycles.size() < 2)
      return refuse(std::string("Limit cycle/Basins/Starts asks for motions between two cycles, but ") +
                        (cycles.empty() ? "none" : "one") + " was found that converged.",
                    on.results);
    if (std::all_of(cycles.begin(), cycles.end(),
                    [](const CycleOfBasin &one) { return one.is_stable == false; }))
      return refuse(
          "Limit cycle/Basins/Starts asks which cycle wins, but small disturbances grow out of all that "
          "were found, so that none can: another motion does, which a transient shows.",
          on.results);
    const double length = window_of(cycles);
    const auto window = map_about(
        scene,
        points_around(scene.pair->interface.contacts, scene.at_rest.R, *std::rbegin(spreads_of_contact)),
        steps_of_window(length, own), on.parameters.contact_solver);
    nlohmann::ordered_json &basins = on.results.analyses["limit_cycle_basins"];
    basins = {{"window_s", length}, {"size", own.size}, {"cycles", nlohmann::ordered_json::array()}};
    std::vector<BasinPath> paths;
    try
    {
      BasinMarch march(*window, *scene.pair, scene.at_rest, cycles, own);
      for (unsigned int k = 0; k < cycles.size(); ++k)
        basins["cycles"].push_back({{"number", cycles[k].number},
                                    {"frequency_Hz", 1 / cycles[k].period},
                                    {"velocity_m_s", march.velocities[k]},
                                    {"stable", stable_json(cycles[k].is_stable)}});
      for (const char *const list : {"starts", "borders"})
        basins[list] = nlohmann::ordered_json::array();
      std::vector<std::array<unsigned int, 2>> pairs;
      for (unsigned int i = 0; i < cycles.size(); ++i)
        for (unsigned int j = i + 1; j < cycles.size(); ++j)
          pairs.push_back({{i, j}});
      Progress progress("basins of limit cycles", pairs.size());
      for (std::size_t begin = 0; begin < pairs.size();)
      {
        for (const BasinsBetween &between : basins_of_ranks(march, pairs, begin, own))
        {
          const std::array<unsigned int, 2> &two = pairs[begin++];
          run_log().line("between the cycles at " + number_text(1 / cycles[two[0]].period) + " and " +
                         number_text(1 / cycles[two[1]].period) + " Hz:");
          for (const BasinPath &path : between.paths)
          {
            print(path, cycles);
            paths.push_back(path);
            basins["starts"].push_back(path_json(path, cycles));
            if (!path.winner)
              refuse(undecided_text(path, cycles, own), on.results);
          }
          for (const BasinBorder &border : between.borders)
            basins["borders"].push_back(border_json(border, cycles));
          progress.advance();
        }
        on.save_sometimes();
      }
    }
    catch (const ConvergenceError &error)
    {
      refuse(std::string("The basins of the limit cycles were not found: ") + error.what() + ".", on.results);
    }
    on_first_rank(
        [&]
        {
          starts_table(basins).write(on.folder + "/limit_cycle_basins.csv");
          paths_table(paths, cycles).write(on.folder + "/limit_cycle_basin_paths.csv");
        });
  }
} // namespace vibrocontact

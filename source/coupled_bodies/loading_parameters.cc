#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/loading_parameters.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    const std::array<const char *, 3> force_entries = {{"Force x", "Force y", "Normal force"}},
                                      displacement_entries = {
                                          {"Displacement x", "Displacement y", "Hub displacement"}};
    const std::array<const char *, 3> force_columns = {{"force_x_N", "force_y_N", "normal_force_N"}},
                                      displacement_columns = {
                                          {"displacement_x_m", "displacement_y_m", "hub_displacement_m"}};
    constexpr unsigned int most_steps = 100000, most_parts = 1000;

    std::string path(const std::string &entry)
    {
      return "Loading/" + entry;
    }

    void check_force(const std::string &where, const double force)
    {
      if (!(force > 0))
        throw InputError(
            where + " is " + number_text(force) +
            " N: a force that presses is positive; to part the bodies give the Hub displacement.");
    }

    /// The list of a direction, its entry, and whether it holds forces.
    struct Given
    {
      const std::vector<double> *values = nullptr;
      std::string entry;
      bool is_force = false;
    };

    Given given(const LoadingParameters &loading, const unsigned int d)
    {
      if (!loading.force[d].empty())
        return {&loading.force[d], path(force_entries[d]), true};
      if (!loading.displacement[d].empty())
        return {&loading.displacement[d], path(displacement_entries[d]), false};
      return {};
    }

    unsigned int n_parts(const LoadingParameters &loading)
    {
      std::size_t n = 1;
      for (unsigned int d = 0; d < 3; ++d)
        n = std::max({n, loading.force[d].size(), loading.displacement[d].size()});
      return n;
    }

    LoadHistory history_of_lists(const LoadingParameters &loading)
    {
      LoadHistory history;
      const unsigned int n = n_parts(loading);
      std::array<double, 3> before = {{0, 0, 0}}, after = before;
      for (unsigned int part = 0; part < n; ++part)
      {
        for (unsigned int d = 0; d < 3; ++d)
          if (const Given one = given(loading, d); one.values)
          {
            history.force_given[d] = one.is_force;
            after[d] = one.values->size() == 1 ? one.values->front() : (*one.values)[part];
          }
        const unsigned int n_steps = loading.steps[loading.steps.size() == 1 ? 0 : part];
        for (unsigned int k = 1; k <= n_steps; ++k)
        {
          LoadHistory::Step step = {after, part + 1, k == n_steps};
          for (unsigned int d = 0; d < 3 && k < n_steps; ++d)
            step.load[d] = before[d] + (after[d] - before[d]) * k / n_steps;
          history.steps.push_back(step);
        }
        before = after;
      }
      return history;
    }

    LoadHistory history_of_table(const std::string &file)
    {
      const CsvTable table = read_csv_file(file, path("Table"));
      std::vector<std::string> known;
      for (unsigned int d = 0; d < 3; ++d)
      {
        known.emplace_back(force_columns[d]);
        known.emplace_back(displacement_columns[d]);
      }
      for (const std::string &name : table.names)
        if (std::count(known.begin(), known.end(), name) == 0)
          throw InputError(table.source + " has a column " + name + "; " + name_suggestion(name, known));
      LoadHistory history;
      std::array<const std::vector<double> *, 3> columns;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const auto *const force = table.find(force_columns[d]), *const displacement =
                                                                    table.find(displacement_columns[d]);
        if (force && displacement)
          throw InputError(table.source + " has the columns " + force_columns[d] + " and " +
                           displacement_columns[d] +
                           ", but one follows from the other: leave one of them out.");
        history.force_given[d] = force != nullptr;
        columns[d] = force ? force : displacement;
      }
      if (!columns[2])
        throw InputError(table.source + " has no column " + force_columns[2] + " or " +
                         displacement_columns[2] +
                         ": what presses the bodies together is not known; give one.");
      const std::size_t n = columns[2]->size();
      if (n == 0 || n > most_steps)
        throw InputError(table.source + " has " + std::to_string(n) + " rows: give 1 to " +
                         std::to_string(most_steps) + ", one per step.");
      for (std::size_t k = 0; k < n; ++k)
      {
        if (history.force_given[2])
          check_force(table.source + ", line " + std::to_string(table.lines[k]) + ", " + force_columns[2],
                      (*columns[2])[k]);
        history.steps.push_back({{{0, 0, 0}}, 1, k + 1 == n});
        for (unsigned int d = 0; d < 3; ++d)
          if (columns[d])
            history.steps.back().load[d] = (*columns[d])[k];
      }
      return history;
    }
  } // namespace

  void LoadingParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const List values(Double(-1e15, 1e15), 0, most_parts);
    const std::string ends = "at the ends of the parts of the history, or one that holds at all of them";
    prm.add_parameter("Normal force", force[2],
                      "Forces that press body 1 on body 2, " + ends +
                          "; empty: the Hub displacement is given. Units: N.",
                      values);
    prm.add_parameter(
        "Hub displacement", displacement[2],
        "Downward displacements of the hub of body 1 (approach of half-spaces) from the position "
        "in which the bodies touch at the nominal contact point, " +
            ends + "; empty: the Normal force is given. Units: m.",
        values);
    for (unsigned int d = 0; d < 2; ++d)
    {
      const std::string axis = d == 0 ? "x" : "y";
      prm.add_parameter(force_entries[d], force[d],
                        "Forces that drive the hub of body 1 along " + axis + ", " + ends +
                            "; empty: the Displacement " + axis + " is given. Units: N.",
                        values);
      prm.add_parameter(displacement_entries[d], displacement[d],
                        "Displacements of the hub of body 1 along " + axis + ", " + ends +
                            "; empty beside an empty Force " + axis + ": it stays. Units: m.",
                        values);
    }
    prm.add_parameter("Steps", steps,
                      "Equal steps in each part of the history, or in all of them. Units: none.",
                      List(Integer(1, most_steps), 1, most_parts));
    prm.add_parameter(
        "Table", table,
        "CSV file with the loads after each step in place of the lists: columns normal_force_N or "
        "hub_displacement_m, force_x_N or displacement_x_m, force_y_N or displacement_y_m; what "
        "has none along x or y stays. Units: N, m.",
        FileName(FileName::input));
  }

  void LoadingParameters::check() const
  {
    bool any = false;
    for (unsigned int d = 0; d < 3; ++d)
    {
      const Given one = given(*this, d);
      any = any || one.values;
      if (!table.empty() && one.values)
        throw InputError(path("Table") + " and " + one.entry +
                         " are both given, but the table has all loads: leave one of them out.");
      if (!force[d].empty() && !displacement[d].empty())
        throw InputError(path(force_entries[d]) + " and " + path(displacement_entries[d]) +
                         " are both given, but one follows from the other: empty one of them.");
    }
    if (!table.empty())
      return;
    if (!given(*this, 2).values)
      throw InputError(path(force_entries[2]) + " and " + path(displacement_entries[2]) +
                       " are neither of them given" +
                       (any ? ", so that nothing presses the bodies together" : "") + ": set one of them.");
    for (const double one : force[2])
      check_force(path(force_entries[2]), one);
    const unsigned int n = n_parts(*this);
    for (unsigned int d = 0; d < 3; ++d)
      if (const Given one = given(*this, d); one.values && one.values->size() != 1 && one.values->size() != n)
        throw InputError(one.entry + " lists " + std::to_string(one.values->size()) +
                         " values, but another direction " + std::to_string(n) +
                         ": give one for the end of each part, or a single one for all.");
    if (steps.size() != 1 && steps.size() != n)
      throw InputError(path("Steps") + " lists " + std::to_string(steps.size()) + " numbers for " +
                       std::to_string(n) + (n == 1 ? " part" : " parts") +
                       " of the history: give one for each, or a single one for all.");
    std::size_t n_steps = 0;
    for (unsigned int part = 0; part < n; ++part)
      n_steps += steps[steps.size() == 1 ? 0 : part];
    if (n_steps > most_steps)
      throw InputError(path("Steps") + " asks for " + std::to_string(n_steps) + " steps, more than " +
                       std::to_string(most_steps) + ": give fewer.");
  }

  LoadHistory LoadingParameters::history() const
  {
    return table.empty() ? history_of_lists(*this) : history_of_table(table);
  }
} // namespace vibrocontact

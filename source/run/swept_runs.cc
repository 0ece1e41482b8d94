#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/output/answer_parts.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/check_before_run.h>
#include <vibrocontact/run/run_sweep.h>
#include <vibrocontact/run/swept_runs.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// Results of a case on their way to the other ranks.
    struct CaseResults
    {
      /// CBOR, numbers bit for bit
      std::vector<std::uint8_t> analyses;
      std::vector<std::string> failures, warnings;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &analyses &failures &warnings;
      }
    };

    class SweptRuns : public SweptAnalysis
    {
    public:
      SweptRuns(const AnalysisRun &on, const PrepareRun &prepare_run,
                const std::vector<MainNumber> &all_main_numbers)
          : on(on), key(results_key(on.sweep.analysis) + "_sweep"), prepare_run(prepare_run),
            bodies(bodies_of_cases(on.sweep, on.bodies)), runs(bodies.size())
      {
        on.results.analyses[key] = {{"swept_entries", on.sweep.entries},
                                    {"swept_columns", on.sweep.columns},
                                    {"table", key + ".csv"},
                                    {"cases", Json::array()}};
        for (unsigned int k = 0; k < bodies.size(); ++k)
          folders.push_back(case_folder(on, k));
        if (reads_other_data())
          measured.resize(bodies.size());
        run_log().block("Sweep of " + on.sweep.analysis);
        run_log().value("cases", static_cast<unsigned int>(bodies.size()));
        for (const MainNumber &number : all_main_numbers)
          if (std::count(on.sweep.columns.begin(), on.sweep.columns.end(), number.column) == 0)
            main_numbers.push_back(number);
      }

      void prepare(const unsigned int k) override
      {
        const Parameters &parameters = on.sweep.cases[k].parameters();
        if (!measured.empty())
          measured[k] = measured_data(parameters);
        check_transient_files(parameters, bodies[k]);
        check_before_run(parameters, bodies[k], data_of(k));
        Results none;
        runs[k] = prepare_run(run_of(k, none));
      }

      PackedCase compute(const unsigned int k) override
      {
        std::error_code ignored; // the first file will say so
        std::filesystem::create_directories(folders[k], ignored);
        const Log::Aside log(folders[k] + "/log.txt", on.resume);
        Results results;
        results.running = on.sweep.analysis;
        runs[k](run_of(k, results));
        if (results.stopped_by != 0)
          throw CaseStopped{results.stopped_by};
        check_finite(results.analyses);
        CaseResults came{Json::to_cbor(results.analyses), {}, {}};
        for (const Results::Verdict &failure : results.failures)
          came.failures.push_back(failure.message);
        for (const Results::Verdict &warning : results.warnings)
          came.warnings.push_back(warning.message);
        return dealii::Utilities::pack(came, false);
      }

      void take(const unsigned int k, const std::function<PackedCase()> &outcome) override
      {
        const SweepCase &one = on.sweep.cases[k];
        const std::string text = case_text(on.sweep, one);
        Json found = Json::object();
        for (unsigned int i = 0; i < one.values.size(); ++i)
          std::visit([&](const auto &value) { found["swept"][on.sweep.columns[i]] = value; }, one.values[i]);
        found["folder"] = folders[k].substr(on.folder.size() + 1);
        const auto fail = [&](const std::string &reason) { refuse(text + ": " + reason, on.results); };
        const auto failed = [&](const std::string &reason)
        {
          found["status"] = "failed";
          found["reason"] = reason;
          fail(reason);
        };
        try
        {
          const CaseResults came = dealii::Utilities::unpack<CaseResults>(outcome(), false);
          found["status"] = came.failures.empty() ? "converged" : "not converged";
          const Json analyses = Json::from_cbor(came.analyses);
          found.update(analyses);
          for (const std::string &reason : came.failures)
            fail(reason);
          for (const std::string &warning : came.warnings)
            doubt(text + ": " + warning, on.results);
          run_log().line(text + ": " + found["status"].get<std::string>() + numbers_text(analyses));
        }
        catch (const InputError &error)
        {
          failed(error.what());
        }
        catch (const ConvergenceError &error)
        {
          failed(error.what());
        }
        on.results.analyses[key]["cases"].push_back(std::move(found));
      }

      void finish() override
      {
        std::vector<std::string> columns = {"case"};
        columns.insert(columns.end(), on.sweep.columns.begin(), on.sweep.columns.end());
        columns.push_back("status");
        for (const MainNumber &number : main_numbers)
          columns.push_back(number.column);
        Table table(columns, {"Main numbers of the cases of a sweep of " + on.sweep.analysis +
                              "; all of them are in results.json, what each wrote is in sweep/" +
                              results_key(on.sweep.analysis) + "/<case>"});
        const Json &cases = on.results.analyses[key]["cases"];
        for (std::size_t k = 0; k < cases.size(); ++k)
        {
          const Json &one = cases[k];
          std::vector<Table::Cell> cells = {double(k)};
          for (const auto &value : on.sweep.cases[k].values)
            cells.push_back(value);
          cells.push_back(one["status"].get<std::string>());
          for (const MainNumber &number : main_numbers)
            if (const Json *const value = find(one, number))
              cells.push_back(value->get<double>());
            else
              cells.push_back(std::string());
          table.add_row(cells);
        }
        on_first_rank([&] { table.write(on.folder + "/" + key + ".csv"); });
      }

    private:
      /// of section Identification
      bool reads_other_data() const
      {
        const std::vector<std::string> moved = moved_entries(on.sweep.entries);
        return std::any_of(moved.begin(), moved.end(),
                           [](const std::string &entry) { return entry.rfind("Identification/", 0) == 0; });
      }

      const std::optional<MeasuredData> &data_of(const unsigned int k) const
      {
        return measured.empty() ? on.measured : measured[k];
      }

      AnalysisRun run_of(const unsigned int k, Results &results) const
      {
        static const SweepCases nothing_swept;
        return {on.sweep.cases[k].parameters(),
                bodies[k],
                data_of(k),
                nothing_swept,
                folders[k],
                on.resume,
                results,
                [] {},
                [] {},
                on.recorders};
      }

      /// Null: the case has no such number.
      static const Json *find(const Json &analyses, const MainNumber &number)
      {
        const Json::json_pointer pointer(number.pointer);
        if (!analyses.contains(pointer) || !analyses.at(pointer).is_number())
          return nullptr;
        return &analyses.at(pointer);
      }

      std::string numbers_text(const Json &analyses) const
      {
        constexpr unsigned int most_said = 3;
        std::string text;
        unsigned int said = 0;
        for (const MainNumber &number : main_numbers)
          if (const Json *const value = find(analyses, number); value && said++ < most_said)
            text += ", " + number.column + " " + number_text(value->get<double>());
        return text;
      }

      const AnalysisRun &on;
      /// of its object in results.json and its table
      const std::string key;
      const PrepareRun &prepare_run;
      const std::vector<MeshedBodies> bodies;
      std::vector<std::string> folders;
      /// of each case; empty: those of the file
      std::vector<std::optional<MeasuredData>> measured;
      std::vector<PreparedRun> runs;
      std::vector<MainNumber> main_numbers;
    };
  } // namespace

  std::function<std::unique_ptr<SweptAnalysis>(const AnalysisRun &)>
  swept_runs(const PrepareRun &prepare, const std::vector<MainNumber> &main_numbers)
  {
    return [=](const AnalysisRun &on) -> std::unique_ptr<SweptAnalysis>
    { return std::make_unique<SweptRuns>(on, prepare, main_numbers); };
  }

  std::vector<std::string> sweep_answer(const Json &sweep)
  {
    using namespace answer_parts;
    const Json &cases = list(sweep, "cases");
    const std::size_t n_converged = std::count_if(
        cases.begin(), cases.end(), [](const Json &one) { return one.value("status", "") == "converged"; });
    return {text("%zu of %zu cases converged", n_converged, cases.size())};
  }
} // namespace vibrocontact

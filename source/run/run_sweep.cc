#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/checksum.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/failure.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/shared_cases.h>
#include <vibrocontact/base/stop_signal.h>
#include <vibrocontact/run/run_sweep.h>

#include <deal.II/base/utilities.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

namespace vibrocontact
{
  namespace
  {
    namespace fs = std::filesystem;

    /// What a case came to, or why it came to nothing.
    struct CaseOutcome
    {
      unsigned long long mark = 0;
      int stopped_by = 0;
      Failure failure;
      PackedCase packed;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &mark &stopped_by &failure &packed;
      }
    };

    /// changes whenever what is kept of a case, or what it means, does
    constexpr int format = 3;

    unsigned long long sum_of(const char *const data, const std::size_t n_bytes)
    {
      Checksum sum;
      sum.add(&format, sizeof format);
      sum.add(data, n_bytes);
      return sum.value();
    }

    /// Outcomes as files, each behind its checksum, by the rank that computed them.
    class KeptCases
    {
    public:
      explicit KeptCases(const AnalysisRun &on) : on(on) {}

      /// None if there is no whole one of these entries.
      std::optional<CaseOutcome> find(const unsigned int k) const
      {
        std::ifstream file(name(k), std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        unsigned long long sum = 0;
        if (!on.resume || bytes.size() <= sizeof sum)
          return {};
        std::memcpy(&sum, bytes.data(), sizeof sum);
        if (sum != sum_of(bytes.data() + sizeof sum, bytes.size() - sizeof sum))
          return {};
        CaseOutcome kept =
            dealii::Utilities::unpack<CaseOutcome>(bytes.begin() + sizeof sum, bytes.end(), false);
        if (kept.mark != on.sweep.cases[k].mark)
          return {};
        return kept;
      }

      void keep(const unsigned int k, const CaseOutcome &outcome) const
      {
        const std::vector<char> bytes = dealii::Utilities::pack(outcome, false);
        const unsigned long long sum = sum_of(bytes.data(), bytes.size());
        std::string text(reinterpret_cast<const char *>(&sum), sizeof sum);
        text.append(bytes.begin(), bytes.end());
        write_file(name(k), text);
      }

      /// On rank 0.
      void remove() const
      {
        std::error_code ignored;
        for (unsigned int k = 0; k < on.sweep.cases.size(); ++k)
          fs::remove(name(k), ignored);
        // folders go when they are empty
        const fs::path own = fs::path(name(0)).parent_path();
        fs::remove(own, ignored);
        fs::remove(own.parent_path(), ignored);
      }

    private:
      std::string name(const unsigned int k) const { return case_folder(on, k) + ".case"; }

      const AnalysisRun &on;
    };

    /// All of them, so that no collective work is left. @return why cases came to nothing
    std::vector<Failure> prepare_all(SweptAnalysis &swept, const SweepCases &sweep)
    {
      std::vector<Failure> failures(sweep.cases.size());
      for (unsigned int k = 0; k < failures.size(); ++k)
        try
        {
          swept.prepare(k);
        }
        catch (const InputError &error)
        {
          throw InputError(sweep.section + ", " + case_text(sweep, sweep.cases[k]) + ": " + error.what());
        }
        catch (const ConvergenceError &error)
        {
          failures[k] = {Failure::Kind::convergence, error.what()};
        }
      return failures;
    }
  } // namespace

  std::string case_folder(const AnalysisRun &on, const unsigned int k)
  {
    return on.folder + "/sweep/" + results_key(on.sweep.analysis) + "/" + std::to_string(k);
  }

  void run_sweep(const Analysis &analysis, const AnalysisRun &on)
  {
    const SweepCases &sweep = on.sweep;
    const std::unique_ptr<SweptAnalysis> swept = analysis.swept(on);
    const std::vector<Failure> unprepared = prepare_all(*swept, sweep);
    const KeptCases kept(on);
    const StopSignals signals;
    Progress progress(sweep.analysis + " cases", sweep.cases.size());
    const auto compute = [&](const unsigned int k)
    {
      if (const std::optional<CaseOutcome> found = kept.find(k))
        return *found;
      CaseOutcome outcome;
      outcome.mark = sweep.cases[k].mark;
      outcome.stopped_by = signals.received();
      outcome.failure = unprepared[k];
      if (outcome.stopped_by != 0 || outcome.failure)
        return outcome;
      const SingleRank lone;
      outcome.failure = failure_of(
          [&]
          {
            try
            {
              outcome.packed = swept->compute(k);
            }
            catch (const CaseStopped &stopped)
            {
              outcome.stopped_by = stopped.signal;
            }
          });
      // a full disk or a fault of the machine may be gone when the run is resumed
      const bool is_answer = !outcome.failure || outcome.failure.kind == Failure::Kind::input ||
                             outcome.failure.kind == Failure::Kind::convergence;
      if (outcome.stopped_by == 0 && is_answer)
        kept.keep(k, outcome);
      return outcome;
    };
    int stopped_by = 0;
    bool any = false, diverged = false;
    std::string last_reason;
    const auto arrived = [&](const unsigned int k, const std::function<CaseOutcome()> &computed)
    {
      const CaseOutcome outcome = computed();
      if (stopped_by == 0)
        stopped_by = outcome.stopped_by;
      if (stopped_by != 0)
        return;
      any = any || !outcome.failure;
      diverged = diverged || outcome.failure.kind == Failure::Kind::convergence;
      last_reason = outcome.failure.text;
      swept->take(k,
                  [&]
                  {
                    outcome.failure.rethrow();
                    return outcome.packed;
                  });
      progress.advance();
      on.save_sometimes();
    };
    share_cases<CaseOutcome>(
        sweep.cases.size(), swept->cases_per_chunk(), [&] { return compute; }, arrived, run_communicator());
    on.results.stopped_by = stopped_by;
    if (stopped_by != 0)
    {
      run_log().warning("Interrupted; --resume goes on with the cases that are left.");
      return;
    }
    if (!any)
    {
      const std::string text =
          sweep.section + "/" + sweep.entry + ": none of the cases has a result. " + last_reason;
      if (diverged)
        throw ConvergenceError(text);
      throw InputError(text);
    }
    swept->finish();
    on_first_rank([&] { kept.remove(); });
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/stability/damper_variants.h>
#include <vibrocontact/analyses/stability/followed_row.h>
#include <vibrocontact/analyses/stability/root_derivatives.h>
#include <vibrocontact/analyses/stability/root_paths.h>
#include <vibrocontact/analyses/stability/run_stability.h>
#include <vibrocontact/analyses/stability/stability_output.h>
#include <vibrocontact/analyses/stability/sweep_case.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/failure.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/say_residual_damping.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    SolvedCase solve(const SweepCase &one, const std::optional<MeasuredData> &measured,
                     const std::vector<const ReducedBody *> &reduced, const MeshedBodies &bodies)
    {
      const PairOfCase of_case = pair_of_case(one, measured, reduced, bodies);
      SolvedCase solved;
      solved.result = stability(
                          one.parameters().stability, rolling_of_case(one), one.parameters().contacts,
                          one.parameters().contact_solver, of_case.pair, [](const StabilityResult &) {}, {},
                          of_case.loss_or_null())
                          .front();
      const ContactPair &moving = solved.result.suspended ? *solved.result.suspended : of_case.pair;
      solved.labels = moving.labels;
      solved.omega = moving.frequencies();
      return solved;
    }

    /// What cases share that differ by the dampers of body 1 alone.
    struct SharedScene
    {
      SolvedCase equilibrium;
      std::unique_ptr<DamperVariants> variants;

      SharedScene(const SweepCase &one, const std::optional<MeasuredData> &measured,
                  const std::vector<const ReducedBody *> &reduced, const MeshedBodies &bodies)
      {
        const Parameters &parameters = one.parameters();
        const PairOfCase bare = pair_of_case(one, measured, reduced, bodies, false);
        const CreepScheme &scheme = find_creep_scheme(parameters.contact().creep_scheme);
        const auto roots_about = [&](const RollingEquilibrium &about)
        {
          variants = std::make_unique<DamperVariants>(bare.pair, *bare.loss, scheme, about,
                                                      reduced.front()->section);
          // each case has its own
          return std::vector<StabilityRoot>(1);
        };
        equilibrium.result =
            stability(
                parameters.stability, rolling_of_case(one), parameters.contacts, parameters.contact_solver,
                bare.pair, [](const StabilityResult &) {}, roots_about, &*bare.loss)
                .front();
        equilibrium.labels = variants->bare_body().labels;
        equilibrium.omega = variants->bare_body().omega;
      }

      SolvedCase solve(const SweepCase &one)
      {
        const auto begin = WallClock::now();
        SolvedCase solved = equilibrium;
        solved.result.roots = variants->roots(one.parameters().scene.bodies[0]);
        solved.result.seconds = seconds_since(begin);
        return solved;
      }
    };

    void print(const std::string &text, const StabilityResult &result)
    {
      char line[200];
      if (result.unstable().empty())
      {
        const StabilityRoot &root = result.nearest();
        std::snprintf(line, sizeof line, "stable, nearest %.2f Hz %+.3f 1/s %s", root.frequency, root.growth,
                      root.path.c_str());
        run_log().line(text + ": " + line);
        return;
      }
      std::string all;
      for (const StabilityRoot *const root : result.unstable())
      {
        std::snprintf(line, sizeof line, "%s%.2f Hz %+.3f 1/s %s", all.empty() ? "" : ", ", root->frequency,
                      root->growth, root->path.c_str());
        all += line;
      }
      run_log().line(text + ": UNSTABLE " + all);
    }

    class StabilitySweep : public SweptAnalysis
    {
    public:
      explicit StabilitySweep(const AnalysisRun &on)
          : on(on), sweep(on.sweep), bodies(bodies_of_cases(on.sweep, on.bodies)), reduced(bodies)
      {
        outcome.entries = sweep.entries;
        outcome.columns = sweep.columns;
        outcome.loss = on.parameters.stability.loss;
        run_log().block("Stability");
        if (!sweep.left_out.empty())
        {
          std::ostringstream text;
          for (const double position : sweep.left_out)
            text << (position == sweep.left_out.front() ? "" : ", ") << 1e3 * position;
          doubt("Contact/Lateral position: left out since the contact point is not on the tread, "
                "two rows of points from its ends: " +
                    text.str() + " mm.",
                on.results);
        }
      }

      void prepare(const unsigned int k) override
      {
        reduced.prepare(k);
        if (k + 1 == sweep.cases.size() && differ_by_dampers())
          share_scene();
      }

      unsigned int cases_per_chunk() const override
      {
        if (!on.parameters.stability.follows())
          return 1;
        return sweep.entries.size() == 1 ? sweep.cases.size() : sweep.cases.back().second + 1;
      }

      PackedCase compute(const unsigned int k) override
      {
        if (on.parameters.stability.follows())
        {
          const unsigned int length = cases_per_chunk(), number = k / length;
          if (row.empty() || row_number != number)
          {
            row_number = number;
            row = followed(number * length, length);
          }
          const CaseOfRow &one = row[k % length];
          one.failure.rethrow();
          return dealii::Utilities::pack(one.solved, false);
        }
        const SweepCase &one = sweep.cases[k];
        if (!on.parameters.stability.are_of_body_1())
          return dealii::Utilities::pack(solve(one, on.measured, reduced.of(k), bodies[k]), false);
        if (!shared || !differ_by_dampers())
          shared = std::make_unique<SharedScene>(one, on.measured, reduced.of(k), bodies[k]);
        return dealii::Utilities::pack(shared->solve(one), false);
      }

      void take(const unsigned int k, const std::function<PackedCase()> &computed) override
      {
        const SweepCase &one = sweep.cases[k];
        // a row follows the beginning of the row before, whichever cases were left out
        if (one.second == 0)
        {
          paths = begin_of_row;
          row_has_begun = false;
        }
        const std::string text = case_text(sweep, one);
        const auto leave_out = [&](const std::string &reason)
        {
          doubt(text + " is left out. " + reason, on.results);
          outcome.left_out.emplace_back(one.values, reason);
        };
        const auto fail = [&](const std::string &reason)
        {
          refuse(text + " is left out: " + reason, on.results);
          outcome.left_out.emplace_back(one.values, reason);
        };
        try
        {
          SolvedCase solved = dealii::Utilities::unpack<SolvedCase>(computed(), false);
          StabilityResult &result = solved.result;
          if (solved.labels.empty())
            for (StabilityRoot &root : result.roots)
              root.path = names.at(std::stoul(root.path));
          else
          {
            paths.follow(solved.labels, solved.omega, result.roots);
            names.clear();
            for (const StabilityRoot &root : result.roots)
              names.push_back(root.path);
          }
          if (!solved.not_followed.empty())
          {
            run_log().line(text + ": this row is solved completely. " + solved.not_followed);
            ++n_rows_not_followed;
          }
          n_followed += result.followed;
          residual = std::max(residual, solved.residual);
          if (!row_has_begun)
            begin_of_row = paths;
          row_has_begun = true;
          for (StabilityRoot &root : result.roots)
          {
            root.shape.clear();
            root.states.clear();
          }
          print(text, result);
          outcome.values.push_back(one.values);
          outcome.results.push_back(std::move(result));
        }
        catch (const InputError &error)
        {
          const bool at_end =
              contacts_of_case(one).n_points() < one.parameters().placed_contacts().n_points();
          if (at_end)
            leave_out("The tread ends within the contact grid. " + std::string(error.what()));
          else
            fail(error.what());
        }
        catch (const ConvergenceError &error)
        {
          fail(error.what());
        }
        nlohmann::ordered_json &json = on.results.analyses["stability"];
        if (k == 0)
          json = stability_json(outcome);
        else
          add_new_cases(outcome, json);
        json.erase("contacts");
        add_contacts(outcome, one.parameters().placed_contacts(), json);
      }

      void finish() override
      {
        add_mean_growth(outcome, on.results.analyses["stability"]);
        judge_reach_of_modes(outcome.results, on.results);
        if (on.parameters.stability.follows())
        {
          on.results.analyses["stability"]["followed"] = {
              {"cases", n_followed},
              {"complete_cases", outcome.results.size() - n_followed},
              {"rows_solved_completely", n_rows_not_followed},
              {"largest_residual", residual}};
          run_log().value("cases followed", n_followed);
          run_log().value("complete cases", static_cast<unsigned int>(outcome.results.size()) - n_followed);
        }
        unsigned int k = 0;
        while (!reduced.has(k))
          ++k;
        say_coupled_damping(reduced.of(k), on.results);
        if (on.parameters.stability.is_hysteretic())
          say_hysteretic_rests(on.parameters, on.results);
        else
          say_residual_damping(sweep.cases[k].parameters(), reduced.of(k), 0.,
                               frequencies_that_matter(outcome.results.front()), "stability", on.results,
                               sweep.cases[k].parameters().stability.options().residual_rate);
        on_first_rank(
            [&]
            {
              stability_table(outcome).write(on.folder + "/stability.csv");
              stability_sweep_table(outcome).write(on.folder + "/stability_sweep.csv");
              stability_map_table(outcome).write(on.folder + "/stability_map.csv");
            });
      }

    private:
      bool differ_by_dampers() const
      {
        const std::string dampers = on.parameters.scene.bodies[0].name + "/Wheel/Damper/";
        const std::vector<std::string> moved = moved_entries(sweep.entries);
        return on.parameters.stability.are_of_body_1() &&
               std::all_of(moved.begin(), moved.end(),
                           [&](const std::string &entry) { return entry.rfind(dampers, 0) == 0; });
      }

      /// What the cases share, made before they are shared out. A reason why it cannot be made is said with the cases.
      void share_scene()
      {
        const unsigned int n = sweep.cases.size(), n_samples = std::min(n, 32u);
        Failure failure;
        {
          const SingleRank lone;
          failure = failure_of(
              [&] {
                shared = std::make_unique<SharedScene>(sweep.cases[0], on.measured, reduced.of(0), bodies[0]);
              });
        }
        if (dealii::Utilities::MPI::max(failure ? 1 : 0, run_communicator()) > 0)
        {
          shared.reset();
          return;
        }
        std::vector<const BodyParameters *> samples;
        for (unsigned int i = 0; i < n_samples; ++i)
          samples.push_back(
              &sweep.cases[i * (n - 1) / std::max(n_samples - 1, 1u)].parameters().scene.bodies[0]);
        shared->variants->prepare(samples, run_communicator());
      }

      std::vector<CaseOfRow> followed(const unsigned int first, const unsigned int length) const
      {
        std::vector<const SweepCase *> cases;
        std::vector<const MeshedBodies *> bodies_of;
        for (unsigned int k = first; k < first + length; ++k)
        {
          cases.push_back(&sweep.cases[k]);
          bodies_of.push_back(&bodies[k]);
        }
        const auto reduced_of = [&](const unsigned int k) { return std::cref(reduced.of(first + k)); };
        const std::vector<std::string> moved = moved_entries({sweep.entries.back()});
        return followed_row(cases, reduced_of, bodies_of, on.measured, first / length,
                            std::all_of(moved.begin(), moved.end(), keeps_bodies));
      }

      const AnalysisRun &on;
      const SweepCases &sweep;
      const std::vector<MeshedBodies> bodies;
      ReducedOfCases reduced;
      std::unique_ptr<SharedScene> shared;
      StabilityOutcome outcome;
      RootPaths paths, begin_of_row;
      bool row_has_begun = false;
      /// the row that this rank has followed last
      std::vector<CaseOfRow> row;
      unsigned int row_number = 0;
      /// of the roots in the last case that has all of them
      std::vector<std::string> names;
      unsigned int n_followed = 0, n_rows_not_followed = 0;
      double residual = 0;
    };
  } // namespace

  std::unique_ptr<SweptAnalysis> swept_stability(const AnalysisRun &on)
  {
    if (on.sweep.beside_run)
      return root_derivatives(on);
    return std::make_unique<StabilitySweep>(on);
  }
} // namespace vibrocontact

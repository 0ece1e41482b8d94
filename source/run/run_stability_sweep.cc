#include <vibrocontact/analyses/root_paths.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/failure.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/shared_cases.h>
#include <vibrocontact/output/stability_output.h>
#include <vibrocontact/reduction/window.h>
#include <vibrocontact/run/run_stability.h>
#include <vibrocontact/run/say_residual_damping.h>

#include <cstdio>
#include <map>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// The reduced bodies of a sweep, each reduced once: by all ranks together, before the cases are shared out.
    class ReducedBodies
    {
    public:
      /// What is wrong with a body is heard of here. One that cannot be reduced is thrown where its case comes,
      /// which is left out.
      ReducedBodies(const StabilityCases &sweep, const MeshedBodies &bodies)
      {
        for (const StabilityCase &one : sweep.cases)
          for (unsigned int k = 0; k < 2; ++k)
            if (!one.keys[k].empty() && all.count(key(one, k)) == 0)
              try
              {
                all[key(one, k)] = {reduce(one, bodies, k), {}};
              }
              catch (const InputError &error)
              {
                throw InputError("Stability/Sweep, " + case_text(sweep, one) + ": " + error.what());
              }
              catch (const ConvergenceError &error)
              {
                all[key(one, k)].failure = {Failure::Kind::convergence, error.what()};
              }
      }

      /// Body k of a case; null if it has no mesh.
      const ReducedBody *find(const StabilityCase &one, const unsigned int k) const
      {
        if (one.keys[k].empty())
          return nullptr;
        const Reduced &found = all.at(key(one, k));
        found.failure.rethrow();
        return &found.body;
      }

    private:
      struct Reduced
      {
        ReducedBody body;
        Failure failure;
      };

      static std::string key(const StabilityCase &one, const unsigned int k)
      {
        return one.keys[k] + "\n" + one.parameters.modes.at(one.parameters.scene.bodies[k].name).key();
      }

      static ReducedBody reduce(const StabilityCase &one, const MeshedBodies &bodies, const unsigned int k)
      {
        const ReductionRequest &own = bodies[k]->reduction.request();
        if (own.key + "\n" + own.modes.key() == key(one, k))
          return bodies[k]->reduction.reduced(true);
        return meshed_body(one.parameters, one.keys[k], k)->reduction.reduced(true);
      }

      std::map<std::string, Reduced> all;
    };

    ContactGrid grid_of_case(const StabilityCase &one)
    {
      return one.parameters.stability.sweep.sweeps(ParameterSweep::lateral_position)
                 ? one.parameters.contact_grid(one.lateral_position)
                 : one.parameters.contact_grid();
    }

    ContactPair pair_of_case(const StabilityCase &one, const ReducedBodies &reduced_bodies)
    {
      const Parameters &parameters = one.parameters;
      const ContactGrid grid = grid_of_case(one);
      std::vector<ReducedBody> own(2);
      std::vector<ContactBody> bodies;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const BodyParameters &body = parameters.scene.bodies[k];
        const ReducedBody *const reduced = reduced_bodies.find(one, k);
        if (reduced)
        {
          double lateral = 0, height = 0;
          if (k == 0)
          {
            const double nominal = parameters.contact.lateral_position;
            lateral = one.lateral_position - nominal;
            if (const auto axle = body.axle_height(nominal))
              height = *axle - *body.axle_height(one.lateral_position);
          }
          own[k] = window(*reduced, grid, lateral, height);
          scale_damping(own[k], parameters.modes.at(body.name));
        }
        bodies.push_back({&body, reduced ? &own[k] : nullptr});
      }
      return contact_pair(bodies[0], bodies[1], parameters.contact, grid);
    }

    /// A case with what its roots are followed by.
    struct SolvedCase
    {
      StabilityResult result;
      /// of the modes that the shapes of the roots are amplitudes of
      std::vector<std::string> labels;
      std::vector<double> omega;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &result &labels &omega;
      }
    };

    SolvedCase solve(const StabilityCase &one, const ReducedBodies &reduced)
    {
      const ContactPair pair = pair_of_case(one, reduced);
      RollingParameters rolling = one.parameters.rolling;
      rolling.hub = one.parameters.hub();
      SolvedCase solved;
      solved.result = stability(one.parameters.stability, rolling, one.parameters.contact,
                                one.parameters.contact_solver, pair, [](const StabilityResult &) {})
                          .front();
      const ContactPair &moving = solved.result.suspended ? *solved.result.suspended : pair;
      solved.labels = moving.labels;
      solved.omega = moving.omega;
      return solved;
    }

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
  } // namespace

  void run_stability_sweep(const StabilityCases &sweep, const MeshedBodies &bodies, const std::string &folder,
                           Results &results, const std::function<void()> &save)
  {
    StabilityOutcome outcome;
    outcome.entries = sweep.entries;
    outcome.columns = sweep.columns;
    run_log().block("Stability");
    if (!sweep.left_out.empty())
    {
      std::ostringstream text;
      for (const double position : sweep.left_out)
        text << (position == sweep.left_out.front() ? "" : ", ") << 1e3 * position;
      run_log().warning("Contact/Lateral position: left out since the contact point is not on the tread, two "
                        "rows of points from its ends: " +
                        text.str() + " mm.");
    }
    const ReducedBodies reduced(sweep, bodies);
    results.analyses["stability"] = stability_json(outcome);
    Progress progress("stability cases", sweep.cases.size());
    RootPaths paths, begin_of_row;
    bool row_has_begun = false;
    std::string failure;
    const auto solve_case = [&](const unsigned int k) { return solve(sweep.cases[k], reduced); };
    const auto arrived = [&](const unsigned int k, const std::function<SolvedCase()> &solved_case)
    {
      const StabilityCase &one = sweep.cases[k];
      // a row follows the beginning of the row before, whichever cases were left out
      if (one.second == 0)
      {
        paths = begin_of_row;
        row_has_begun = false;
      }
      const std::string text = case_text(sweep, one);
      const auto leave_out = [&](const std::string &reason)
      {
        run_log().warning(text + " is left out. " + reason);
        outcome.left_out.emplace_back(one.values, reason);
        failure = reason;
      };
      try
      {
        SolvedCase solved = solved_case();
        StabilityResult &result = solved.result;
        paths.follow(solved.labels, solved.omega, result.roots);
        if (!row_has_begun)
          begin_of_row = paths;
        row_has_begun = true;
        for (StabilityRoot &root : result.roots)
          root.shape.clear();
        print(text, result);
        outcome.values.push_back(one.values);
        outcome.results.push_back(std::move(result));
      }
      catch (const InputError &error)
      {
        const bool at_end = grid_of_case(one).n_points() < one.parameters.contact_grid().n_points();
        leave_out((at_end ? "The tread ends within the contact grid. " : "") + std::string(error.what()));
      }
      catch (const ConvergenceError &error)
      {
        leave_out(error.what());
        results.failures.push_back({"stability", text + ": " + error.what()});
      }
      add_new_cases(outcome, results.analyses["stability"]);
      progress.advance();
      save();
    };
    share_cases<SolvedCase>(
        sweep.cases.size(), 1, [&] { return solve_case; }, arrived, MPI_COMM_WORLD);
    if (outcome.results.empty())
      throw InputError("Stability/Sweep/Entry: none of the cases has a result. " + failure);
    const Parameters &first = sweep.cases.front().parameters;
    say_residual_damping(first, {reduced.find(sweep.cases.front(), 0), reduced.find(sweep.cases.front(), 1)},
                         0., frequencies_that_matter(outcome.results.front()), "stability", results);
    on_first_rank(
        [&]
        {
          stability_table(outcome).write(folder + "/stability.csv");
          stability_sweep_table(outcome).write(folder + "/stability_sweep.csv");
          stability_map_table(outcome).write(folder + "/stability_map.csv");
        });
  }
} // namespace vibrocontact

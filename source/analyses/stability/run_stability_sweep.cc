#include <vibrocontact/analyses/stability/damper_variants.h>
#include <vibrocontact/analyses/stability/root_paths.h>
#include <vibrocontact/analyses/stability/run_stability.h>
#include <vibrocontact/analyses/stability/stability_output.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/window.h>
#include <vibrocontact/run/prepare_pair.h>
#include <vibrocontact/run/say_residual_damping.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <optional>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    PlacedContacts contacts_of_case(const SweepCase &one)
    {
      PlacedContacts contacts = one.parameters.placed_contacts();
      if (one.parameters.lateral_sweep())
        contacts.only() = one.parameters.contact_grid_at(one.lateral_position);
      return contacts;
    }

    /// @param reduced_bodies null for bodies without mesh
    /// @param loss gets what Stability/Loss = hysteretic takes out of the damping ratios
    /// @param with_dampers of a wheel
    ContactPair pair_of_case(const SweepCase &one, const std::optional<MeasuredData> &measured,
                             const std::vector<const ReducedBody *> &reduced_bodies,
                             const MeshedBodies &meshed_bodies, std::optional<HystereticLoss> &loss,
                             const bool with_dampers = true)
    {
      const Parameters &parameters = one.parameters;
      const PlacedContacts contacts = contacts_of_case(one);
      const unsigned int n_bodies = parameters.scene.bodies.size();
      std::vector<std::optional<ReducedBody>> own(n_bodies);
      std::vector<ContactBody> bodies;
      for (unsigned int k = 0; k < n_bodies; ++k)
      {
        const BodyParameters &body = parameters.scene.bodies[k];
        const ReducedBody *const reduced = reduced_bodies[k];
        std::optional<ReducedBody> meshed;
        if (reduced && parameters.lateral_sweep())
        {
          double lateral = 0, height = 0;
          if (k == 0)
          {
            const double nominal = parameters.contact().lateral_position;
            lateral = one.lateral_position - nominal;
            if (const auto axle = body.axle_height(nominal))
              height = *axle - *body.axle_height(one.lateral_position);
          }
          meshed = window(*reduced, contacts.only(), lateral, height);
        }
        else if (reduced)
          meshed = *reduced;
        if (meshed && body.is_meshed())
          add_damping(*meshed, body, parameters.modes.at(body.name), with_dampers);
        own[k] = body_of_contact(parameters, std::move(meshed), measured, k);
        bodies.push_back({&body, own[k] ? &*own[k] : nullptr});
      }
      ContactPair pair = contact_pair(bodies, parameters.contacts, contacts);
      if (parameters.stability.is_hysteretic())
      {
        loss = take_hysteretic_loss(pair, bodies, parameters.contacts, contacts);
        loss->exact = exact_receptances(meshed_bodies, contacts);
      }
      return pair;
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

    SolvedCase solve(const SweepCase &one, const std::optional<MeasuredData> &measured,
                     const std::vector<const ReducedBody *> &reduced, const MeshedBodies &bodies)
    {
      std::optional<HystereticLoss> loss;
      const ContactPair pair = pair_of_case(one, measured, reduced, bodies, loss);
      RollingParameters rolling = one.parameters.rolling;
      rolling.hub = one.parameters.hub();
      SolvedCase solved;
      solved.result =
          stability(
              one.parameters.stability, rolling, one.parameters.contacts, one.parameters.contact_solver, pair,
              [](const StabilityResult &) {}, {}, loss ? &*loss : nullptr)
              .front();
      const ContactPair &moving = solved.result.suspended ? *solved.result.suspended : pair;
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
        const Parameters &parameters = one.parameters;
        std::optional<HystereticLoss> loss;
        const ContactPair pair = pair_of_case(one, measured, reduced, bodies, loss, false);
        RollingParameters rolling = parameters.rolling;
        rolling.hub = parameters.hub();
        const CreepScheme &scheme = find_creep_scheme(parameters.contact().creep_scheme);
        const auto roots_about = [&](const RollingEquilibrium &about)
        {
          variants = std::make_unique<DamperVariants>(pair, *loss, scheme, about, reduced.front()->section);
          return variants->roots(parameters.scene.bodies[0]);
        };
        equilibrium.result =
            stability(
                parameters.stability, rolling, parameters.contacts, parameters.contact_solver, pair,
                [](const StabilityResult &) {}, roots_about, &*loss)
                .front();
        equilibrium.labels = variants->bare_body().labels;
        equilibrium.omega = variants->bare_body().omega;
      }

      SolvedCase solve(const SweepCase &one)
      {
        const auto begin = std::chrono::steady_clock::now();
        SolvedCase solved = equilibrium;
        solved.result.roots = variants->roots(one.parameters.scene.bodies[0]);
        solved.result.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
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
          : on(on), sweep(on.sweep), bodies(bodies_of_cases(on.sweep, on.bodies)), reduced(bodies.size())
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
          run_log().warning("Contact/Lateral position: left out since the contact point is not on the tread, "
                            "two rows of points from its ends: " +
                            text.str() + " mm.");
        }
      }

      void prepare(const unsigned int k) override
      {
        reduced[k].assign(bodies[k].size(), nullptr);
        for (unsigned int b = 0; b < bodies[k].size(); ++b)
          if (MeshedBody *const body = bodies[k][b].get())
          {
            if (all_reduced.count(body) == 0)
              all_reduced[body] = body->reduction.reduced(true);
            reduced[k][b] = &all_reduced[body];
          }
          else if (TrackBody *const track = b < bodies[k].tracks.size() ? bodies[k].tracks[b].get() : nullptr)
          {
            if (all_tracks.count(track) == 0)
            {
              all_tracks[track] = track->moving();
              track->beside_rest(); // its elements, before ranks part
            }
            reduced[k][b] = &all_tracks[track];
          }
      }

      PackedCase compute(const unsigned int k) override
      {
        const SweepCase &one = sweep.cases[k];
        if (!one.parameters.stability.are_of_body_1())
          return dealii::Utilities::pack(solve(one, on.measured, reduced[k], bodies[k]), false);
        const std::string dampers = one.parameters.scene.bodies[0].name + "/Wheel/Damper/";
        const bool same_scene =
            std::all_of(sweep.entries.begin(), sweep.entries.end(),
                        [&](const std::string &entry) { return entry.rfind(dampers, 0) == 0; });
        if (!shared || !same_scene)
          shared = std::make_unique<SharedScene>(one, on.measured, reduced[k], bodies[k]);
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
          run_log().warning(text + " is left out. " + reason);
          outcome.left_out.emplace_back(one.values, reason);
        };
        try
        {
          SolvedCase solved = dealii::Utilities::unpack<SolvedCase>(computed(), false);
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
          const bool at_end = contacts_of_case(one).n_points() < one.parameters.placed_contacts().n_points();
          leave_out((at_end ? "The tread ends within the contact grid. " : "") + std::string(error.what()));
        }
        catch (const ConvergenceError &error)
        {
          leave_out(error.what());
          on.results.failures.push_back({"stability", text + ": " + error.what()});
        }
        nlohmann::ordered_json &json = on.results.analyses["stability"];
        if (k == 0)
          json = stability_json(outcome);
        else
          add_new_cases(outcome, json);
        json.erase("contacts");
        add_contacts(outcome, one.parameters.placed_contacts(), json);
      }

      void finish() override
      {
        add_mean_growth(outcome, on.results.analyses["stability"]);
        if (on.parameters.stability.is_hysteretic())
          say_hysteretic_rests(on.parameters, on.results);
        else
          say_residual_damping(sweep.cases.front().parameters, reduced.front(), 0.,
                               frequencies_that_matter(outcome.results.front()), "stability", on.results,
                               sweep.cases.front().parameters.stability.options().residual_rate);
        on_first_rank(
            [&]
            {
              stability_table(outcome).write(on.folder + "/stability.csv");
              stability_sweep_table(outcome).write(on.folder + "/stability_sweep.csv");
              stability_map_table(outcome).write(on.folder + "/stability_map.csv");
            });
      }

    private:
      const AnalysisRun &on;
      const SweepCases &sweep;
      const std::vector<MeshedBodies> bodies;
      std::map<const MeshedBody *, ReducedBody> all_reduced;
      std::map<const TrackBody *, ReducedBody> all_tracks;
      /// of each case, its bodies
      std::vector<std::vector<const ReducedBody *>> reduced;
      std::unique_ptr<SharedScene> shared;
      StabilityOutcome outcome;
      RootPaths paths, begin_of_row;
      bool row_has_begun = false;
    };
  } // namespace

  std::unique_ptr<SweptAnalysis> swept_stability(const AnalysisRun &on)
  {
    return std::make_unique<StabilitySweep>(on);
  }
} // namespace vibrocontact

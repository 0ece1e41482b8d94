#include <vibrocontact/analyses/stability/root_derivatives.h>
#include <vibrocontact/analyses/stability/run_stability.h>
#include <vibrocontact/analyses/stability/sparse_roots.h>
#include <vibrocontact/analyses/stability/stability_output.h>
#include <vibrocontact/analyses/stability/unstable_shapes.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/finite_element_pair.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/reduction/attachment_inertia.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/pair_in_time.h>
#include <vibrocontact/run/prepare_pair.h>
#include <vibrocontact/run/say_residual_damping.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace vibrocontact
{
  namespace
  {
    void print(const StabilityResult &result)
    {
      Log &log = run_log();
      const auto line = [&](const StabilityRoot &root, const char *what)
      {
        char text[200];
        std::snprintf(text, sizeof text, "%s %12.3f Hz  growth %10.3f 1/s  %s", what, root.frequency,
                      root.growth, root.label.c_str());
        log.line(text);
      };
      log.value("normal force", result.normal_force, "N");
      log.value("points in contact", result.contact_points);
      for (const StabilityRoot *const root : result.unstable())
        line(*root, "unstable:");
      if (result.unstable().empty())
        line(result.nearest(), "stable; nearest root:");
      if (result.n_above > 0)
        log.value("roots above Upper frequency", std::to_string(result.n_above) + ", of which grow " +
                                                     std::to_string(result.n_growing_above));
    }
    InertialPair with_inertia(const Parameters &parameters, const MeshedBodies &bodies,
                              const PreparedPair &prepared)
    {
      std::vector<ReducedBody> reduced(bodies.size());
      std::vector<ContactBody> with = prepared.bodies;
      for (unsigned int k = 0; k < bodies.size(); ++k)
        if (bodies[k])
        {
          reduced[k] = with_attachment_inertia(prepared.reduced[k], bodies[k]->reduction.attachment_mass());
          with[k].reduced = &reduced[k];
        }
      return inertial_pair(contact_pair(with, parameters.contacts, parameters.placed_contacts()));
    }

    /// Of what Stability/Model says; empty for the reduced pair itself.
    RootFinder root_finder(const Parameters &parameters, const MeshedBodies &bodies,
                           const PreparedPair &prepared, const ContactPair &pair)
    {
      const StabilityParameters &stability = parameters.stability;
      const CreepScheme &scheme = find_creep_scheme(parameters.contact().creep_scheme);
      const LinearisationOptions options = stability.options();
      const auto dense = [&](InertialPair &&inertial) -> RootFinder
      {
        run_log().value("degrees of freedom", inertial.mass.m());
        return [=, inertial = std::make_shared<const InertialPair>(std::move(inertial))](
                   const RollingEquilibrium &about)
        { return inertial_roots(*inertial, scheme, about, options); };
      };
      if (stability.is_reduced())
        return {};
      if (stability.model == "attachment inertia")
        return dense(with_inertia(parameters, bodies, prepared));
      FiniteElementPair elements;
      for (unsigned int k = 0; k < bodies.size(); ++k)
        elements.push_back(
            bodies[k] ? FiniteElementBody{&bodies[k]->reduction.system(), &bodies[k]->reduction.shapes()}
                      : FiniteElementBody());
      const unsigned int n_dofs = n_moving_dofs(elements);
      if (n_dofs <= most_dense_dofs)
        return dense(finite_element_pair(elements, pair));
      run_log().value("degrees of freedom", n_dofs);
      return [=, &pair](const RollingEquilibrium &about)
      { return sparse_roots(elements, pair, scheme, about, options, stability.n_roots); };
    }
  } // namespace

  std::vector<double> frequencies_that_matter(const StabilityResult &result)
  {
    std::vector<double> frequencies;
    for (const StabilityRoot *const root : result.unstable())
      frequencies.push_back(root->frequency);
    if (frequencies.empty())
      frequencies.push_back(result.nearest().frequency);
    return frequencies;
  }

  void judge_reach_of_modes(const std::vector<StabilityResult> &all, Results &results)
  {
    std::size_t most = 0;
    double reach = 0;
    for (const StabilityResult &one : all)
    {
      const auto grown = one.unstable();
      const std::size_t n =
          std::count_if(grown.begin(), grown.end(),
                        [&one](const StabilityRoot *root) { return root->frequency > one.modes_reach; });
      if (n > most)
      {
        most = n;
        reach = one.modes_reach;
      }
    }
    if (most > 0)
      doubt(std::string(all.size() > 1 ? "Up to " : "") + std::to_string(most) +
                (most == 1 ? " root that grows lies" : " roots that grow lie") + " above " +
                number_text(reach) +
                " Hz, the highest of the modes kept, which do not carry it: give a Stability/Upper "
                "frequency below, or keep more modes.",
            results);
  }

  void run_stability(const Parameters &parameters, const MeshedBodies &bodies,
                     const std::optional<MeasuredData> &measured, const std::string &folder, Results &results)
  {
    const PairInTime in_time = parameters.stability.is_hysteretic()
                                   ? PairInTime{prepare_pair(parameters, bodies, measured, true)}
                                   : prepare_pair_in_time(parameters, bodies, measured);
    const PreparedPair *const prepared = in_time.prepared.get();
    run_log().block("Stability");
    ContactPair pair = contact_pair(prepared->bodies, parameters.contacts, parameters.placed_contacts());
    std::optional<HystereticLoss> loss;
    if (parameters.stability.is_hysteretic())
    {
      loss = take_hysteretic_loss(pair, prepared->bodies, parameters.contacts, parameters.placed_contacts());
      loss->exact = exact_receptances(bodies, parameters.placed_contacts());
    }
    run_log().value("modes", pair.n_modes());
    run_log().value("loss of the bodies", parameters.stability.loss);
    const RootFinder roots_about = root_finder(parameters, bodies, *prepared, pair);
    Progress progress("stability cases", rolling_cases(parameters.rolling, parameters.contacts).size());
    const auto finished = [&](const StabilityResult &result)
    {
      print(result);
      progress.advance();
    };
    RollingParameters rolling = parameters.rolling;
    rolling.hub = parameters.hub();
    run_log().value("hub", hub_text(rolling.hub));
    const auto failed = [&](const std::string &why)
    {
      refuse(why, results);
      progress.advance();
    };
    const std::vector<StabilityResult> all =
        stability(parameters.stability, rolling, parameters.contacts, parameters.contact_solver, pair,
                  finished, roots_about, loss ? &*loss : nullptr, failed);
    if (!in_time.wrong.empty())
      refuse(in_time.wrong, results);
    if (all.empty())
      return;
    StabilityOutcome outcome;
    outcome.loss = parameters.stability.loss;
    outcome.results = all;
    on_first_rank([&] { stability_table(outcome).write(folder + "/stability.csv"); });
    results.analyses["stability"] = stability_json(outcome);
    add_contacts(outcome, pair.interface.contacts, results.analyses["stability"]);
    if (!in_time.roots.is_null())
      results.analyses["stability"]["roots_beside_rail"] = in_time.roots;
    judge_reach_of_modes(all, results);
    say_coupled_damping(*prepared, results);
    if (loss)
      say_hysteretic_rests(parameters, results);
    else if (parameters.stability.is_reduced())
      say_residual_damping(parameters, *prepared, pair, frequencies_that_matter(all.front()), "stability",
                           results, parameters.stability.options().residual_rate);
    if (parameters.output.fields)
      write_unstable_shapes(all.front(), pair, bodies, folder);
  }

  namespace
  {
    void stability_read(EntriesRead &entries, const Parameters &parameters)
    {
      add_partners(entries, parameters, moving_in_contact());
      add_contacts(entries, parameters, parameters.rolling.sweep.friction);
      add_rolling_cases(entries, parameters);
      add_hub(entries, parameters);
      const std::string section = "Stability";
      const bool paper = !parameters.stability.is_consistent(), rolls = parameters.rolling.creepage.speed > 0,
                 plane = std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                     [](const BodyParameters &body) { return body.description->is_plane(); });
      const std::string by_paper = "Stability/Linearisation is paper", rolling = "Rolling/Speed is above 0",
                        across = "the bodies move across the slip";
      entries.add(section, "Model, Second count, Upper frequency");
      entries.add_if(parameters.stability.is_hysteretic(), "Stability/Loss is hysteretic", section, "Roots");
      entries.add_if(parameters.sweeps.at("stability").any(), "section Stability/Sweep sweeps an entry",
                     section, "Roots of a sweep");
      entries.add_if(std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                 [](const BodyParameters &body)
                                 {
                                   return body.is_periodic_rail() ||
                                          (body.is_meshed() &&
                                           (body.has_loss() || body.description->is_wheel()));
                                 }),
                     "a body of finite elements has a loss factor", section, "Loss");
      entries.add(section + "/Derivatives", "Entries");
      const DerivativeParameters &derivatives = parameters.stability.derivatives;
      entries.add_if(derivatives.any(), "Stability/Derivatives/Entries lists some", section + "/Derivatives",
                     "Standard deviations");
      entries.add_if(!derivatives.deviations.empty(), "Stability/Derivatives/Standard deviations is given",
                     section + "/Derivatives", "Draws");
      entries.add_if(derivatives.n_draws > 0, "Stability/Derivatives/Draws is above 0",
                     section + "/Derivatives", "Seed");
      entries.add_if(rolls || !plane, rolling + " or " + across, section, "Linearisation");
      entries.add_if(paper && !plane, by_paper + " and " + across, section, "Lateral damping");
      entries.add_if(paper && rolls, by_paper + " and " + rolling, section, "Convective slip");
      // without rolling all points slide
      entries.add_if(!paper && rolls, "Stability/Linearisation is consistent and " + rolling, section,
                     "Linearise sticking points");
      entries.add_if(parameters.stability.model == "finite elements", "Stability/Model is finite elements",
                     section, "Number of roots");
    }

  } // namespace

  Analysis stability_analysis()
  {
    return {{"stability",
             "complex eigenvalues about the rolling equilibrium: which modes squeal",
             2,
             true,
             true,
             "",
             {},
             "Stability",
             true},
            stability_read,
            [](const AnalysisRun &on)
            { run_stability(on.parameters, on.bodies, on.measured, on.folder, on.results); },
            false,
            {{"stability",
              "stability",
              stability_answer,
              {"stability.csv", "stability_map.csv", "stability_sweep.csv", "figures/divergence_rates.png",
               "figures/stability_map.png", "figures/unstable_shapes.png"}}},
            swept_stability,
            variations_of_roots};
  }
} // namespace vibrocontact

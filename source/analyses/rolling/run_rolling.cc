#include <vibrocontact/analyses/rolling/rolling_output.h>
#include <vibrocontact/analyses/rolling/rolling_scene.h>
#include <vibrocontact/analyses/rolling/run_rolling.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/contact/body_places.h>
#include <vibrocontact/contact/problem_file.h>
#include <vibrocontact/output/contact_patch.h>
#include <vibrocontact/output/field_writer.h>
#include <vibrocontact/output/surface_fields.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/prepare_pair.h>
#include <vibrocontact/run/swept_runs.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// contacts of fewer points than this are reported as coarse
    constexpr unsigned int coarse_below = 12;

    void write_case(const std::string &folder, const unsigned int k, const unsigned int n_cases,
                    const RollingResult &result, const ContactProblem &problem,
                    const PlacedContacts &contacts, const OutputParameters &output)
    {
      const std::string number = std::to_string(k);
      for (unsigned int c = 0; c < contacts.all.size() && output.writes_patch(k, n_cases); ++c)
      {
        const std::string name = with_contact("contact_patch", contacts.all[c]) + "_" + number;
        contact_patch_table(result, contacts, c).write(folder + "/" + name + ".csv");
        if (output.fields)
          write_contact_patch(result.solution, contacts, c, false, folder + "/fields/" + name + ".vtu");
      }
      if (output.contact_problems)
      {
        const std::string problems = folder + "/contact_problems";
        std::error_code ignored; // the file itself will say so
        std::filesystem::create_directories(problems, ignored);
        write_contact_problem(problems + "/case_" + number + ".h5", problem, result.solution);
      }
    }

    /// Says what is doubtful about case k, in the log and in the results.
    void judge(const RollingResult &result, const unsigned int k, nlohmann::ordered_json &one,
               Results &results)
    {
      std::ostringstream text;
      if (!result.solution.converged)
      {
        text << "Case " << k << " of quasi-static rolling did not converge: ";
        if (result.failure.empty())
          text << "residual " << result.solution.residual << " after " << result.solution.iterations
               << " iterations.";
        else
          text << result.failure;
        refuse(text.str(), results);
        return;
      }
      if (result.contact_points == 0)
        text << "Case " << k << ": the bodies do not touch.";
      else if (result.contact_points < coarse_below)
        text << "Case " << k << ": only " << result.contact_points
             << (result.contact_points == 1 ? " point touches" : " points touch")
             << ", too few for the numbers to mean much; give finer contact points or a larger load.";
      else
        return;
      one["warning"] = text.str();
      doubt(text.str(), results);
    }

    /// How far the forces of the equilibrium push the hub against its suspension, along x, y, z [m]; null: no spring.
    nlohmann::ordered_json deflection(const RollingResult &result, const SuspensionParameters &suspension)
    {
      const double force[] = {result.tangential_force[0], result.tangential_force[1], result.normal_force};
      nlohmann::ordered_json all = nlohmann::ordered_json::array();
      for (unsigned int d = 0; d < 3; ++d)
        all.push_back(suspension.stiffness[d] > 0 ? nlohmann::ordered_json(force[d] / suspension.stiffness[d])
                                                  : nlohmann::ordered_json());
      return all;
    }

    bool are_half_spaces(const Parameters &parameters)
    {
      const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
      return parameters.contacts.all.size() == 1 &&
             std::none_of(bodies.begin(), bodies.end(),
                          [](const BodyParameters &body) { return body.vibrates(); });
    }

    /// Whether cases are solved on two grids, as only half-spaces can be.
    bool takes_two_grids(const Parameters &parameters)
    {
      const bool half_spaces = are_half_spaces(parameters);
      if (parameters.rolling.grids == "two" && !half_spaces)
        throw InputError(
            "Entry Rolling/Grids is two, but the compliance of meshed bodies and of bodies known at "
            "their own points exists on one grid only: two half-spaces in one contact can be "
            "solved on two. Leave it out.");
      return half_spaces && parameters.rolling.two_grids();
    }

    void print(const RollingResult &last, const unsigned int n_cases)
    {
      Log &log = run_log();
      log.value("cases", n_cases);
      if (n_cases > 1)
      {
        const RollingCase &one = last.rolling_case;
        std::ostringstream text;
        text << "creepages " << one.creepage.longitudinal << ", " << one.creepage.lateral << ", spin "
             << one.creepage.spin << " 1/m, friction " << one.friction;
        log.value("the last of them", text.str());
      }
      log.value("normal force", last.normal_force, "N");
      log.value("tangential force x", last.tangential_force[0], "N");
      log.value("tangential force y", last.tangential_force[1], "N");
      if (last.force_error >= 0)
        log.value("stated error of the tangential force", last.force_error, "N");
      log.value("utilisation", last.utilisation);
      log.value("largest pressure", last.max_pressure * 1e-6, "MPa");
      log.value("approach", last.approach * 1e3, "mm");
      log.value("points in contact", last.contact_points);
      log.value("of these sticking", last.stick_points);
    }
  } // namespace

  RollingResult run_rolling(const Parameters &parameters, const MeshedBodies &bodies,
                            const std::optional<MeasuredData> &measured, const std::string &folder,
                            Results &results, const std::function<void()> &save)
  {
    const auto pair = prepare_pair(parameters, bodies, measured, parameters.replaces_flexibility());
    results.reductions = reductions_json(bodies);
    save();

    run_log().block("Quasi-static rolling");
    const RollingGrids grids = rolling_grids(pair->bodies, parameters.contacts, parameters.placed_contacts(),
                                             takes_two_grids(parameters));
    const PlacedContacts &contacts = grids.own.interface.contacts;
    run_log().value("contact points", contacts.n_points());
    if (grids.extrapolates)
      run_log().value("and on the coarser of two grids", grids.coarse->interface.contacts.n_points());
    const unsigned int n_cases = rolling_cases(parameters.rolling, parameters.contacts).size();
    Progress progress("rolling cases", n_cases);
    results.analyses["quasi_static_rolling"]["hub"] = parameters.hub();
    run_log().value("hub", hub_text(parameters.hub()));
    for (const PlacedContact &contact : contacts.all)
      if (!contact.name.empty())
        results.analyses["quasi_static_rolling"]["contacts"][contact.name]["cases"] =
            nlohmann::ordered_json::array();
    // nothing is added to the object beside it from here on
    nlohmann::ordered_json &cases = results.analyses["quasi_static_rolling"]["cases"];
    cases = nlohmann::ordered_json::array();
    const auto finished = [&](const RollingResult &result, const ContactProblem &problem)
    {
      const unsigned int k = cases.size();
      on_first_rank([&] { write_case(folder, k, n_cases, result, problem, contacts, parameters.output); });
      cases.push_back(rolling_case_json(result));
      for (unsigned int c = 0; c < contacts.all.size(); ++c)
        if (!contacts.all[c].name.empty())
          results.analyses["quasi_static_rolling"]["contacts"][contacts.all[c].name]["cases"].push_back(
              rolling_case_json(result, result.contacts[c]));
      if (hub_kind(parameters.hub()).has_unsprung_mass)
        cases.back()["suspension_deflection_m"] = deflection(result, parameters.rolling.suspension);
      judge(result, k, cases.back(), results);
      save();
      progress.advance();
    };
    const RollingResult last =
        quasi_static_rolling(parameters.rolling, parameters.contacts, parameters.contact_solver, grids,
                             finished, run_communicator())
            .back();
    on_first_rank(
        [&]
        {
          rolling_table(cases).write(folder + "/rolling.csv");
          for (const PlacedContact &contact : contacts.all)
          {
            const std::string name = with_contact("contact_patch", contact);
            std::vector<std::pair<double, std::string>> patches;
            for (unsigned int k = 0; k < n_cases; ++k)
              if (parameters.output.writes_patch(k, n_cases))
                patches.emplace_back(k, "fields/" + name + "_" + std::to_string(k) + ".vtu");
            if (parameters.output.fields && !patches.empty())
              write_pvd(patches, folder + "/" + name + ".pvd");
          }
        });
    print(last, n_cases);
    if (n_cases > 2 && !parameters.output.writes_patch(1, n_cases) &&
        parameters.output.contact_patches != "never")
      run_log().line("Of so many cases the first and the last contact patch are written; Output/Contact "
                     "patches = always writes all.");
    return last;
  }

  void write_deformation(const RollingResult &result, const Parameters &parameters,
                         const MeshedBodies &bodies, const std::string &folder)
  {
    const PlacedContacts contacts = parameters.placed_contacts();
    for (unsigned int k = 0; k < bodies.size(); ++k)
      if (bodies[k] && bodies[k]->parameters.is_solid())
      {
        const std::string &name = bodies[k]->parameters.name;
        run_log().block("Deformation of " + name);
        if (parameters.output.deformation != "always" && !bodies[k]->reduction.was_factorised())
        {
          run_log().line("The reduction came from the cache, so nothing is factorised; set "
                         "Output/Deformation = always to have the deformation all the same.");
          continue;
        }
        if (parameters.replaces_flexibility())
          run_log().line("It is that of the elements under these forces, not what Local flexibility or "
                         "Normal-tangential coupling make of the contact.");
        const PlacedContacts::Rows own = contacts.rows_of(k);
        DenseVector force(own.rows.size());
        for (unsigned int i = 0; i < own.rows.size(); ++i)
          force[i] = own.sign[i] * result.solution.R[own.rows[i]];
        dealii::PETScWrappers::MPI::Vector displacement;
        bodies[k]->reduction.flexibility().static_displacement(displacement, force);
        const bool follows_hub = k == 0 && bodies[k]->reduction.system().follows_hub;
        write_fields(bodies[k]->elastic_body(),
                     {{&displacement, 0., follows_hub ? -result.solution.approach : 0.}}, folder,
                     "deformation_" + name, places_of_bodies(contacts, bodies.size())[k]);
      }
  }

  namespace
  {
    void rolling_read(EntriesRead &entries, const Parameters &parameters)
    {
      BodyUse use;
      use.contact = use.loads = true;
      use.motion = parameters.replaces_flexibility();
      add_partners(entries, parameters, use);
      entries.add_if(are_half_spaces(parameters), "no body is meshed or known at its own points", "Rolling",
                     "Grids");
      add_contacts(entries, parameters, parameters.rolling.sweep.friction,
                   takes_two_grids(parameters) ? "Rolling/Grids is one" : "");
      add_rolling_cases(entries, parameters);
      entries.add("Output", "Contact problems, Contact patches");
      entries.add_if(parameters.output.fields &&
                         std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                     [](const BodyParameters &body) { return body.is_solid(); }),
                     "Output/Fields is true and a body is a solid of finite elements", "Output",
                     "Deformation");
    }

    void do_rolling(const AnalysisRun &on)
    {
      const OutputParameters &output = on.parameters.output;
      const RollingResult last =
          run_rolling(on.parameters, on.bodies, on.measured, on.folder, on.results, on.save_sometimes);
      if (output.fields && output.deformation != "never")
        write_deformation(last, on.parameters, on.bodies, on.folder);
    }

    /// Its cases have no deformation of the bodies, which is found by all ranks.
    PreparedRun prepare_rolling(const AnalysisRun &on)
    {
      reduce_bodies(on.bodies, on.parameters.replaces_flexibility());
      return [](const AnalysisRun &one)
      { run_rolling(one.parameters, one.bodies, one.measured, one.folder, one.results, one.save_sometimes); };
    }
  } // namespace

  Analysis rolling_analysis()
  {
    return {
        {"quasi-static rolling",
         "steady rolling contact of body 1 on body 2 with friction",
         2,
         true,
         false,
         "",
         {},
         "Rolling"},
        rolling_read,
        do_rolling,
        false,
        {{"quasi_static_rolling",
          "quasi-static rolling",
          rolling_answer,
          {"rolling.csv", "contact_patch_0.csv", "figures/contact_patch_0.png", "figures/creep_curves.png"}}},
        swept_runs(prepare_rolling,
                   {{"normal_force_N", "/quasi_static_rolling/cases/0/normal_force_N"},
                    {"tangential_force_x_N", "/quasi_static_rolling/cases/0/tangential_force_N/0"},
                    {"tangential_force_y_N", "/quasi_static_rolling/cases/0/tangential_force_N/1"},
                    {"force_error_N", "/quasi_static_rolling/cases/0/force_error_N"},
                    {"spin_moment_Nm", "/quasi_static_rolling/cases/0/spin_moment_Nm"},
                    {"spin_moment_error_Nm", "/quasi_static_rolling/cases/0/spin_moment_error_Nm"},
                    {"utilisation", "/quasi_static_rolling/cases/0/utilisation"},
                    {"approach_m", "/quasi_static_rolling/cases/0/approach_m"},
                    {"max_pressure_Pa", "/quasi_static_rolling/cases/0/max_pressure_Pa"},
                    {"contact_points", "/quasi_static_rolling/cases/0/contact_points"},
                    {"stick_points", "/quasi_static_rolling/cases/0/stick_points"}})};
  }
} // namespace vibrocontact

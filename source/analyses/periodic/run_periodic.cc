#include <vibrocontact/analyses/periodic/make_forced_body.h>
#include <vibrocontact/analyses/periodic/periodic_output.h>
#include <vibrocontact/analyses/periodic/response_output.h>
#include <vibrocontact/analyses/periodic/run_periodic.h>
#include <vibrocontact/analyses/periodic/run_response_curve.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/swept_runs.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/timer.h>

#include <optional>
#include <set>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// One solution, for further positions of the force in a cell its errors only.
    PeriodicCase solve(const PeriodicParameters &periodic, const ForcedBody &body,
                       const PointLaws<NormalLaw> &law, const std::string &law_name,
                       const BalanceSettings &settings, const unsigned int n_phases,
                       const std::optional<PeriodicReference> &reference)
    {
      PeriodicBalance balance(body, law, settings);
      PeriodicCase result{settings, law_name, {}, {}, {}, n_phases, 0, 0};
      std::vector<PeriodicErrors> errors;
      for (unsigned int k = 0; k < n_phases; ++k)
      {
        dealii::Timer timer;
        balance.set_force({periodic.force, periodic.frequency,
                           2 * dealii::numbers::PI * k / (double(n_phases) * settings.n_functions)});
        const PeriodicSolution solution = balance.solve();
        const double seconds = timer.wall_time();
        if (k == 0)
        {
          result.solution = solution;
          result.seconds = seconds;
        }
        if (!solution.converged)
        {
          ++result.failed_phases;
          continue;
        }
        const PeriodicMotion motion = sample_motion(balance, solution, periodic.n_output);
        if (reference)
          errors.push_back(errors_of(balance, solution, motion, *reference));
        if (k == 0)
          result.motion = motion;
      }
      if (!errors.empty())
        result.errors = median(errors);
      return result;
    }

    /// Of each contact point of a list of contacts, or one of all points.
    std::vector<double> friction_of_points(const Parameters &parameters)
    {
      std::vector<double> result;
      for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
        result.insert(result.end(),
                      parameters.scene.contacts.empty() ? 1 : parameters.contact_grid(k).n_points(),
                      parameters.contacts.all[k].friction);
      return result;
    }

    void tell(const ForcedBody &body)
    {
      Log &log = run_log();
      log.value(body.n_modes() > 0 ? "modes" : "poles", body.n_modes() + body.n_poles());
      if (body.n_modes() > 0)
        log.value("first frequency", body.omega[0] / (2 * dealii::numbers::PI), "Hz");
      log.value("contact points", body.n_points());
      log.value("residual flexibility of the first point", body.residual(0, 0), "m/N");
    }

    void tell(const PeriodicCase &solved)
    {
      Log &log = run_log();
      log.value("basis", solved.settings.trial + ":" + solved.settings.weighting + ", " +
                             std::to_string(solved.settings.n_functions) + " functions");
      log.value("Newton iterations", solved.solution.iterations);
      if (solved.solution.homotopy_steps > 0)
        log.value("steps of the gap", solved.solution.homotopy_steps);
      if (solved.solution.stiffness_steps > 0)
        log.value("steps of the law's stiffness", solved.solution.stiffness_steps);
      if (solved.solution.converged)
      {
        log.value("largest displacement", solved.motion.tip_max, "m");
        log.value(solved.motion.impulse.size() > 1 ? "impulse of a period, first point"
                                                   : "impulse of a period",
                  solved.motion.impulse[0], "N s");
      }
      if (solved.errors)
        log.value("relative error to shooting", solved.errors->displacement);
      if (solved.failed_phases > 0)
        log.value("positions of the force without solution", solved.failed_phases);
      log.value("time", solved.seconds * 1e3, "ms");
    }
  } // namespace

  void run_periodic(const Parameters &parameters, const ForcedBody &body, const std::string &folder,
                    Results &results)
  {
    const PeriodicParameters &periodic = parameters.periodic;
    run_log().block("Periodic motion");
    tell(body);
    const PointLaws<NormalLaw> law = parameters.periodic_laws();
    std::vector<std::string> laws;
    for (const ContactParameters &contact : parameters.contacts.all)
      laws.push_back(contact.normal_law);
    const std::string law_name = periodic.law_in_results(laws);
    for (unsigned int k = 0; k < laws.size(); ++k)
      run_log().value("normal law" +
                          std::string(laws.size() > 1 ? " of " + parameters.contacts.all[k].name : ""),
                      parameters.periodic_law(k)->description().name);
    bool is_rigid_at_mass = false;
    for (unsigned int p = 0, row = 0; p < body.n_points(); ++p, row += body.rows_per_point)
      is_rigid_at_mass = is_rigid_at_mass || (law[p].is_rigid() && !(body.residual(row, row) > 0));
    if (is_rigid_at_mass)
      doubt("The rigid stop meets a contact point with mass: its forces do not converge with the number of "
            "functions; give the body a massless contact node or keep fewer modes.",
            results);
    const std::vector<double> friction = friction_of_points(parameters);

    std::optional<PeriodicReference> reference;
    if (periodic.reference)
    {
      try
      {
        reference = periodic_reference(body, parameters.periodic_law(0), {periodic.force, periodic.frequency},
                                       periodic.n_output);
        run_log().value("reference by shooting", reference->solution.seconds * 1e3, "ms");
        run_log().value("its periodicity", reference->solution.periodicity);
      }
      catch (const ConvergenceError &error)
      {
        refuse(std::string("The reference in time: ") + error.what(), results);
      }
    }

    if (reference)
      on_first_rank([&] { write_reference_table(*reference, folder + "/periodic_reference.csv"); });
    if (!periodic.numbers.empty())
    {
      std::set<std::string> families;
      for (const auto &[trial, weighting] : periodic.parsed_pairs())
        families.insert({trial, weighting});
      on_first_rank(
          [&] {
            write_basis_table({families.begin(), families.end()}, *periodic.bases,
                              folder + "/time_bases.csv");
          });
    }

    nlohmann::ordered_json &json = results.analyses["periodic"] = nlohmann::ordered_json::array();
    Table table = periodic_error_table();
    const std::vector<BalanceSettings> asked = periodic.solutions(friction);
    Progress progress("periodic motions", asked.size());
    for (const BalanceSettings &settings : asked)
    {
      PeriodicCase solved;
      std::string reason = "choose another number of functions or another pair.";
      try
      {
        solved = solve(periodic, body, law, law_name, settings,
                       json.empty() || !reference ? 1 : periodic.n_phases, reference);
      }
      catch (const ConvergenceError &error)
      {
        solved.settings = settings;
        solved.law = law_name;
        solved.solution.excitation = {periodic.force, periodic.frequency};
        solved.failed_phases = solved.n_phases;
        reason = error.what();
      }
      if (!solved.solution.converged)
      {
        std::ostringstream text;
        text << "The periodic motion by " << settings.n_functions << " functions " << settings.trial << ":"
             << settings.weighting << " did not converge, its residual is " << solved.solution.residual
             << ": " << reason;
        refuse(text.str(), results);
      }
      tell(solved);
      if (solved.solution.converged)
        on_first_rank(
            [&]
            { write_periodic_table(solved, folder + "/periodic_" + std::to_string(json.size()) + ".csv"); });
      if (reference)
        add_line(table, solved);
      json.push_back(periodic_json(solved));
      if (!parameters.scene.contacts.empty() && solved.solution.converged)
        json.back()["contacts"] = contacts_json(parameters.placed_contacts(), solved.motion);
      progress.advance();
    }
    if (reference)
      on_first_rank([&] { table.write(folder + "/periodic_errors.csv"); });
    if (periodic.continuation.is_wanted())
      run_response_curve(periodic, body, law, law_name, friction, folder, results);
  }

  namespace
  {
    /// Rigid bodies whose curvature the points of a grid see.
    void add_stops(EntriesRead &entries, const Parameters &parameters)
    {
      const PlacedContacts contacts = parameters.placed_contacts();
      for (const PlacedContact &contact : contacts.all)
        for (const unsigned int b : {contact.above, contact.below})
          if (parameters.has_periodic_grid() && contact.grid.n_points() > 1 &&
              b < parameters.scene.bodies.size() && parameters.scene.bodies[b].description->is_rigid())
            add_body(entries, parameters, b, moving_in_contact());
    }

    void periodic_read(EntriesRead &entries, const Parameters &parameters)
    {
      const PeriodicParameters &own = parameters.periodic;
      const std::string section = "Periodic";
      const BodyParameters &body = parameters.scene.bodies[0];
      const bool listed = !parameters.scene.contacts.empty(), on_grid = own.contact_points.empty(),
                 rubs = parameters.largest_friction() > 0;
      for (const unsigned int b : parameters.vibrating_bodies())
      {
        BodyUse use = moving_in_contact();
        use.contact = listed || own.contact_points_on(b).empty();
        use.tangential = rubs;
        add_body(entries, parameters, b, use);
      }
      add_stops(entries, parameters);
      entries.add_if(body.rolls(), "the ring rolls", "Road", "Speed");
      if (parameters.has_contact())
        add_contact_grid(entries, parameters);
      for (const ContactParameters &contact : parameters.contacts.all)
      {
        add_friction_coefficient(entries, contact);
        entries.add_if(contact.friction > 0, "there is friction", contact.section, "Friction law");
        entries.add_if(own.law.empty(), "Periodic/Law is empty", contact.section, "Normal law");
        add_normal_law(entries, contact, own.law.empty() ? contact.normal_law : own.own_law(),
                       "the normal law of Periodic or " + contact.section);
      }
      entries.add(section, "Trial basis, Weighting basis, Number of functions, Form, Law, Frequency, Force, "
                           "Force point, Gap, Model, Samples, "
                           "Quadrature points, Reference, Output samples");
      const std::string by_grids = "the file has one section Contact, no list of Contacts";
      entries.add_if(!listed, by_grids, section, "Contact points");
      entries.add_if(!listed && parameters.vibrating_bodies().size() > 1, by_grids + ", and body 2 vibrates",
                     section, "Contact points on body 2");
      entries.add_if(
          !listed &&
              (!on_grid || own.stop_axis().first != 2 || !own.force_point.empty() || rubs || body.has_load()),
          by_grids +
              ", and there are Contact points, a Force point, friction or a load, which tell one side from "
              "the other",
          section, "Stop direction");
      entries.add(section + "/Comparison", "Numbers");
      entries.add_if(!own.numbers.empty(), "there are Periodic/Comparison/Numbers", section + "/Comparison",
                     "Pairs");
      entries.add_if(own.reference && !own.numbers.empty(),
                     "Periodic/Reference is true and there are Periodic/Comparison/Numbers",
                     section + "/Comparison", "Force phases");

      const BranchParameters &branch = own.continuation;
      const std::string continuation = section + "/Continuation",
                        followed = "Periodic/Continuation/Parameter is not none";
      const bool wanted = branch.is_wanted(), tells = branch.tells_stability();
      entries.add(continuation, "Parameter");
      entries.add_if(wanted, followed, continuation,
                     "First value, Last value, Start value, Scale, Largest step, Smallest step, Most points, "
                     "Location tolerance, Stability, Pairs");
      entries.add_if(wanted && !branch.parsed_pairs().empty(), "there are Periodic/Continuation/Pairs",
                     continuation, "Numbers");
      const bool by_samples = tells && rubs;
      entries.add_if(tells && !by_samples,
                     "Periodic/Continuation/Stability is not none and there is no friction", continuation,
                     "Mode limit");
      entries.add_if(tells && !by_samples && branch.stability == "hill",
                     "Periodic/Continuation/Stability is hill and there is no friction", continuation,
                     "Hill harmonics");
    }

    PreparedRun prepare_periodic(const AnalysisRun &on)
    {
      const auto body =
          std::make_shared<const ForcedBody>(forced_body(on.parameters, on.bodies, on.measured));
      return [body](const AnalysisRun &one) { run_periodic(one.parameters, *body, one.folder, one.results); };
    }
  } // namespace

  Analysis periodic_analysis()
  {
    return {{"periodic",
             "periodic motions of body 1 against a stop, by weighted residuals in time",
             1,
             false,
             false,
             "",
             {},
             "Periodic"},
            periodic_read,
            [](const AnalysisRun &on) { prepare_periodic(on)(on); },
            false,
            {{"periodic",
              "periodic",
              periodic_answer,
              {"periodic_0.csv", "periodic_errors.csv", "figures/periodic_motion.png"}},
             {"response", "response curve", response_answer, {"response.csv", "figures/response.png"}}},
            swept_runs(prepare_periodic, {{"tip_max_m", "/periodic/0/tip_max_m"},
                                          {"tip_min_m", "/periodic/0/tip_min_m"},
                                          {"impulse_Ns", "/periodic/0/impulse_Ns/0"},
                                          {"energy_norm_J", "/periodic/0/energy_norm_J"},
                                          {"newton_iterations", "/periodic/0/newton_iterations"},
                                          {"error_to_reference", "/periodic/0/error_to_reference"},
                                          {"largest_amplitude_m", "/response/largest_amplitude_m"},
                                          {"largest_at_Hz", "/response/largest_at_Hz"},
                                          {"response_points", "/response/points"}})};
  }
} // namespace vibrocontact

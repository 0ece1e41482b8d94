#include <vibrocontact/analyses/modal_convolution/judge_road_march.h>
#include <vibrocontact/analyses/modal_convolution/modal_convolution_output.h>
#include <vibrocontact/analyses/modal_convolution/run_method_comparison.h>
#include <vibrocontact/analyses/modal_convolution/run_modal_convolution.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/run_communicator.h>
#include <vibrocontact/marching/run_march.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/road_body.h>
#include <vibrocontact/run/say_residual_damping.h>
#include <vibrocontact/run/swept_runs.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    constexpr unsigned int most_point_tables = 10;
    constexpr unsigned long most_table_lines = 1000000, most_signal_lines = 1000000,
                            most_spectrum_lines = 20000000;

    void print(const ModalConvolutionParameters &parameters, const ModalConvolutionResult &result)
    {
      Log &log = run_log();
      const double steps = std::max(1ul, result.steps);
      log.value("steps", static_cast<unsigned long long>(result.steps));
      log.value("time", result.time, "s");
      log.value("per step", result.seconds / steps * 1e9, "ns");
      log.value("road, per step", result.road_seconds / steps * 1e9, "ns");
      log.value("computing per simulated second", (result.seconds + result.road_seconds) / result.time * 1e3,
                "ms");
      log.value("closed points on average", result.closed_points / steps);
      log.value("impacts", static_cast<unsigned long long>(result.impacts.size()));
      log.value("releases", static_cast<unsigned long long>(result.releases.size()));
      for (unsigned int i = 0; i < std::min<std::size_t>(result.impulse.size(), 3); ++i)
        log.value("impulse of point " + std::to_string(i), result.impulse[i], "N s");
      if (result.has_residual)
        log.value("contact residual", result.residual);
      if (parameters.friction)
      {
        log.value("sticking points on average", result.sticking_points / steps);
        log.value("friction", result.dissipation, "J");
      }
    }
  } // namespace

  void run_modal_convolution(const Parameters &parameters, const MeshedBodies &bodies,
                             const std::optional<MeasuredData> &measured, const std::string &folder,
                             const bool resume, Results &results)
  {
    const ModalConvolutionParameters &own = parameters.modal_convolution;
    const RoadBody body =
        road_body(parameters, bodies, measured, 0, {own.friction, parameters.road.speed, own.time_step});
    const BodyInContact poles = by_poles(body.body);
    run_log().block("Modal convolution");
    run_log().value("poles", poles.n_poles());
    const unsigned int n_points = body.places.size();
    run_log().value("contact points", n_points);
    run_log().value("method", own.method);
    const RoadParameters road_parameters = road_of(parameters, body);
    const bool by_force = !parameters.rolling.normal_force.empty();
    if (by_force)
    {
      run_log().value("load on a flat road", parameters.rolling.normal_force.front(), "N");
      run_log().value("indentation for it", road_parameters.indentation * 1e3, "mm");
    }
    if (parameters.comparison.any() && std::any_of(poles.poles.begin(), poles.poles.end(), is_rigid_motion))
      throw InputError("Comparison/Rows asks for a comparison with convolutions, which forget, but " +
                       parameters.scene.bodies[0].name +
                       " is free, and no force that has moved it may be forgotten: leave the rows out.");
    const Road road(road_parameters, body.places, body.shapes, own.end_time);
    own.signals.judge("Modal convolution", own.end_time, results);
    ModalConvolution motion(own, parameters.contact_solver, poles, road, road_laws(parameters));
    motion.at_open_sides = body.at_open_sides;

    const bool first = dealii::Utilities::MPI::this_mpi_process(run_communicator()) == 0;
    // a transient beside it has the short names
    const std::string prefix = parameters.scene.runs("transient") ? "modal_convolution_" : "",
                      histories = prefix + "histories";
    std::optional<ModalConvolutionHistory> history;
    Recorders recorders;
    if (first)
    {
      recorders.push_back(&history.emplace(own, n_points, folder + "/" + histories));
      motion.recorder = [&](const ModalConvolutionLines &lines) { history->add(lines); };
    }
    const MarchCheckpoint checkpoint = road_checkpoint(folder);
    if (resume)
      resume_march("modal convolution", motion, checkpoint, recorders);
    const bool is_whole =
        run_march("modal convolution", motion, checkpoint, own.checkpoint_interval, recorders, results);
    const ModalConvolutionResult &result = motion.result();
    nlohmann::ordered_json &json = results.analyses["modal_convolution"];
    json = modal_convolution_json(own, result);
    if (bodies[0] && parameters.scene.bodies[0].is_meshed())
    {
      ReducedBody reduced = bodies[0]->reduction.reduced(true);
      complete_reduction(reduced, parameters.scene.bodies[0],
                         parameters.modes.at(parameters.scene.bodies[0].name));
      reduced.relaxation = body.body.relaxation;
      say_residual_damping(parameters, {&reduced}, 0., {}, "modal_convolution", results);
    }
    json["histories"] = histories + ".h5";
    for (unsigned int k = 0; k < parameters.scene.contacts.size(); ++k)
      json["contacts"][parameters.scene.contacts[k]] =
          contact_json(parameters.placed_contacts(), k, result, own.friction);
    json["indentation_m"] = road_parameters.indentation;
    if (by_force)
      json["static_normal_force_N"] = parameters.rolling.normal_force.front();
    on_first_rank(
        [&]
        {
          const double lines = result.time / std::max(own.time_step, own.history_interval);
          if (n_points <= most_point_tables && lines <= most_table_lines)
            write_point_tables(folder + "/" + histories, n_points, own.friction, folder);
          write_impacts(result, folder);
          if (lines > most_signal_lines)
            run_log().line(
                "The histories have more than 1,000,000 lines, too many for spectra and growth rates of "
                "the forces" +
                std::string(lines > most_spectrum_lines ? ", and for 1/3-octave bands" : "") +
                ": give a longer Modal convolution/History interval.");
          if (lines > most_spectrum_lines)
            return;
          const std::vector<NamedSignal> forces = recorded_forces(own, result, folder + "/" + histories);
          if (lines <= most_signal_lines)
            json.update(signals_json(by_strength(forces), own.signals, result.time, ""));
          if (forces.empty())
            return;
          const std::string bands = prefix + "third_octaves.csv";
          write_third_octaves(forces[0].signal, folder + "/" + bands);
          json["third_octaves"] = bands;
        });
    take_from_first_rank(json);
    print(own, result);
    judge_road_march(own, motion, body.is_passive, is_whole, json, results);
    if (parameters.comparison.any() && is_whole && results.stopped_by == 0)
      json["method_comparison"] = run_method_comparison(parameters, bodies, measured, folder);
  }

  namespace
  {
    /// @param section Road of body 1 or of a further one
    void add_road(EntriesRead &entries, const std::string &section, const RoadParameters &road,
                  const bool rolls, const bool friction, const bool by_force = false)
    {
      const bool flat = !road.profile_entry().make;
      entries.add(section, "Profile, Expression, Table, Indentation");
      for (const RoadProfileEntry &row : road_profiles())
        if (!row.reads.empty())
          entries.add_if(road.profile == row.name, section + "/Profile is " + row.name, section, row.reads);
      entries.add_if(!flat || rolls, section + "/Profile is not flat", section, "Speed");
      entries.add_if(!flat, section + "/Profile is not flat", section, "Speed expression, Speed table");
      entries.add_if(!flat || road.indentation != 0 || by_force,
                     "there is a profile, an Indentation or a Rolling/Normal force", section, "Loading time");
      entries.add_if(friction, "Modal convolution/Friction is true", section, "Sliding speed");
    }

    void modal_convolution_read(EntriesRead &entries, const Parameters &parameters)
    {
      const ModalConvolutionParameters &own = parameters.modal_convolution;
      const std::string section = "Modal convolution";
      const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
      BodyUse use = moving_in_contact();
      use.tangential = own.friction;
      add_body(entries, parameters, 0, use);
      if (!bodies[0].is_green())
        add_contact_grid(entries, parameters);
      entries.add("Rolling", "Normal force");
      add_road(entries, "Road", parameters.road, bodies[0].rolls(), own.friction,
               !parameters.rolling.normal_force.empty());
      entries.add_if(own.friction && bodies[0].rolls(),
                     "Modal convolution/Friction is true and " + bodies[0].name + "/Ring/Rolling too",
                     "Contact", "Creep scheme");

      const bool steps = !own.is_event_located();
      entries.add(
          section,
          "Method, Time step, End time, Friction, History interval, Checkpoint interval, Error estimate");
      entries.add_if(steps, section + "/Method is no event located", section, "Force shape");
      const bool rigid =
          normal_law_of_points(parameters.contacts, parameters.placed_contacts()).all(&NormalLaw::is_rigid);
      const std::string laws = parameters.contact().section + "/Normal law";
      entries.add_if(steps && !own.friction && rigid,
                     section + "/Method is no event located, Friction is false and " + laws + " is signorini",
                     section, "Contact solver");
      entries.add_if(own.is_convolution(), section + "/Method is a convolution", section, "Memory");
      entries.add_if(own.takes_theta(), section + "/Method is theta method", section, "Theta");
      entries.add_if(bodies[0].has_load(), "body 1 stands under a load", section, "Initial state");
      for (const ContactParameters &contact : parameters.contacts.all)
      {
        entries.add_if(!own.is_event_located(), section + "/Method is no event located", contact.section,
                       "Normal law");
        add_normal_law(entries, contact, contact.normal_law, contact.section + "/Normal law");
        add_friction(entries, contact, own.friction, section + "/Friction is true");
      }
      for (unsigned int b = 1; b < bodies.size() && !parameters.scene.contacts.empty(); ++b)
        add_body(entries, parameters, b, use);
      add_contact_solver(entries, parameters,
                         own.friction || own.contact_solver == "common" || (steps && !rigid),
                         section + "/Contact solver is common");

      entries.add(section + "/Signals", "Spectrum duration, Growth begin, Growth end");
      const std::string comparison = section + "/Comparison";
      entries.add(comparison, "Rows");
      entries.add_if(parameters.comparison.any(), "there are rows of a comparison", comparison,
                     "Repetitions");
      for (unsigned int k = 1; k < bodies.size(); ++k)
      {
        const auto further = parameters.comparison.further_bodies.find(bodies[k].name);
        if (further == parameters.comparison.further_bodies.end())
          continue;
        const std::string of_body = comparison + "/" + bodies[k].name;
        entries.add(of_body, "Rows");
        if (further->second.rows.empty())
          continue;
        entries.add_if(bodies[k].description->may_yield(), "its points are not rigid", of_body,
                       "Force shape");
        add_body(entries, parameters, k, use);
        add_road(entries, of_body + "/Road", further->second.road, bodies[k].rolls(), own.friction);
      }
    }

    void do_modal_convolution(const AnalysisRun &on)
    {
      run_modal_convolution(on.parameters, on.bodies, on.measured, on.folder, on.resume, on.results);
    }

    PreparedRun prepare_modal_convolution(const AnalysisRun &on)
    {
      reduce_bodies({on.bodies[0]}, true);
      return do_modal_convolution;
    }
  } // namespace

  Analysis modal_convolution_analysis()
  {
    return {
        {"modal convolution",
         "a body known by its Green's functions rolls over a road in unilateral contact",
         1,
         true,
         true,
         "",
         {},
         "Modal convolution"},
        modal_convolution_read,
        do_modal_convolution,
        true,
        {{"modal_convolution",
          "modal convolution",
          modal_convolution_answer,
          {"modal_convolution_histories.h5", "histories.h5", "impacts.csv",
           "modal_convolution_third_octaves.csv", "third_octaves.csv", "figures/modal_convolution*.png"}}},
        swept_runs(prepare_modal_convolution,
                   {{"impulse_Ns", "/modal_convolution/impulse_Ns/0"},
                    {"largest_force_N", "/modal_convolution/largest_force_N"},
                    {"rms_force_N", "/modal_convolution/rms_force_N"},
                    {"closed_points_mean", "/modal_convolution/closed_points_mean"},
                    {"n_impacts", "/modal_convolution/n_impacts"},
                    {"input_J", "/modal_convolution/energy/input_J"},
                    {"friction_J", "/modal_convolution/energy/friction_J"},
                    {"estimated_error", "/modal_convolution/estimated_error"},
                    {"steps", "/modal_convolution/steps"},
                    {"time_s", "/modal_convolution/time_s"}})};
  }
} // namespace vibrocontact

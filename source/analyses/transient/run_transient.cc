#include <vibrocontact/analyses/transient/judge_transient.h>
#include <vibrocontact/analyses/transient/make_mode_recorder.h>
#include <vibrocontact/analyses/transient/patch_recorder.h>
#include <vibrocontact/analyses/transient/run_transient.h>
#include <vibrocontact/analyses/transient/signal_recorder.h>
#include <vibrocontact/analyses/transient/sound_recorder.h>
#include <vibrocontact/analyses/transient/transient_output.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/coupled_bodies/quasi_static_loading.h>
#include <vibrocontact/marching/drive.h>
#include <vibrocontact/marching/hub_motion.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/run_march.h>
#include <vibrocontact/marching/sound.h>
#include <vibrocontact/marching/transient_checkpoint.h>
#include <vibrocontact/marching/transient_march.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/run/check_transient.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/pair_in_time.h>
#include <vibrocontact/run/probes_on_bodies.h>
#include <vibrocontact/run/say_residual_damping.h>
#include <vibrocontact/run/swept_runs.h>
#include <vibrocontact/run/unreduced_pair.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    void print(const TransientResult &result)
    {
      Log &log = run_log();
      log.value("steps", static_cast<unsigned long long>(result.steps));
      log.value("time", result.time, "s");
      log.value("per step", result.seconds / std::max(1ul, result.steps) * 1e6, "us");
      if (result.time > 0)
        log.value("wall time over simulated time", result.seconds / result.time);
      log.value("solver iterations per step", result.iterations / std::max(1., double(result.steps)));
      if (result.rejected > 0)
        log.value("steps repeated with half their length", static_cast<unsigned long long>(result.rejected));
      log.value("normal impulse", result.impulse, "N s");
      log.value("energy stored at the end", result.energy.stored, "J");
      log.value("energy taken by differences", result.energy.numerical(), "J");
      log.value("energy imbalance", result.energy.imbalance(), "J");
    }

    ContactPair transient_pair(const Parameters &parameters, const MeshedBodies &bodies,
                               const std::optional<MeasuredData> &measured, std::vector<Probe> &probes,
                               PairInTime &prepared)
    {
      UnreducedPair unreduced;
      if (!parameters.transient.is_reduced())
        unreduced = prepare_unreduced_pair(parameters, bodies);
      probes = transient_probes(parameters, bodies, unreduced.surfaces);
      prepared = unreduced.prepared ? PairInTime{std::move(unreduced.prepared)}
                                    : prepare_pair_in_time(parameters, bodies, measured);
      ContactPair pair =
          contact_pair(prepared.prepared->bodies, parameters.contacts, parameters.placed_contacts());
      place_in_pair(parameters, pair, probes);
      return pair;
    }

    /// What follows the run, on rank 0.
    struct RunRecorders
    {
      std::vector<std::unique_ptr<StateRecorder>> all;
      /// the one that knows when sticking changed, those of sounds and modes, null: there is none
      const SignalRecorder *signals = nullptr;
      const SoundRecorder *sounds = nullptr;
      const ModeRecorder *modes = nullptr;
    };

    RunRecorders make_recorders(const Parameters &parameters, const ContactPair &held, const HubMotion &hub,
                                const PointLaws<NormalLaw> &law, const std::vector<Probe> &probes,
                                const std::string &folder, const std::vector<RecorderMaker> &further)
    {
      const ContactPair &pair = *hub.pair;
      const SignalParameters &signals = parameters.signals;
      RunRecorders result;
      auto &recorders = result.all;
      auto first = std::make_unique<SignalRecorder>(probes, folder);
      result.signals = first.get();
      recorders.push_back(std::move(first));
      if (signals.streams_sound())
      {
        auto sounds = std::make_unique<SoundRecorder>(probes, folder, parameters.transient.time_step,
                                                      signals.sound_full_scale);
        result.sounds = sounds.get();
        recorders.push_back(std::move(sounds));
      }
      if (auto modes = mode_recorder(parameters, held, hub, folder))
      {
        result.modes = modes.get();
        recorders.push_back(std::move(modes));
      }
      recorders.push_back(std::make_unique<TransientHistory>(pair, law, parameters.transient.history_interval,
                                                             probes, folder));
      if (signals.patch_interval > 0 && parameters.output.fields)
        recorders.push_back(std::make_unique<PatchRecorder>(pair.interface.contacts, signals.patch_begin,
                                                            signals.patch_interval, folder));
      for (const RecorderMaker &make : further)
        if (auto recorder = make({parameters, pair, law, folder}))
          recorders.push_back(std::move(recorder));
      return result;
    }

    /// After the recorders have finished, on rank 0: spectra, growth rates, sounds and the table.
    void evaluate_signals(const SignalParameters &parameters, const RunRecorders &recorders,
                          const std::vector<Probe> &probes, const PlacedContacts &contacts,
                          const std::string &folder, nlohmann::ordered_json &json)
    {
      const double end_of_growth = recorders.signals->change_of_sticking();
      const std::vector<NamedSignal> recorded = recorded_signals(probes, folder);
      json.update(signals_json(recorded, parameters.windows, end_of_growth,
                               parameters.sound && !recorders.sounds ? folder : ""));
      if (recorders.sounds)
        recorders.sounds->add_to(json["signals"]);
      for (const NamedSignal &signal : recorded)
        if (signal.name == "normal_force")
        {
          write_third_octaves(signal.signal, folder + "/third_octaves.csv");
          json["third_octaves"] = "third_octaves.csv";
        }
      if (recorders.modes)
      {
        json["mode_amplitudes"] = "mode_amplitudes.csv";
        json["modes"] = recorders.modes->json(
            parameters.windows.growth_begin,
            parameters.windows.growth_end > 0 ? parameters.windows.growth_end : end_of_growth);
      }
      const auto &signals = json["signals"];
      if (!signals.empty())
        json["contact_states"] =
            contact_states_json(folder, signals[0]["spectrum_window_s"][0].get<double>());
      if (parameters.table)
        write_history_table(probes, contacts, folder);
    }

    std::vector<double> dominant_frequencies(const nlohmann::ordered_json &json)
    {
      return json.value("dominant_frequencies_Hz", std::vector<double>());
    }

    /// The pair with what linear laws yield in its residual flexibility.
    ContactPair yielding(const Parameters &parameters, const ContactPair &pair)
    {
      const PointLaws<NormalLaw> law = normal_law_of_points(parameters.contacts, pair.interface.contacts);
      ContactPair result = pair;
      for (unsigned int i = 0; i < pair.n_points(); ++i)
        if (!law[i].is_rigid() && law[i].is_linear())
          result.residual(i, i) += law[i].compression(0).compliance;
      return result;
    }

    /// Goes through the history of section Loading. @throws ConvergenceError where it ends early
    LoadedState end_of_loading(const Parameters &parameters, const ContactPair &pair)
    {
      const LoadHistory history = parameters.loading.history();
      const unsigned int n_steps = history.steps.size();
      Progress progress("load steps before the march", n_steps);
      LoadingResult loading = quasi_static_loading(
          history, parameters.contacts, parameters.contact_solver, {loading_grid(pair), {}},
          [&](const unsigned int, const LoadedContact &) { progress.advance(); });
      if (!loading.failure.empty())
        throw ConvergenceError(
            "Step " + std::to_string(loading.steps_done + 1) + " of " + std::to_string(n_steps) +
            " of the quasi-static loading from which the transient starts: " + loading.failure);
      run_log().value("driving force along x, y after the loading",
                      number_text(loading.last.force[0]) + ", " + number_text(loading.last.force[1]) + " N");
      return loading.last;
    }

    void warn_of_ringing(const Parameters &all, const ContactPair &pair, Results &results)
    {
      const TransientParameters &parameters = all.transient;
      const bool massive = contact_points_have_mass(all);
      if (massive && parameters.starts_undeformed() &&
          (parameters.propagates_exactly() || parameters.theta < 0.55))
        doubt("The contact points have mass: after an impact "
              "velocities and forces there ring from step to step; the theta method with Theta = "
              "1 damps that, and every mode with it.",
              results);
      if (massive)
        return;
      if (!parameters.propagates_exactly() || pair.half_spaces)
        return;
      const double critical = critical_time_step(yielding(all, pair));
      if (parameters.time_step <= critical)
        return;
      std::ostringstream text;
      text << "Transient/Time step is " << parameters.time_step << " s, but beyond " << critical
           << " s reactions that are linear in the step ring: take a smaller one or the theta method.";
      doubt(text.str(), results);
    }
  } // namespace

  void run_transient(const Parameters &parameters, const MeshedBodies &bodies,
                     const std::optional<MeasuredData> &measured, const std::string &folder,
                     const bool resume, Results &results, const std::vector<RecorderMaker> &further)
  {
    const TransientParameters &own = parameters.transient;
    std::vector<Probe> probes;
    PairInTime prepared;
    const auto held =
        std::make_shared<const ContactPair>(transient_pair(parameters, bodies, measured, probes, prepared));
    run_log().block("Transient");
    run_log().value("modes", held->n_modes());
    run_log().value("contact points", held->n_points());
    const RollingCase constants = rolling_cases(parameters.rolling, parameters.contacts).front();
    const LoadOverTime load = load_over_time(own);
    const std::string applied_hub = transient_hub(parameters.hub(), load);
    std::optional<LoadedState> loaded;
    if (own.starts_from_loading())
      loaded = end_of_loading(parameters, *held);
    const HubMotion hub =
        hub_motion(applied_hub, parameters.rolling, load, parameters.contacts, parameters.contact_solver,
                   held, drive_function(own, constants, parameters.placed_contacts()),
                   loaded ? &*loaded : nullptr, own.release);
    run_log().value("hub", transient_hub_text(parameters.hub(), load));
    if (hub.place > 0)
    {
      run_log().value("displacement of the hub", hub.place * 1e3, "mm");
      run_log().value("normal force there", hub.normal_force, "N");
    }
    const ContactPair &pair = *hub.pair;
    const DriveFunction &drive = hub.drive;
    if (own.residual_theta < 1 && !pair.relaxing.empty())
      throw InputError(
          "Transient/Residual theta is below 1, but what the modes of " +
          parameters.scene.bodies[pair.relaxing.front().body - 1].name +
          " leave out follows forces with a delay: set it to 1, or take a body without its damping.");
    if (pair.hub)
    {
      for (Probe &probe : probes)
        probe.hang(*pair.hub);
      for (Probe &probe : hub_probes(parameters.scene.bodies[0].name, *pair.hub))
        probes.push_back(std::move(probe));
    }
    std::optional<Companion> companion;
    if (own.error_estimate)
      companion.emplace().drive =
          hub.driven(drive_function(with_doubled_step(own), constants, parameters.placed_contacts()));
    check_theta_keeps_mode(own, *held);
    warn_of_ringing(parameters, pair, results);
    parameters.signals.windows.judge("Transient", own.end_time, results);

    const PointLaws<NormalLaw> law = normal_law_of_points(parameters.contacts, held->interface.contacts);
    RunRecorders run_recorders;
    on_first_rank([&]
                  { run_recorders = make_recorders(parameters, *held, hub, law, probes, folder, further); });
    Recorders recorders;
    for (const auto &recorder : run_recorders.all)
      recorders.push_back(recorder.get());
    const TransientMarch::Observer record = [&](const DynamicState &now, const TransientResult &)
    {
      for (const auto &recorder : run_recorders.all)
        recorder->add(now);
      return true;
    };
    TransientMarch march(own, parameters.contacts, parameters.contact_solver, pair, drive, record,
                         companion ? &*companion : nullptr);
    const MarchCheckpoint checkpoint = transient_checkpoint(folder);
    if (!resume || !resume_march("transient", march, checkpoint, recorders))
    {
      march.state = initial_state(own, parameters.contacts, parameters.contact_solver, *held, hub);
      if (companion)
        companion->state = march.state;
      on_first_rank([&] { record(march.state, march.sums); });
    }
    run_march("transient", march, checkpoint, own.checkpoint_interval, recorders, results);
    const TransientResult &result = march.sums;
    const DynamicState &state = march.state;
    results.analyses["transient"] = transient_json(result, state, pair.interface.contacts);
    results.analyses["transient"]["friction"] = parameters.largest_friction();
    results.analyses["transient"]["loss"] = "viscous";
    results.analyses["transient"]["hub"] = applied_hub;
    if (!prepared.roots.is_null())
      results.analyses["transient"]["roots_beside_rail"] = prepared.roots;
    if (!prepared.wrong.empty())
      refuse(prepared.wrong, results);
    if (hub.place > 0)
      results.analyses["transient"]["hub_displacement_m"] = hub.place;
    const Creepage creepage = drive(state.time).creepage;
    results.analyses["transient"]["last"].update(
        {{"speed_m_s", creepage.speed},
         {"longitudinal_creepage", creepage.longitudinal},
         {"lateral_creepage", creepage.lateral},
         {"spin_1_m", creepage.spin},
         {"sliding_velocity_m_s", {creepage.sliding_x, creepage.sliding_y}},
         {"sliding_rotation_rad_s", creepage.sliding_rotation}});
    on_first_rank(
        [&]
        {
          evaluate_signals(parameters.signals, run_recorders, probes, pair.interface.contacts, folder,
                           results.analyses["transient"]);
        });
    take_from_first_rank(results.analyses["transient"]);
    print(result);
    say_coupled_damping(*prepared.prepared, results);
    say_residual_damping(parameters, *prepared.prepared, pair,
                         dominant_frequencies(results.analyses["transient"]), "transient", results);
    judge_transient(result, pair.omega, own.adapts_steps(), companion ? &companion->errors : nullptr,
                    results.stopped_by != 0, results);
  }

  namespace
  {
    void do_transient(const AnalysisRun &on)
    {
      run_transient(on.parameters, on.bodies, on.measured, on.folder, on.resume, on.results, on.recorders);
    }

    void transient_read(EntriesRead &entries, const Parameters &parameters)
    {
      add_motion_in_contact(entries, parameters);

      const TransientParameters &own = parameters.transient;
      const std::vector<std::string> driven = driven_entries(own);
      const bool rolls = parameters.rolling.creepage.speed > 0;
      const auto is_driven = [&](const std::string &name)
      { return std::count(driven.begin(), driven.end(), name) > 0; };
      for (const std::string name : {"Longitudinal creepage", "Lateral creepage", "Spin"})
      {
        entries.add_if(rolls && !is_driven(name),
                       "Rolling/Speed is above 0 and section Transient drives no " + name, "Rolling", name);
        entries.add_if(rolls, "Rolling/Speed is above 0", "Transient", name);
      }
      const bool loaded = is_driven("Normal force") || is_driven("Hub displacement");
      entries.add_if(!loaded && !own.starts_from_loading(),
                     "section Transient drives no load and does not start from section Loading", "Rolling",
                     "Normal force, Hub displacement");
      if (own.starts_from_loading())
        add_load_history(entries, parameters);
      entries.add_if(own.starts_from_loading(), "Transient/Initial state is quasi-static loading",
                     "Transient", "Release");
      const bool rubs = largest_friction_of_cases(parameters) > 0;
      entries.add("Rolling", "Speed");
      add_sliding(entries, parameters, rubs, "there is friction");

      const std::string section = "Transient";
      entries.add(section,
                  "Model, Time step, Error tolerance, End time, Integrator, Reaction, Initial state, "
                  "Perturbed mode, Normal force, Hub displacement, Exciting force, Drive table, "
                  "Error estimate, "
                  "History interval, Checkpoint interval");
      entries.add_if(own.adapts_steps(), "Transient/Error tolerance is above 0", section,
                     "Shortest time step");
      entries.add_if(!own.propagates_exactly(), "Transient/Integrator is theta method", section, "Theta");
      entries.add_if(rubs && own.is_reduced() && yields_beside_modes(parameters),
                     "there is friction, Transient/Model is reduced and a body yields at contact points "
                     "beside its modes",
                     section, "Residual theta");
      entries.add_if(own.starts_undeformed(), "Transient/Initial state is undeformed", section,
                     "Initial gap, Initial velocity");
      entries.add_if(!own.perturbed_mode.empty(), "there is a Transient/Perturbed mode", section,
                     "Perturbation, Perturbation velocity");
      entries.add(section + "/Roughness", "Expression, Table, Spectrum");
      entries.add_if(!own.roughness.spectrum.empty(), "there is a Transient/Roughness/Spectrum",
                     section + "/Roughness", "Seed");
      const SignalParameters &signals = parameters.signals;
      entries.add(section + "/Signals", "Probes, Table, Spectrum duration, Growth begin, Growth end");
      entries.add_if(parameters.output.fields, "Output/Fields is true", section + "/Signals",
                     "Patch interval");
      entries.add_if(parameters.output.fields && signals.patch_interval > 0,
                     "there is a Transient/Signals/Patch interval", section + "/Signals", "Patch begin");
      entries.add_if(!own.starts_undeformed() && !own.release && !contact_points_have_mass(parameters),
                     "the run starts from an equilibrium, with contact points without mass",
                     section + "/Signals", "Mode amplitudes");
      const bool has_wheel = std::any_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                                         [](const BodyParameters &body)
                                         { return body.description->is_wheel() && !body.rolls(); });
      const bool can_sound = !signals.probes.empty() && (trimmed(signals.probes) != "rim" || has_wheel) &&
                             own.end_time > least_sound;
      entries.add_if(can_sound,
                     "there are Transient/Signals/Probes (a rim is that of a wheel that does not roll) for "
                     "more than 5 ms",
                     section + "/Signals", "Sound");
      entries.add_if(can_sound && signals.sound,
                     "Transient/Signals/Sound is true and there are Probes for more than 5 ms",
                     section + "/Signals", "Sound full scale");
    }

    /// Bodies with their modes, and shapes where probes are, are made by all ranks.
    PreparedRun prepare_transient(const AnalysisRun &on)
    {
      request_probe_shapes(on.parameters, on.bodies);
      reduce_bodies(on.bodies, true);
      return do_transient;
    }
  } // namespace

  Analysis transient_analysis()
  {
    return {{"transient", "motion in time of body 1 on body 2", 2, true, true, "", {}, "Transient"},
            transient_read,
            do_transient,
            true,
            {{"transient",
              "transient",
              transient_answer,
              {"histories.h5", "figures/ring_down.png", "mode_amplitudes.csv", "figures/transient_*.png",
               "figures/mode_growth.png", "figures/spectrum_*.png", "third_octaves.csv", "*.wav"}}},
            swept_runs(prepare_transient, {{"impulse_Ns", "/transient/impulse_Ns"},
                                           {"rms_normal_force_N", "/transient/rms_normal_force_N"},
                                           {"last_normal_force_N", "/transient/last/normal_force_N"},
                                           {"smallest_gap_m", "/transient/smallest_gap_m"},
                                           {"dominant_frequency_Hz", "/transient/dominant_frequencies_Hz/0"},
                                           {"input_J", "/transient/energy/input_J"},
                                           {"friction_J", "/transient/energy/friction_J"},
                                           {"imbalance_J", "/transient/energy/imbalance_J"},
                                           {"estimated_error", "/transient/estimated_error"},
                                           {"steps", "/transient/steps"},
                                           {"time_s", "/transient/time_s"}})};
  }
} // namespace vibrocontact

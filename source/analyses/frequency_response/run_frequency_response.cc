#include <vibrocontact/analyses/frequency_response/body_response.h>
#include <vibrocontact/analyses/frequency_response/response_extrema.h>
#include <vibrocontact/analyses/frequency_response/run_frequency_response.h>
#include <vibrocontact/analyses/frequency_response/run_green_functions.h>
#include <vibrocontact/analyses/frequency_response/track_response.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/numerics/frequency_refinement.h>
#include <vibrocontact/run/entries_of_contact.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    /// to which magnitudes of extrema are found, in the logarithm: by modes, and where each frequency costs a factorisation
    constexpr double modal_accuracy = 2e-3, factorised_accuracy = 0.2;
    /// of modes whose resonance is computed; that of others is infinite
    constexpr double least_damping = 1e-6;

    /// The largest maxima and the smallest minima; all of them are in a table.
    void print_extrema(const nlohmann::ordered_json &extrema)
    {
      constexpr std::size_t most_said = 5;
      for (const char *kind : {"maxima", "minima"})
      {
        const bool maxima = kind[1] == 'a';
        auto all = extrema[kind].get<std::vector<nlohmann::ordered_json>>();
        const std::size_t said = std::min(all.size(), most_said);
        std::stable_sort(all.begin(), all.end(),
                         [sign = maxima ? 1. : -1.](const auto &a, const auto &b) {
                           return sign * a["magnitude"].template get<double>() >
                                  sign * b["magnitude"].template get<double>();
                         });
        for (std::size_t k = 0; k < said; ++k)
          run_log().line(all[k]["point"].get<std::string>() + (maxima ? ": maximum " : ": minimum ") +
                         number_text(all[k]["magnitude"].get<double>()) + " at " +
                         number_text(all[k]["frequency_Hz"].get<double>()) + " Hz");
        if (said < all.size())
          run_log().line("... and " + std::to_string(all.size() - said) + " more " + kind +
                         " in the table of extrema");
      }
    }

    Table extrema_table(const nlohmann::ordered_json &extrema, const FrequencyResponseParameters &parameters,
                        const std::string &body)
    {
      Table table({"point", "kind", "frequency_Hz", parameters.quantity + parameters.unit_ending()},
                  {"Maxima and minima of the driving points of " + body + " over frequency"});
      for (const char *kind : {"maxima", "minima"})
        for (const auto &one : extrema[kind])
          table.add_row({one["point"].get<std::string>(), std::string(kind[1] == 'a' ? "maximum" : "minimum"),
                         one["frequency_Hz"].get<double>(), one["magnitude"].get<double>()});
      return table;
    }

    /// Solved at the frequencies of the file, then at refined ones, a quarter of what is left at a time, so that each
    /// round sees where the one before has led.
    ResponseVariant refined_response(const FrequencyResponseParameters &parameters,
                                     const ResponseSolver &solve)
    {
      ResponseVariant result = solve(parameters.frequencies());
      unsigned int left = parameters.n_refined;
      while (left > 0)
      {
        const ResponseVariant more = solve(
            frequencies_between(result.frequency, result.response, std::max(left / 4, std::min(left, 4u))));
        if (more.frequency.empty())
          break;
        left -= more.frequency.size();
        insert(more, result);
      }
      if (left > 0)
        run_log().value("refined frequencies", std::to_string(parameters.n_refined - left) + " of " +
                                                   std::to_string(parameters.n_refined) +
                                                   " make the response smooth");
      return result;
    }

    /// Into the results of a body, its table and the screen.
    void add_extrema(const FrequencyResponseParameters &parameters, const ResponseVariant &variant,
                     const std::string &body, nlohmann::ordered_json &result,
                     const std::function<std::string(const Table &)> &write)
    {
      nlohmann::ordered_json extrema = {{"maxima", nlohmann::ordered_json::array()},
                                        {"minima", nlohmann::ordered_json::array()}};
      // what is not resolved is not extrapolated
      for (const ResponseExtremum &one : response_extrema(parameters, variant))
      {
        const bool resolved = one.is_resolved(factorised_accuracy);
        extrema[one.is_maximum ? "maxima" : "minima"].push_back(
            {{"point", one.point},
             {"frequency_Hz", resolved ? one.frequency : one.computed_frequency},
             {"magnitude", resolved ? one.magnitude : one.computed}});
      }
      result.update(extrema);
      result["extrema_table"] = write(extrema_table(extrema, parameters, body));
      print_extrema(extrema);
    }

    void print_checks(const nlohmann::ordered_json &checks)
    {
      for (const auto &one : checks)
        if (one["response"] == one["force"])
          run_log().line(
              one["response"].get<std::string>() + ", " + number_text(one["frequency_Hz"].get<double>()) +
              " Hz, " + one["method"].get<std::string>() + " with " +
              std::to_string(one["n_modes"].get<unsigned int>()) +
              " modes: " + number_text(100 * one["error"].get<double>()) + " % off, imaginary receptance " +
              number_text(100 * one.value("error_imaginary_receptance", 0.)) + " %");
    }

    /// @param speed of rolling, see BodyResponse
    nlohmann::ordered_json respond(MeshedBody &body, const FrequencyResponseParameters &parameters,
                                   const double speed, const std::string &folder,
                                   nlohmann::ordered_json &tables)
    {
      const std::string &name = body.parameters.name;
      run_log().block("Frequency response of " + name);
      BodyResponse response(body, parameters, speed);
      const double rotation = response.rotation();
      if (rotation != 0)
        run_log().value("turns past its points",
                        number_text(rotation) + " rad/s, at Rolling/Speed " + number_text(speed) + " m/s");
      const bool is_modal = parameters.method == "modal";
      if (is_modal)
        response.check_count();
      const auto write = [&](const Table &table, const std::string &suffix)
      {
        const std::string file = "frequency_response_" + name + suffix + ".csv";
        on_first_rank([&] { table.write(folder + "/" + file); });
        tables.push_back(file);
        return file;
      };
      const auto solve = [&](const std::vector<double> &frequency)
      { return is_modal ? response.modal("hysteretic", 0, frequency) : response.direct(frequency); };
      const ResponseVariant main = refined_response(parameters, solve);
      nlohmann::ordered_json result = {{"method", main.method},
                                       {"n_modes", main.n_modes},
                                       {"table", write(response_table(parameters, main, name), "")}};
      if (rotation != 0)
        result.update({{"speed_m_s", speed}, {"rotation_rad_s", rotation}});
      // by modes a frequency more costs next to nothing
      std::vector<double> natural_frequencies;
      if (is_modal)
      {
        const auto &modes = body.reduction.modal();
        for (std::size_t k = 0; k < modes.damping_ratio.size(); ++k)
          if (modes.damping_ratio[k] > least_damping)
            natural_frequencies.push_back(modes.omega[k] / (2 * dealii::numbers::PI));
      }
      add_extrema(parameters,
                  with_resolved_extrema(parameters, main, natural_frequencies,
                                        is_modal ? modal_accuracy : factorised_accuracy, solve),
                  name, result, [&](const Table &table) { return write(table, "_extrema"); });
      const bool has_modes = body.reduction.request().modes.any();
      if (has_modes)
      {
        const ResponseVariant in_time = response.modal("time domain", 0, main.frequency);
        result["time_domain_table"] = write(response_table(parameters, in_time, name), "_time_domain");
        result["time_domain_difference"] = difference_json(parameters, main, in_time);
        for (const auto &one : result["time_domain_difference"])
          run_log().line("damping of a run in time, " + one["response"].get<std::string>() + " under " +
                         one["force"].get<std::string>() + ": median difference " +
                         number_text(100 * one["median"].get<double>()) + " %, largest " +
                         number_text(100 * one["largest"].get<double>()) + " % at " +
                         number_text(one["frequency_Hz"].get<double>()) + " Hz");
      }
      const std::vector<double> &check = parameters.check_frequencies;
      if (check.empty())
        return result;
      std::vector<ResponseVariant> variants = {response.direct(check)};
      std::vector<double> cuts = parameters.cut_frequencies;
      cuts.insert(cuts.begin(), 0.);
      for (const double cut : cuts)
        for (const char *method : {"hysteretic", "time domain"})
          if (has_modes)
            variants.push_back(response.modal(method, cut, check));
      result["check_table"] = write(check_table(parameters, variants, name), "_check");
      result["checks"] = checks_json(parameters, variants);
      print_checks(result["checks"]);
      return result;
    }

    nlohmann::ordered_json respond_track(const BodyParameters &body, const RailParameters &rail,
                                         const FrequencyResponseParameters &parameters,
                                         const std::string &folder, nlohmann::ordered_json &tables)
    {
      run_log().block("Frequency response of the periodic track " + body.name);
      TrackResponse response(body, rail, parameters);
      const PeriodicTrack &track = response.rail_track().track;
      run_log().value("dofs of the section", response.rail_track().n_section_dofs());
      run_log().value("shapes of the section", track.section.matrices.n_shapes());
      const auto write = [&](const Table &table, const std::string &kind, const std::string &suffix = "")
      {
        const std::string file = kind + "_" + body.name + suffix + ".csv";
        on_first_rank([&] { table.write(folder + "/" + file); });
        tables.push_back(file);
        return file;
      };
      const auto solve = [&](const std::vector<double> &frequency) { return response.direct(frequency); };
      const ResponseVariant main = refined_response(parameters, solve);
      nlohmann::ordered_json result = {
          {"method", main.method},
          {"section_dofs", response.rail_track().n_section_dofs()},
          {"section_shapes", track.section.matrices.n_shapes()},
          {"table", write(response_table(parameters, main, body.name), "frequency_response")}};
      add_extrema(parameters, with_resolved_extrema(parameters, main, {}, factorised_accuracy, solve),
                  body.name, result,
                  [&](const Table &table) { return write(table, "frequency_response", "_extrema"); });
      result["decay_rates_table"] = write(response.decay_rates(body.name), "decay_rates");
      result["decay_rate_bands_table"] = write(response.decay_rate_bands(body.name), "decay_rate_bands");
      if (response.is_irregular())
        result["irregular_track_table"] = write(response.beside_regular(body.name), "irregular_track");
      if (parameters.pass_bands)
        result["pass_bands_table"] = write(response.pass_bands(body.name), "pass_bands");
      result["free_waves_table"] = write(response.free_waves(body.name), "free_waves");
      return result;
    }
  } // namespace

  void run_frequency_response(const Parameters &parameters, const MeshedBodies &bodies,
                              const std::optional<MeasuredData> &measured, const std::string &folder,
                              Results &results)
  {
    const FrequencyResponseParameters &own = parameters.frequency_response;
    nlohmann::ordered_json tables = nlohmann::ordered_json::array(), all = nlohmann::ordered_json::object();
    for (unsigned int k = 0; k < bodies.size(); ++k)
    {
      const BodyParameters &body = parameters.scene.bodies[k];
      if (!own.asks_for(body.name))
        continue;
      if (bodies[k])
        all[body.name] = respond(*bodies[k], own, parameters.rolling.creepage.speed, folder, tables);
      else if (body.is_green())
        all[body.name] = run_green_functions(parameters, measured, body, folder, tables);
      else if (const RailParameters *const rail = body.description->periodic_rail())
        all[body.name] = respond_track(body, *rail, own, folder, tables);
    }
    results.analyses["frequency_response"] = {{"quantity", own.quantity},
                                              {"load_length_m", own.load_length},
                                              {"load_width_m", own.load_width},
                                              {"tables", tables},
                                              {"bodies", all}};
  }

  void check_response_points(const Parameters &parameters, const MeshedBodies &bodies)
  {
    const FrequencyResponseParameters &own = parameters.frequency_response;
    for (const auto &body : bodies)
      if (body && own.asks_for(body->parameters.name))
        BodyResponse::check_points(*body, own);
    for (const BodyParameters &body : parameters.scene.bodies)
      if (const RailParameters *const rail = body.description->periodic_rail())
        if (own.asks_for(body.name))
          check_track_points(body, *rail, own);
  }

  namespace
  {
    void frequency_response_read(EntriesRead &entries, const Parameters &parameters)
    {
      const FrequencyResponseParameters &own = parameters.frequency_response;
      const std::string section = "Frequency response";
      bool meshed = false, track = false, green = false, ring = false, rolls = false, tangential = false,
           turns = false;
      for (unsigned int k = 0; k < parameters.scene.bodies.size(); ++k)
      {
        const BodyParameters &body = parameters.scene.bodies[k];
        if (!own.asks_for(body.name))
          continue;
        BodyUse use;
        use.motion = use.loss = use.points = true;
        if (body.is_meshed())
        {
          meshed = true;
          turns = turns || (body.is_revolved() && body.rolls());
        }
        else if (body.description->periodic_rail())
          track = true;
        else if (body.is_green())
        {
          green = true;
          const PointBody *const points = body.description->at_points();
          const bool in_orders = points && points->orders();
          ring = ring || in_orders;
          rolls = rolls || body.rolls();
          // the points of a ring are those of its contact
          use.contact = in_orders;
          use.tangential = tangential = own.tangential;
        }
        else
          continue;
        add_body(entries, parameters, k, use);
      }
      entries.add(section, "Bodies, Quantity, Method, Frequencies");
      entries.add_if(own.list.empty(), section + "/Frequencies is empty", section,
                     "First frequency, Last frequency, Number of frequencies, Spacing");
      entries.add_if(meshed || track, "a body has a mesh", section,
                     "Points, Load length, Load width, Refined frequencies");
      entries.add_if(meshed, "a body has modes", section, "Check frequencies, Cut frequencies");
      entries.add_if(track, "a rail is periodic", section, "Pass bands");
      entries.add_if(green, "a body is given by its Green's functions", section, "Impulse response time");
      entries.add_if(green && own.impulse_time > 0, section + "/Impulse response time is above 0", section,
                     "Impulse response step");
      entries.add_if(ring, "a body is an analytic ring", section, "Tangential, Truncated orders");
      entries.add_if(rolls, "a ring is Rolling", "Road", "Speed");
      entries.add_if(turns, "a wheel has Rotation", "Rolling", "Speed");
      add_lateral_position(entries, parameters);
    }
  } // namespace

  Analysis frequency_response_analysis()
  {
    return {{"frequency response",
             "point and transfer mobilities of meshed bodies, with hysteretic loss, and of bodies known by "
             "their Green's functions",
             1},
            frequency_response_read,
            [](const AnalysisRun &on)
            { run_frequency_response(on.parameters, on.bodies, on.measured, on.folder, on.results); },
            false,
            {{"frequency_response",
              "frequency response",
              frequency_response_answer,
              {"frequency_response_*.csv", "figures/frequency_response*.png"}}}};
  }
} // namespace vibrocontact

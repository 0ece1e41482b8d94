#include <vibrocontact/analyses/pole_file.h>
#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/frequency_csv.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/uff58.h>
#include <vibrocontact/bodies/band_limited.h>
#include <vibrocontact/output/identification_output.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/run_identification.h>
#include <vibrocontact/run/verdict.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    bool goes_both_ways(const FrequencyData &names)
    {
      return names.entries.size() == names.labels.size() * names.labels.size() && names.labels.size() > 1;
    }
  } // namespace

  namespace
  {
    std::string missed_target(const Identification &one, const IdentificationParameters &own)
    {
      return "Identification/Target error " + number_text(own.target_error) + " is not reached by " +
             one.method + " with up to " + std::to_string(own.largest) +
             " pole pairs; the best fit has E = " + number_text(one.worst()) + " with " +
             std::to_string(one.n_asked) + ".";
    }

    void print(const Identification &one)
    {
      run_log().line(one.method + ", " + number_text(one.fit.n_pairs()) + " pole pairs: E = " +
                     number_text(one.worst()) + " (worst entry), " + time_text(one.seconds));
      if (one.fit.n_unstable() > 0)
        run_log().warning(std::to_string(one.fit.n_unstable()) + " poles are unstable.");
      if (!one.fit.converged)
        run_log().warning("The poles still move after the last relocation: E may fall with more Iterations.");
      if (one.passivity_refused())
        run_log().warning(
            "This model gives energy to a force (up to " + percent_text(one.passivity.gain_before, 2) +
            " of |G|), and a passive one would " +
            (one.passivity.is_passive()
                 ? "differ from it by " + percent_text(one.passivity.change, 2) + " of the rms receptance"
                 : "not be found") +
            ": contact refuses it; ask for more pole pairs or a narrower band.");
      else if (one.passivity.n_rounds > 0)
        run_log().line("  made passive: changed by " + percent_text(one.passivity.change, 2) +
                       " of the rms receptance, gained up to " + percent_text(one.passivity.gain_before, 2) +
                       " of |G|");
      if (!one.checked)
        return;
      if (one.repaired)
        run_log().line(
            "  repaired for contact: E was " +
            number_text(*std::max_element(one.errors_before_repair.begin(), one.errors_before_repair.end())) +
            " before");
      if (!one.well_posedness.usable())
        run_log().warning("This model cannot be used in contact" +
                          std::string(one.repair_failed ? ", its repair was tried and failed" : "") + ": " +
                          one.well_posedness.reason() + ".");
      else if (!one.well_posedness.impacts)
        run_log().line("  g(0+) is " + number_text(one.well_posedness.initial_value) +
                       " of the largest g: for rigid contact with impacts set Impose zero initial value");
    }
  } // namespace

  void run_identification(const Parameters &parameters, const MeasuredData &measured,
                          const std::string &folder, Results &results)
  {
    const IdentificationParameters &own = parameters.identification;
    run_log().block("Identification");
    const FrequencyData &data = measured.data;
    run_log().value("points", (unsigned int)(data.labels.size()));
    run_log().value("frequencies", (unsigned int)(data.frequency.size()));
    if (data.n_skipped > 0)
      run_log().value("functions left aside, neither frequency nor impulse responses", data.n_skipped);
    const DataJudgement &judgement = measured.judgement;
    run_log().value("lines on which forces gain energy", 100 * judgement.gaining, "%");
    if (!judgement.complaint.empty())
      run_log().warning("The data " + judgement.complaint + ".");
    const std::vector<Identification> fits = identify(own, data, print);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (unsigned int k = 0; k < fits.size(); ++k)
    {
      if (!fits[k].target_reached)
        refuse("identification", missed_target(fits[k], own), results);
      nlohmann::ordered_json one = identification_json(fits[k], data);
      const std::string number = "_" + std::to_string(k);
      one["poles"] = "identification_poles" + number + ".csv";
      one["fit"] = "identification_fit" + number + ".csv";
      one["fit_uff"] = "identification_fit" + number + ".uff";
      one["data"] = "identification_data.csv";
      one["data_gaining_share"] = judgement.gaining;
      if (judgement.delay)
        one["data_delay"] = {{"estimate_s", judgement.delay->delay},
                             {"error", judgement.delay->error},
                             {"error_without", judgement.delay->error_without},
                             {"removed_s", own.delay}};
      if (k == 0 && own.chart)
        one["chart"] = "identification_chart.csv";
      list.push_back(one);
    }
    std::vector<ChartPole> chart;
    if (own.chart)
    {
      const unsigned int last =
          own.target_error > 0 ? own.largest : *std::max_element(own.pairs.begin(), own.pairs.end());
      Progress progress("stabilisation chart", double(last) * last / 2);
      chart = stabilisation_chart(own, data, [&](const unsigned int n) { progress.advance(2 * n); });
    }
    on_first_rank(
        [&]
        {
          write_file(
              folder + "/identification_data.csv",
              frequency_csv(data,
                            {"Receptances identified, from " + data.file_name,
                             "displacement of the first point under a unit force e^{+j w t} at the second"}));
          for (unsigned int k = 0; k < fits.size(); ++k)
          {
            const FrequencyData fit = fitted_data(fits[k], data);
            const std::string title =
                "Fit of " + std::to_string(fits[k].n_asked) + " pole pairs by " + fits[k].method;
            poles_table(fits[k].fit, data, "Poles of " + data.file_name + " by " + fits[k].method)
                .write(folder + "/" + list[k]["poles"].get<std::string>());
            write_file(folder + "/" + list[k]["fit"].get<std::string>(), frequency_csv(fit, {title}));
            write_file(folder + "/" + list[k]["fit_uff"].get<std::string>(), uff58_text(fit, title, true));
          }
          if (own.chart)
            chart_table(chart).write(folder + "/identification_chart.csv");
        });
    results.analyses["identification"] = list;
  }

  IdentifiedPoles identified_poles(const Parameters &parameters, const std::optional<MeasuredData> &measured,
                                   const BodyParameters &body, const double contact_step)
  {
    if (body.identified.inverse_transform)
      throw InputError(body.name +
                       "/Identified/Inverse transform is true, which knows no poles: leave it out.");
    if (!body.identified.poles_file.empty())
    {
      const PoleFile file = pole_file(body);
      return {file.names.labels, goes_both_ways(file.names),
              identified_model(file.fit, entry_map(file.names), parameters.identification.tolerance).model};
    }
    const FrequencyData &data = measured.value().data;
    IdentificationParameters first = parameters.identification;
    first.methods = first.method_list().front();
    first.pairs = {first.pairs.front()};
    first.contact_step = contact_step;
    const Identification one = identify(first, data, print).front();
    if (!one.target_reached)
      run_log().warning(missed_target(one, first));
    if (one.passivity_refused())
      throw InputError("The body " + body.name + " cannot be used: the model fitted by " + one.method +
                       " with " + std::to_string(one.n_asked) + " pole pairs gives energy to forces and " +
                       (one.passivity.is_passive()
                            ? "would have to change by " +
                                  number_text(std::round(1e3 * one.passivity.change) / 10) +
                                  " % of the rms receptance not to"
                            : "no passive one was found near it") +
                       ": ask for more in Identification/Numbers of pole pairs, choose a band or set Enforce "
                       "passivity = false.");
    return {data.labels, first.rolling, one.identified.model};
  }

  namespace
  {
    BodyInContact transformed_body(const Parameters &parameters, const FrequencyData &data,
                                   const BodyParameters &body)
    {
      const ModalConvolutionParameters &run = parameters.modal_convolution;
      const double remembered = run.memory > 0 ? std::min(run.memory, run.end_time) : run.end_time,
                   longest = band_limited_memory(spectra(data));
      if (run.method != "direct convolution" && run.method != "block convolution")
        throw InputError(body.name + "/Identified/Inverse transform is true, which knows no poles: set Modal "
                                     "convolution/Method to direct convolution or block convolution.");
      if (remembered > longest * (1 + 1e-9))
        throw InputError(body.name + "/Identified/Inverse transform has Green's functions of " +
                         number_text(longest) +
                         " s (half of 1 / the data's frequency step): set Modal "
                         "convolution/Memory to that, or to less.");
      return band_limited_model(spectra(data), entry_map(data));
    }
  } // namespace

  BodyInContact identified_body(const Parameters &parameters, const std::optional<MeasuredData> &measured,
                                const BodyParameters &body, const double contact_step)
  {
    const double tread = body.identified.tread_stiffness > 0 ? 1 / body.identified.tread_stiffness : 0;
    BodyInContact model =
        body.identified.inverse_transform
            ? transformed_body(parameters, measured.value().data, body)
            : identified_poles(parameters, measured, body, tread > 0 ? 0 : contact_step).poles;
    for (unsigned int i = 0; i < model.n_rows(); ++i)
      model.residual(i, i) += tread;
    // statics have no step
    if (contact_step > 0)
      check_well_posedness(model, contact_step, body.name);
    return model;
  }

  namespace
  {
    void identification_read(EntriesRead &entries, const Parameters &parameters)
    {
      const std::string section = "Identification";
      entries.add(section, "Data file, Rolling data, Lower frequency, Upper frequency, Delay, "
                           "Passive data, Enforce passivity, Method, Target error, Direct term, "
                           "Impose zero initial value, Contact time step, Residue tolerance, "
                           "Stabilisation chart");
      add_pole_numbers(entries, parameters.identification, true, "poles are fitted");
      entries.add_if(parameters.identification.contact_step > 0, section + "/Contact time step is above 0",
                     section, "Repair for contact");
    }
  } // namespace

  Analysis identification_analysis()
  {
    return {{"identification", "poles of a body known by measured or computed Green's functions", 1},
            identification_read,
            [](const AnalysisRun &on)
            { run_identification(on.parameters, on.measured.value(), on.folder, on.results); },
            false,
            {{"identification",
              "identification",
              identification_answer,
              {"identification_poles_0.csv", "identification_fit_0.csv", "figures/identification.png"}}}};
  }
} // namespace vibrocontact

#include <vibrocontact/analyses/identification/identification_output.h>
#include <vibrocontact/analyses/identification/run_identification.h>
#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/output/verdict.h>
#include <vibrocontact/receptances/frequency_csv.h>
#include <vibrocontact/receptances/uff58.h>
#include <vibrocontact/run/entries_of_contact.h>
#include <vibrocontact/run/identified_body.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// Refuses where none of some fits follows the data: noise has no poles.
    void check_best(const std::vector<Identification> &fits, Results &results)
    {
      const auto best = std::min_element(fits.begin(), fits.end(),
                                         [](const Identification &a, const Identification &b)
                                         { return a.worst() < b.worst(); });
      if (best == fits.end() ||
          std::any_of(fits.begin(), fits.end(), [](const Identification &one) { return one.follows_data(); }))
        return;
      const std::string missed = "No model follows the data: the best, by " + best->method + " with " +
                                 std::to_string(best->n_asked) +
                                 " pole pairs, misses E = " + number_text(best->worst()) +
                                 " of the worst entry";
      if (best->worst() < misses_most)
        refuse(missed + ", and that many pairs would leave only " + number_text(best->error_of_noise) +
                   " of noise; ask for fewer in Identification/Numbers of pole pairs, or give more lines.",
               results);
      else
        refuse(missed + "; they are noise, or need more in Identification/Numbers of pole pairs or a "
                        "narrower band.",
               results);
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
    if (data.n_without_blow > 0)
      run_log().value("impulse responses taken as band-limited, without a blow at t = 0",
                      data.n_without_blow);
    const DataJudgement &judgement = measured.judgement;
    run_log().value("lines on which forces gain energy", 100 * judgement.gaining, "%");
    if (!judgement.complaint.empty())
      doubt("The data " + judgement.complaint + ".", results);
    const std::vector<Identification> fits = identify(own, data, print_fit);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (unsigned int k = 0; k < fits.size(); ++k)
    {
      if (!fits[k].target_reached)
        refuse(missed_target(fits[k], own), results);
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
    check_best(fits, results);
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

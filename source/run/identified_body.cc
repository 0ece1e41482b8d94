#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/bodies/band_limited.h>
#include <vibrocontact/propagators/well_posedness.h>
#include <vibrocontact/receptances/pole_file.h>
#include <vibrocontact/run/identified_body.h>
#include <vibrocontact/scene/identified.h>

#include <algorithm>
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

  std::string missed_target(const Identification &one, const IdentificationParameters &own)
  {
    return "Identification/Target error " + number_text(own.target_error) + " is not reached by " +
           one.method + " with up to " + std::to_string(one.most_tried) + " pole pairs" +
           (one.most_tried < own.largest ? ", which the data determine at most" : "") +
           "; the best fit has E = " + number_text(one.worst()) + " with " + std::to_string(one.n_asked) +
           ".";
  }

  void print_fit(const Identification &one)
  {
    run_log().line(
        one.method + ", " + number_text(one.fit.n_pairs()) + " pole pairs" +
        (one.fit.n_pairs() < one.n_asked
             ? " (of " + std::to_string(one.n_asked) + " asked, others are unstable or belong to no motion)"
             : std::string()) +
        ": E = " + number_text(one.worst()) + " (worst entry), " + time_text(one.seconds));
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

  IdentifiedPoles identified_poles(const Parameters &parameters, const std::optional<MeasuredData> &measured,
                                   const BodyParameters &body, const double contact_step)
  {
    if (body.description->measured()->inverse_transform)
      throw InputError(body.name +
                       "/Identified/Inverse transform is true, which knows no poles: leave it out.");
    if (!body.description->measured()->poles_file.empty())
    {
      const PoleFile file = pole_file(body);
      return {file.names.labels, goes_both_ways(file.names),
              identified_model(file.fit, entry_map(file.names), parameters.identification.tolerance).model};
    }
    const FrequencyData &data = measured.value().data;
    IdentificationParameters first = parameters.identification;
    first.methods = first.method_list().front().name;
    first.pairs = {first.pairs.front()};
    first.contact_step = contact_step;
    const Identification one = identify(first, data, print_fit).front();
    if (!one.target_reached)
      throw InputError("The body " + body.name + " cannot be used: " + missed_target(one, first) +
                       " Raise Target error or Largest number of pole pairs, or choose a narrower band.");
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
    constexpr double doubtful_error = 0.1;
    if (one.worst() > doubtful_error)
      run_log().warning("The model of " + body.name + " misses its data by E = " + number_text(one.worst()) +
                        " (" + one.method + ", " + std::to_string(one.n_asked) +
                        " pole pairs), and so may forces in contact: ask for more in "
                        "Identification/Numbers of pole pairs, or for another band.");
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
    const double tread = body.description->tread_compliance(false);
    BodyInContact model =
        body.description->measured()->inverse_transform
            ? transformed_body(parameters, measured.value().data, body)
            : identified_poles(parameters, measured, body, tread > 0 ? 0 : contact_step).poles;
    for (unsigned int i = 0; i < model.n_rows(); ++i)
      model.residual(i, i) += tread;
    // statics have no step
    if (contact_step > 0)
      check_well_posedness(model, contact_step, body.name);
    return model;
  }
} // namespace vibrocontact

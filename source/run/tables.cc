#include <vibrocontact/analyses/export/run_export.h>
#include <vibrocontact/analyses/frequency_response/run_frequency_response.h>
#include <vibrocontact/analyses/identification/run_identification.h>
#include <vibrocontact/analyses/limit_cycle/run_limit_cycle.h>
#include <vibrocontact/analyses/loading/run_loading.h>
#include <vibrocontact/analyses/modal_convolution/run_modal_convolution.h>
#include <vibrocontact/analyses/modes/run_modes.h>
#include <vibrocontact/analyses/periodic/run_periodic.h>
#include <vibrocontact/analyses/rolling/run_rolling.h>
#include <vibrocontact/analyses/stability/run_stability.h>
#include <vibrocontact/analyses/transient/run_transient.h>
#include <vibrocontact/run/entries_of_bodies.h>
#include <vibrocontact/run/tables.h>

#include <algorithm>

namespace vibrocontact
{
  Tables standard_tables()
  {
    Tables tables;
    tables.analyses = {modes_analysis(),          frequency_response_analysis(),
                       identification_analysis(), rolling_analysis(),
                       loading_analysis(),        periodic_analysis(),
                       stability_analysis(),      transient_analysis(),
                       limit_cycle_analysis(),    modal_convolution_analysis(),
                       export_analysis()};
    return tables;
  }

  std::vector<AnalysisType> Tables::analysis_types() const
  {
    std::vector<AnalysisType> types;
    for (const Analysis &analysis : analyses)
      types.push_back(analysis.type);
    return types;
  }

  EntriesRead entries_read(const std::vector<Analysis> &analyses, const std::string &analysis,
                           const Parameters &parameters)
  {
    EntriesRead entries;
    // lists and names; where results go and what is drawn of them
    entries.add("", "Title, Bodies, Contacts, Analyses");
    entries.add("Output", "Directory, Cache directory, Fields, Figures");
    for (const BodyParameters &body : parameters.scene.bodies)
      entries.add(body.name, "Type");
    const auto known = std::find_if(analyses.begin(), analyses.end(),
                                    [&](const Analysis &one) { return one.type.name == analysis; });
    AssertThrow(known != analyses.end(), dealii::ExcMessage("unknown analysis " + analysis));
    if (known->type.make_parameters)
      add_all_entries(entries, known->type.section, *known->type.make_parameters());
    if (!known->type.sweep_section.empty())
      entries.add(known->type.sweep_section + "/Sweep", ParameterSweep::names);
    known->reads(entries, parameters);
    return entries;
  }
} // namespace vibrocontact

#include <vibrocontact/run/analyses.h>
#include <vibrocontact/run/run_frequency_response.h>
#include <vibrocontact/run/run_identification.h>
#include <vibrocontact/run/run_modal_convolution.h>
#include <vibrocontact/run/run_modes.h>
#include <vibrocontact/run/run_periodic.h>
#include <vibrocontact/run/run_rolling.h>
#include <vibrocontact/run/run_stability.h>
#include <vibrocontact/run/run_transient.h>

#include <algorithm>

namespace vibrocontact
{
  const std::vector<Analysis> &analyses()
  {
    static const std::vector<Analysis> table = {modes_analysis(),          frequency_response_analysis(),
                                                identification_analysis(), rolling_analysis(),
                                                periodic_analysis(),       stability_analysis(),
                                                transient_analysis(),      modal_convolution_analysis()};
    return table;
  }

  std::vector<AnalysisType> analysis_types()
  {
    std::vector<AnalysisType> types;
    for (const Analysis &analysis : analyses())
      types.push_back(analysis.type);
    return types;
  }

  EntriesRead entries_read(const std::string &analysis, const Parameters &parameters)
  {
    EntriesRead entries;
    // lists and names; where results go and what is drawn of them
    entries.add("", "Title, Bodies, Analyses");
    entries.add("Output", "Directory, Cache directory, Fields, Figures");
    for (const BodyParameters &body : parameters.scene.bodies)
      entries.add(body.name, "Type");
    const auto known = std::find_if(analyses().begin(), analyses().end(),
                                    [&](const Analysis &one) { return one.type.name == analysis; });
    AssertThrow(known != analyses().end(), dealii::ExcMessage("unknown analysis " + analysis));
    known->reads(entries, parameters);
    return entries;
  }
} // namespace vibrocontact

#include "readers.h"

#include <vibrocontact/run/parameters.h>
#include <vibrocontact/run/tables.h>

using namespace vibrocontact;

void readers::parameter_file(const std::string &bytes)
{
  static const Tables tables = standard_tables();
  static const auto entries = std::make_shared<const EntryTables>(tables);
  static const std::vector<AnalysisType> analyses = tables.analysis_types();
  taken(
      [&]
      {
        ParameterFile file("case.prm", bytes);
        Parameters parameters;
        dealii::ParameterHandler prm;
        read_parameters(file, prm, parameters, analyses, entries);
      });
}

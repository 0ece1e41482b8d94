#include "readers.h"

#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/receptances/frequency_file.h>
#include <vibrocontact/receptances/pole_file.h>

using namespace vibrocontact;

void readers::csv(const std::string &bytes)
{
  CsvTable table;
  if (!taken([&] { table = read_csv("table.csv", bytes); }))
    return;
  taken([&] { read_poles(table); });
  for (const bool rolling : {false, true})
    taken([&] { read_frequency_data("table.csv", bytes, {rolling, 0, 0, 0}); });
}

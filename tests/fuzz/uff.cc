#include "readers.h"

#include <vibrocontact/receptances/frequency_file.h>
#include <vibrocontact/receptances/uff58.h>

using namespace vibrocontact;

void readers::uff(const std::string &bytes)
{
  for (const bool rolling : {false, true})
  {
    FrequencyData data;
    if (taken([&] { data = read_frequency_data("data.uff", bytes, {rolling, 0, 0, 0}); }))
      // what was read can be written
      for (const bool binary : {false, true})
        uff58_text(data, "again", binary);
  }
}

#include "readers.h"

#include <vibrocontact/scene/drawn_section.h>
#include <vibrocontact/scene/outline_check.h>

using namespace vibrocontact;

void readers::outline(const std::string &bytes)
{
  for (const char *const name : {"outline.txt", "outline.csv"})
  {
    const std::string file = file_of(name, bytes);
    SectionOutline outline;
    if (!taken([&] { outline = SectionOutline::read(file); }))
      continue;
    taken([&] { check_outline(outline, {"tread", "flange", "bore"}, file, 1); });
    for (const bool mirrored : {false, true})
      taken([&] { closed_loops(outline, mirrored, file); });
    outline.find({outline.rows.front().start, outline.rows.front().end});
  }
}

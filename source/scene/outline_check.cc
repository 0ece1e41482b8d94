#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/outline_check.h>

#include <algorithm>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// largest extent of a section that is taken for one [m]
    constexpr double smallest = 0.01, largest = 10;

    void check_parts(const SectionOutline &outline, std::vector<std::string> known, const std::string &file)
    {
      for (const char *const name : {"surface", "joint"})
        known.emplace_back(name);
      for (const SectionOutline::Row &row : outline.rows)
        if (std::find(known.begin(), known.end(), row.part) == known.end())
          throw InputError("Line " + std::to_string(row.line) + " of the section outline " + file +
                           " names the part \"" + row.part +
                           "\", which nothing knows: " + name_suggestion(row.part, known));
    }

    void check_size(const SectionOutline &outline, const std::string &file, const double scale)
    {
      Point<2> low = outline.rows.front().start, high = low;
      for (const SectionOutline::Row &row : outline.rows)
        for (const Point<2> &end : {row.start, row.end})
          for (unsigned int d = 0; d < 2; ++d)
          {
            low[d] = std::min(low[d], end[d]);
            high[d] = std::max(high[d], end[d]);
          }
      const double extent = std::max(high[0] - low[0], high[1] - low[1]) / scale;
      if (extent < smallest || extent > largest)
        throw InputError("The section outline " + file + " is " + number_text(1e3 * extent) +
                         " mm large, which is no wheel or rail: its lengths are read in mm.");
    }
  } // namespace

  void check_outline(const SectionOutline &outline, const std::vector<std::string> &parts,
                     const std::string &file, const double scale)
  {
    check_parts(outline, parts, file);
    check_size(outline, file, scale);
  }
} // namespace vibrocontact

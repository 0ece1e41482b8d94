#include <vibrocontact/base/entries_read.h>
#include <vibrocontact/base/parameter_text.h>

#include <algorithm>

namespace vibrocontact
{
  void EntriesRead::add(const std::string &section, const std::string &names)
  {
    add_if(true, "", section, names);
  }

  void EntriesRead::add_if(const bool holds, const std::string &condition, const std::string &section,
                           const std::string &names)
  {
    for (const std::string &name : split_list(names))
      rows.push_back({joined_path(section, name), holds, condition});
  }

  bool EntriesRead::contains(const std::string &path) const
  {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const Row &row) { return row.is_read && row.path == path; });
  }

  std::string EntriesRead::condition(const std::string &path) const
  {
    std::string text;
    for (const Row &row : rows)
      if (!row.is_read && row.path == path && text.find(row.condition) == std::string::npos)
        text += (text.empty() ? "" : ", or ") + row.condition;
    return text;
  }
} // namespace vibrocontact

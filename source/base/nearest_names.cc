#include <vibrocontact/base/nearest_names.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace vibrocontact
{
  unsigned int edit_distance(const std::string &a, const std::string &b)
  {
    const auto same = [&](const std::size_t i, const std::size_t j) {
      return std::tolower(static_cast<unsigned char>(a[i])) == std::tolower(static_cast<unsigned char>(b[j]));
    };
    std::vector<std::vector<unsigned int>> d(a.size() + 1, std::vector<unsigned int>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
      for (std::size_t j = 0; j <= b.size(); ++j)
        if (i == 0 || j == 0)
          d[i][j] = i + j;
        else
        {
          d[i][j] =
              std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(i - 1, j - 1) ? 0u : 1u)});
          if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1))
            d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
  }

  std::vector<std::string> nearest_names(const std::string &name, const std::vector<std::string> &candidates)
  {
    std::vector<std::pair<unsigned int, std::string>> near;
    for (const auto &candidate : candidates)
    {
      const unsigned int distance = edit_distance(name, candidate);
      if (3 * distance <= std::max<std::size_t>(name.size(), 4) + 1)
        near.emplace_back(distance, candidate);
    }
    std::stable_sort(near.begin(), near.end(),
                     [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (const auto &[distance, candidate] : near)
      if (names.size() < 3 && distance <= near.front().first + 1)
        names.push_back(candidate);
    return names;
  }

  std::string quoted_list(const std::vector<std::string> &names, const std::string &last_word)
  {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
      text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " " + last_word + " ") + ('"' + names[i] + '"');
    return text;
  }

  std::string name_suggestion(const std::string &name, const std::vector<std::string> &candidates)
  {
    const std::vector<std::string> near = nearest_names(name, candidates);
    if (!near.empty())
      return "did you mean " + quoted_list(near) + "?";
    if (candidates.empty())
      return "none is valid here";
    if (candidates.size() <= 12)
      return "valid " + std::string(candidates.size() == 1 ? "is " : "are ") + quoted_list(candidates, "and");
    return "valid are " + quoted_list({candidates.begin(), candidates.begin() + 12}, "and") +
           ", among others";
  }
} // namespace vibrocontact

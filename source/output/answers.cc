#include <vibrocontact/output/answer_parts.h>
#include <vibrocontact/output/answers.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    using Lines = std::vector<std::string>;

    /// Those there of a name with at most one *.
    Lines matching(const std::string &folder, const std::string &name)
    {
      namespace fs = std::filesystem;
      const std::size_t star = name.find('*');
      if (star == std::string::npos)
        return fs::exists(fs::path(folder) / name) ? Lines{name} : Lines{};
      Lines found;
      const fs::path parent = fs::path(name).parent_path();
      const std::string head = name.substr(0, star), tail = name.substr(star + 1);
      std::error_code none;
      for (const auto &entry : fs::directory_iterator(folder / parent, none))
      {
        const std::string one = (parent / entry.path().filename()).string();
        if (one.size() >= head.size() + tail.size() && one.compare(0, head.size(), head) == 0 &&
            one.compare(one.size() - tail.size(), tail.size(), tail) == 0)
          found.push_back(one);
      }
      std::sort(found.begin(), found.end());
      return found;
    }

    std::string look_at(const std::string &folder, const std::vector<std::string> &files)
    {
      std::string line;
      std::size_t n = 0;
      for (const std::string &name : files)
        for (const std::string &file : matching(folder, name))
          if (++n <= answer_parts::most_said)
            line += (line.empty() ? "look at " : ", ") + file;
      return line;
    }
  } // namespace

  std::vector<Answer> answers(const std::vector<AnswerKind> &kinds, const nlohmann::ordered_json &analyses,
                              const std::string &folder)
  {
    std::vector<Answer> result;
    for (const AnswerKind &kind : kinds)
    {
      if (!analyses.contains(kind.key) || analyses[kind.key].empty())
        continue;
      Answer answer{kind.analysis, kind.answer(analyses[kind.key])};
      if (answer.lines.empty())
        continue;
      if (const std::string files = look_at(folder, kind.files); !files.empty())
        answer.lines.push_back(files);
      result.push_back(std::move(answer));
    }
    return result;
  }

  nlohmann::ordered_json answers_json(const std::vector<Answer> &answers)
  {
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    for (const Answer &one : answers)
      result[one.analysis] = one.lines;
    return result;
  }
} // namespace vibrocontact

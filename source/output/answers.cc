#include <vibrocontact/output/answer_parts.h>
#include <vibrocontact/output/answers.h>
#include <vibrocontact/output/frequency_response_output.h>
#include <vibrocontact/output/identification_output.h>
#include <vibrocontact/output/modal_convolution_output.h>
#include <vibrocontact/output/modal_output.h>
#include <vibrocontact/output/periodic_output.h>
#include <vibrocontact/output/response_output.h>
#include <vibrocontact/output/rolling_output.h>
#include <vibrocontact/output/stability_output.h>
#include <vibrocontact/output/transient_output.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    using Lines = std::vector<std::string>;

    struct Kind
    {
      const char *key, *analysis;
      Lines (*answer)(const nlohmann::ordered_json &);
      /// where to look next
      std::vector<std::string> files;
    };

    const std::vector<Kind> kinds = {
        {"modes", "modes", modes_answer, {"modes_*.csv", "figures/mode_shapes_*.png"}},
        {"frequency_response",
         "frequency response",
         frequency_response_answer,
         {"frequency_response_*.csv", "figures/frequency_response*.png"}},
        {"quasi_static_rolling",
         "quasi-static rolling",
         rolling_answer,
         {"rolling.csv", "contact_patch_0.csv", "figures/contact_patch_0.png", "figures/creep_curves.png"}},
        {"identification",
         "identification",
         identification_answer,
         {"identification_poles_0.csv", "identification_fit_0.csv", "figures/identification.png"}},
        {"periodic",
         "periodic",
         periodic_answer,
         {"periodic_0.csv", "periodic_errors.csv", "figures/periodic_motion.png"}},
        {"response", "response curve", response_answer, {"response.csv", "figures/response.png"}},
        {"stability",
         "stability",
         stability_answer,
         {"stability.csv", "stability_map.csv", "stability_sweep.csv", "figures/divergence_rates.png",
          "figures/stability_map.png", "figures/unstable_shapes.png"}},
        {"transient",
         "transient",
         transient_answer,
         {"histories.h5", "mode_amplitudes.csv", "figures/transient_*.png", "figures/mode_growth.png",
          "figures/spectrum_*.png", "*.wav"}},
        {"modal_convolution",
         "modal convolution",
         modal_convolution_answer,
         {"histories.h5", "impacts.csv", "third_octaves.csv", "figures/modal_convolution*.png"}}};

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

  std::vector<Answer> answers(const nlohmann::ordered_json &analyses, const std::string &folder)
  {
    std::vector<Answer> result;
    for (const Kind &kind : kinds)
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

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/scene/cad_faces.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  double CadPart::size() const
  {
    Point<3> low, high;
    for (unsigned int d = 0; d < 3; ++d)
    {
      low[d] = 1e300;
      high[d] = -1e300;
      for (const CadFace &face : faces)
      {
        low[d] = std::min(low[d], face.low[d]);
        high[d] = std::max(high[d], face.high[d]);
      }
    }
    return faces.empty() ? 0 : low.distance(high);
  }

  namespace
  {
    using Holds = std::function<bool(const CadFace &, double)>;

    std::string in_brackets(const Point<3> &p)
    {
      // without the round-off of a zero
      const auto text = [](const double value) { return number_text(std::round(1e9 * value) / 1e9 + 0.); };
      return "(" + text(p[0]) + ", " + text(p[1]) + ", " + text(p[2]) + ")";
    }

    /// Words of an item behind its kind.
    class Words
    {
    public:
      Words(const std::string &text, const std::string &item, const std::string &entry)
          : text(text), item(item), entry(entry)
      {
        std::string spaced = text;
        for (char &c : spaced)
          if (c == '=' || c == ',')
            c = ' ';
        std::istringstream stream(spaced);
        for (std::string word; stream >> word;)
          words.push_back(word);
      }

      [[noreturn]] void refuse(const std::string &wanted) const
      {
        throw InputError(entry + " has \"" + item + "\": " + wanted);
      }

      bool empty() const { return at == words.size(); }
      std::string next() { return empty() ? "" : words[at++]; }
      /// All of them as they are written, for an item that is one text.
      std::string whole()
      {
        at = words.size();
        return text;
      }

      double number(const std::string &wanted)
      {
        const std::optional<double> value = finite_number(next());
        if (!value)
          refuse(wanted);
        return *value;
      }

      unsigned int axis(const std::string &wanted)
      {
        const std::string word = next();
        if (word.size() != 1 || word[0] < 'x' || word[0] > 'z')
          refuse(wanted);
        return word[0] - 'x';
      }

    private:
      std::string text, item, entry;
      std::vector<std::string> words;
      std::size_t at = 0;
    };

    bool is_along(const Tensor<1, 3> &direction, const unsigned int axis)
    {
      return std::abs(std::abs(direction[axis]) - 1) < 1e-8;
    }

    Holds read_numbers(Words &words)
    {
      const std::string wanted = "write number 5, or number 5 7, numbers of faces.";
      std::vector<unsigned int> all;
      do
      {
        const double value = words.number(wanted);
        if (value < 1 || value > 1e9 || value != std::floor(value))
          words.refuse(wanted);
        all.push_back(value);
      } while (!words.empty());
      return [all](const CadFace &face, double)
      { return std::count(all.begin(), all.end(), face.number) > 0; };
    }

    Holds read_plane(Words &words)
    {
      const std::string wanted = "write plane z = 0.01, an axis and a place on it.";
      const unsigned int axis = words.axis(wanted);
      const double place = words.number(wanted);
      return [axis, place](const CadFace &face, const double tolerance)
      {
        return face.is_plane() && is_along(face.direction, axis) &&
               std::abs(face.place[axis] - place) < tolerance;
      };
    }

    Holds read_cylinder(Words &words)
    {
      const std::string wanted = "write cylinder z 0.005, an axis and a radius, or cylinder z 0.005 at 0 0.1 "
                                 "with the two other coordinates of its axis.";
      const unsigned int axis = words.axis(wanted);
      const double radius = words.number(wanted);
      std::vector<double> at;
      if (!words.empty())
      {
        if (words.next() != "at")
          words.refuse(wanted);
        at = {words.number(wanted), words.number(wanted)};
      }
      return [axis, radius, at](const CadFace &face, const double tolerance)
      {
        if (!face.is_cylinder() || !is_along(face.direction, axis) ||
            std::abs(face.radius - radius) > tolerance)
          return false;
        for (unsigned int d = 0, k = 0; d < 3 && !at.empty(); ++d)
          if (d != axis && std::abs(face.place[d] - at[k++]) > tolerance)
            return false;
        return true;
      };
    }

    Holds read_box(Words &words)
    {
      const std::string wanted = "write box x0 y0 z0 x1 y1 z1, its lower corner and its upper one.";
      Point<3> low, high;
      for (unsigned int d = 0; d < 3; ++d)
        low[d] = words.number(wanted);
      for (unsigned int d = 0; d < 3; ++d)
      {
        high[d] = words.number(wanted);
        if (!(high[d] >= low[d]))
          words.refuse(wanted);
      }
      return [low, high](const CadFace &face, const double tolerance)
      {
        for (unsigned int d = 0; d < 3; ++d)
          if (face.low[d] < low[d] - tolerance || face.high[d] > high[d] + tolerance)
            return false;
        return true;
      };
    }

    const std::string wanted_item =
        "write group: number 5, plane z = 0, cylinder z 0.01, box x0 y0 z0 x1 y1 z1 or "
        "name text, items separated by semicolons.";

    Holds read_name(Words &words)
    {
      const std::string name = words.whole();
      if (name.empty())
        words.refuse(wanted_item);
      return [name](const CadFace &face, double) { return face.name == name; };
    }

    struct Kind
    {
      std::string word;
      Holds (*read)(Words &);
      /// whether " of SOLID" may follow; names of faces may hold that word
      bool takes_solid = true;
    };

    FaceRule rule_of(const std::string &item, const std::string &entry)
    {
      static const std::vector<Kind> kinds = {{"number", read_numbers},
                                              {"plane", read_plane},
                                              {"cylinder", read_cylinder},
                                              {"box", read_box},
                                              {"name", read_name, false}};
      const std::size_t colon = item.find(':');
      FaceRule rule;
      rule.group = trimmed(item.substr(0, colon));
      rule.text = colon == std::string::npos ? "" : trimmed(item.substr(colon + 1));
      const std::string word = rule.text.substr(0, rule.text.find_first_of(" ="));
      const std::string rest = trimmed(rule.text.substr(word.size()));
      const auto kind =
          std::find_if(kinds.begin(), kinds.end(), [&](const Kind &one) { return one.word == word; });
      const std::size_t of = kind != kinds.end() && kind->takes_solid ? rest.find(" of ") : std::string::npos;
      const std::string solid = of == std::string::npos ? "" : trimmed(rest.substr(of + 4));
      Words words(rest.substr(0, of), item, entry);
      if (rule.group.empty() || kind == kinds.end())
        words.refuse(wanted_item);
      const Holds holds = kind->read(words);
      if (!words.empty())
        words.refuse("there are more words than it takes.");
      rule.holds = [holds, solid](const CadFace &face, const double tolerance)
      {
        return (solid.empty() || std::count(face.solids.begin(), face.solids.end(), solid) > 0) &&
               holds(face, tolerance);
      };
      return rule;
    }

    /// Of all faces as many as a message has room for.
    std::string face_list(const CadPart &part)
    {
      constexpr unsigned int n_shown = 5;
      std::string list;
      for (unsigned int k = 0; k < part.faces.size() && k < n_shown; ++k)
      {
        const CadFace &face = part.faces[k];
        list += (k > 0 ? ", " : "") + std::to_string(face.number) + " (" + face.surface + " at " +
                in_brackets(face.centre) + (face.radius > 0 ? ", radius " + number_text(face.radius) : "") +
                (face.name.empty() ? "" : ", \"" + face.name.substr(0, 20) + "\"") + ")";
      }
      list += part.faces.size() > n_shown ? ", ..." : "";
      for (unsigned int k = 0; part.solids.size() > 1 && k < part.solids.size() && k <= n_shown; ++k)
      {
        const std::vector<int> &faces = part.solids[k].faces;
        list += k == n_shown
                    ? ", ..."
                    : (k == 0 ? "; solids " : ", ") + part.solids[k].name.substr(0, 20) + " (faces " +
                          std::to_string(*std::min_element(faces.begin(), faces.end())) + " to " +
                          std::to_string(*std::max_element(faces.begin(), faces.end())) + ")";
      }
      return list;
    }
  } // namespace

  std::vector<FaceRule> face_rules(const std::string &text, const std::string &entry)
  {
    std::vector<FaceRule> rules;
    std::istringstream stream(text);
    for (std::string item; std::getline(stream, item, ';');)
      if (!trimmed(item).empty())
        rules.push_back(rule_of(trimmed(item), entry));
    return rules;
  }

  std::map<std::string, std::vector<int>> chosen_faces(const std::vector<FaceRule> &rules,
                                                       const CadPart &part, const std::string &entry,
                                                       const std::string &file)
  {
    const double tolerance = 1e-5 * part.size();
    std::map<std::string, std::vector<int>> result;
    std::map<unsigned int, std::string> group_of;
    for (const FaceRule &rule : rules)
    {
      unsigned int n = 0;
      for (const CadFace &face : part.faces)
      {
        if (!rule.holds(face, tolerance))
          continue;
        ++n;
        const auto [place, is_new] = group_of.emplace(face.number, rule.group);
        if (is_new)
          result[rule.group].push_back(face.number);
        else if (place->second != rule.group)
          throw InputError(entry + " puts face " + std::to_string(face.number) + " of " + file + " at " +
                           in_brackets(face.centre) + " into the groups " + place->second + " and " +
                           rule.group + ": a face belongs to one.");
      }
      if (n == 0)
        throw InputError(entry + ": \"" + rule.text + "\" is no face of " + file + ", which has " +
                         std::to_string(part.faces.size()) + ": " + face_list(part) +
                         "; lengths are in m for STEP.");
    }
    return result;
  }
} // namespace vibrocontact

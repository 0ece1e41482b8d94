#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/scene/file_mesh.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// Corners of the faces S1, S2, ... of solid elements (Abaqus Analysis User's Guide, 28.1.4).
    const std::vector<std::vector<unsigned int>> &numbered_faces(const unsigned int n_corners)
    {
      static const std::vector<std::vector<unsigned int>>
          tetrahedron = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}},
          prism = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}},
          hexahedron = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
      return n_corners == 4 ? tetrahedron : n_corners == 6 ? prism : hexahedron;
    }

    /// Type of an element, by what follows its name's letters: C3D10M is C3D10.
    struct InpType
    {
      const char *name;
      /// gmsh's number; corners of the edges in whose middles the further nodes lie, in Abaqus' order
      unsigned int type;
      std::vector<std::vector<unsigned int>> edges;
    };

    const std::vector<InpType> &inp_types()
    {
      static const std::vector<std::vector<unsigned int>> tetrahedron = {{0, 1}, {1, 2}, {2, 0},
                                                                         {0, 3}, {1, 3}, {2, 3}},
                                                          prism = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                                                   {5, 3}, {0, 3}, {1, 4}, {2, 5}},
                                                          hexahedron = {{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                                                        {4, 5}, {5, 6}, {6, 7}, {7, 4},
                                                                        {0, 4}, {1, 5}, {2, 6}, {3, 7}};
      static const std::vector<InpType> types = {{"C3D4", 4, {}},  {"C3D10", 11, tetrahedron},
                                                 {"C3D6", 6, {}},  {"C3D15", 18, prism},
                                                 {"C3D8", 5, {}},  {"C3D20", 17, hexahedron},
                                                 {"S3", 2, {}},    {"S6", 9, {}},
                                                 {"S4", 3, {}},    {"S8", 16, {}},
                                                 {"STRI3", 2, {}}, {"STRI65", 9, {}},
                                                 {"CPS3", 2, {}},  {"CPS6", 9, {}},
                                                 {"CPS4", 3, {}},  {"CPS8", 16, {}},
                                                 {"CPE3", 2, {}},  {"CPE6", 9, {}},
                                                 {"CPE4", 3, {}},  {"CPE8", 16, {}},
                                                 {"M3D3", 2, {}},  {"M3D6", 9, {}},
                                                 {"M3D4", 3, {}},  {"M3D8", 16, {}}};
      return types;
    }

    std::string trimmed(const std::string &text)
    {
      const char *const blank = " \t\r\"";
      const auto first = text.find_first_not_of(blank);
      return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
    }

    std::vector<std::string> fields_of(const std::string &line)
    {
      std::vector<std::string> fields;
      for (std::size_t at = 0;;)
      {
        const auto comma = line.find(',', at);
        fields.push_back(trimmed(line.substr(at, comma - at)));
        if (comma == std::string::npos)
          return fields;
        at = comma + 1;
      }
    }

    class InpReader
    {
    public:
      explicit InpReader(const std::string &name) : name(name), stream(name) {}

      FileMesh read()
      {
        std::string line;
        while (std::getline(stream, line))
        {
          ++number;
          if (line.rfind("**", 0) == 0 || trimmed(line).empty())
            continue;
          if (line.front() == '*')
            start_card(line);
          else
            read_data(fields_of(line));
        }
        finish_element();
        std::string left_out;
        for (const auto &other : others)
          left_out += (left_out.empty() ? "" : ", ") + as_utf8(other.first);
        if (!left_out.empty())
          run_log().line("The mesh file " + name + " has elements of type " + left_out +
                         ", which are left out: solid elements alone make the body.");
        make_groups();
        return std::move(mesh);
      }

    private:
      enum class Card
      {
        other,
        node,
        element,
        node_set,
        element_set,
        surface
      };
      struct Element
      {
        unsigned int type;
        /// positions of the nodes in gmsh's order
        std::vector<unsigned int> nodes;
      };

      [[noreturn]] void refuse(const std::string &what) const
      {
        throw InputError("The mesh file " + name + ", line " + std::to_string(number) + ", " + as_utf8(what) +
                         ".");
      }

      long long integer(const std::string &text) const
      {
        char *end = nullptr;
        const long long value = std::strtoll(text.c_str(), &end, 10);
        if (text.empty() || *end != 0 || value <= 0 || value > 2000000000)
          refuse("holds \"" + text + "\" where the number of a node or element is due");
        return value;
      }

      bool is_number(const std::string &text) const
      {
        return !text.empty() &&
               std::all_of(text.begin(), text.end(), [](const unsigned char c) { return std::isdigit(c); });
      }

      /// Names of sets differ by more than capitals: as it was written first.
      std::string spelled(const std::string &set_name)
      {
        return spellings.emplace(boost::to_upper_copy(set_name), set_name).first->second;
      }

      void start_card(const std::string &line)
      {
        finish_element();
        card = Card::other;
        const std::vector<std::string> fields = fields_of(line);
        const std::string keyword = boost::to_upper_copy(fields[0]);
        std::map<std::string, std::string> options;
        for (std::size_t k = 1; k < fields.size(); ++k)
        {
          const auto equals = fields[k].find('=');
          options[boost::to_upper_copy(trimmed(fields[k].substr(0, equals)))] =
              equals == std::string::npos ? "" : trimmed(fields[k].substr(equals + 1));
        }
        set.clear();
        generate = options.count("GENERATE") > 0;
        const auto of_set = [&](const char *option)
        {
          if (options.count(option) && !options[option].empty())
            set = spelled(options[option]);
        };
        if (keyword == "*INCLUDE")
          refuse("includes another file: put its lines here");
        if (keyword == "*PART" && n_parts++ > 0)
          refuse("begins a second part: give a deck of one part for each body");
        if (keyword == "*NODE")
        {
          of_set("NSET");
          card = Card::node;
        }
        else if (keyword == "*ELEMENT")
        {
          of_set("ELSET");
          sets_of_cells.insert(set);
          card = Card::element;
          kind = options["TYPE"];
          const std::string type = boost::to_upper_copy(kind);
          current = nullptr;
          for (const InpType &candidate : inp_types())
          {
            const std::string known = candidate.name;
            // C3D10M, C3D8R, S4R: more letters; C3D20 is no C3D2
            if (type.rfind(known, 0) == 0 && (type.size() == known.size() ||
                                              !std::isdigit(static_cast<unsigned char>(type[known.size()]))))
              current = &candidate;
          }
          if (!current && type.rfind("C3D", 0) == 0)
            refuse("holds solid elements of type " + kind +
                   ", of which no body is made: give C3D4, C3D10, C3D6, C3D15, "
                   "C3D8 or C3D20");
        }
        else if (keyword == "*NSET" || keyword == "*ELSET")
        {
          of_set(keyword == "*NSET" ? "NSET" : "ELSET");
          if (set.empty())
            refuse("has a set without a name");
          card = keyword == "*NSET" ? Card::node_set : Card::element_set;
        }
        else if (keyword == "*SOLID SECTION")
        {
          of_set("ELSET");
          sets_of_cells.insert(set);
        }
        else if (keyword == "*SURFACE")
        {
          const std::string type = boost::to_upper_copy(options["TYPE"]);
          if (type.empty() || type == "ELEMENT")
          {
            of_set("NAME");
            if (set.empty())
              refuse("has a surface without a name");
            card = Card::surface;
          }
        }
      }

      void read_data(const std::vector<std::string> &fields)
      {
        switch (card)
        {
        case Card::node:
          read_node(fields);
          break;
        case Card::element:
          for (const std::string &field : fields)
            if (!field.empty())
              open_element.push_back(integer(field));
          if (current && open_element.size() > element_type(current->type)->n_nodes)
            finish_element();
          break;
        case Card::node_set:
        case Card::element_set:
          read_set(fields);
          break;
        case Card::surface:
          if (fields.size() < 2)
            refuse("gives no face of surface " + set);
          surfaces[set].push_back(
              {is_number(fields[0]) ? fields[0] : spelled(fields[0]), boost::to_upper_copy(fields[1])});
          break;
        case Card::other:
          break;
        }
      }

      void read_node(const std::vector<std::string> &fields)
      {
        const long long tag = integer(fields[0]);
        Point<3> p;
        for (unsigned int d = 0; d < 3 && 1 + d < fields.size(); ++d)
        {
          char *end = nullptr;
          p[d] = fields[1 + d].empty() ? 0. : std::strtod(fields[1 + d].c_str(), &end);
          if (end && (*end != 0 || !std::isfinite(p[d])))
            refuse("holds \"" + fields[1 + d] + "\" where a coordinate is due");
        }
        if (!node_of.emplace(tag, mesh.nodes.size()).second)
          refuse("gives node " + std::to_string(tag) + " a second time");
        mesh.nodes.push_back(p);
        if (!set.empty())
          node_sets[set].insert(tag);
      }

      void finish_element()
      {
        if (open_element.empty())
          return;
        std::vector<long long> numbers;
        numbers.swap(open_element);
        if (!current)
        {
          ++others[kind];
          return;
        }
        const ElementType &gmsh = *element_type(current->type);
        if (numbers.size() != 1 + gmsh.n_nodes)
          refuse("ends an element of type " + kind + " with " + std::to_string(numbers.size() - 1) +
                 " nodes instead of " + std::to_string(gmsh.n_nodes));
        Element element{current->type, {}};
        for (std::size_t k = 1; k < numbers.size(); ++k)
        {
          const auto found = node_of.find(numbers[k]);
          if (found == node_of.end())
            refuse("has an element with node " + std::to_string(numbers[k]) + ", which is not given before");
          element.nodes.push_back(found->second);
        }
        // further nodes from Abaqus' order of the edges to gmsh's
        if (!current->edges.empty())
        {
          const std::vector<unsigned int> given = element.nodes;
          const auto wanted = middles(current->type);
          for (std::size_t m = 0; m < wanted.size(); ++m)
            for (std::size_t k = 0; k < current->edges.size(); ++k)
              if (std::set<unsigned int>(wanted[m].begin(), wanted[m].end()) ==
                  std::set<unsigned int>(current->edges[k].begin(), current->edges[k].end()))
                element.nodes[gmsh.n_corners + m] = given[gmsh.n_corners + k];
        }
        if (!elements.emplace(numbers[0], std::move(element)).second)
          refuse("gives element " + std::to_string(numbers[0]) + " a second time");
        if (!set.empty())
          element_sets[set].insert(numbers[0]);
      }

      void read_set(const std::vector<std::string> &fields)
      {
        auto &sets = card == Card::node_set ? node_sets : element_sets;
        std::set<long long> &members = sets[set];
        if (generate)
        {
          if (fields.size() < 2)
            refuse("generates a set without first and last number");
          const long long first = integer(fields[0]), last = integer(fields[1]),
                          step = fields.size() > 2 && !fields[2].empty() ? integer(fields[2]) : 1;
          if ((last - first) / step > 100000000)
            refuse("generates a set of more than 1e8 members");
          for (long long k = first; k <= last; k += step)
            members.insert(k);
          return;
        }
        for (const std::string &field : fields)
          if (is_number(field))
            members.insert(integer(field));
          else if (!field.empty())
          {
            // a set of sets; names are those before
            const auto other = sets.find(spelled(field));
            if (other == sets.end())
              refuse("names the set " + field + ", which is not given before");
            members.insert(other->second.begin(), other->second.end());
          }
      }

      void add_block(const unsigned int type, const std::vector<unsigned int> &groups,
                     const std::vector<unsigned int> &nodes)
      {
        auto &block = blocks[{type, groups}];
        block.insert(block.end(), nodes.begin(), nodes.end());
      }

      void make_groups()
      {
        unsigned int n_groups = 0;
        const auto is_solid = [&](const long long tag)
        {
          const auto found = elements.find(tag);
          return found != elements.end() && element_type(found->second.type)->dim == 3;
        };
        // sets that make surfaces of cells which belong to another set
        std::set<long long> in_sets_of_cells;
        for (const auto &[set_name, members] : element_sets)
          if (sets_of_cells.count(set_name) > 0)
            in_sets_of_cells.insert(members.begin(), members.end());
        std::set<std::string> only_of_surfaces;
        for (const auto &[surface, parts] : surfaces)
          for (const auto &[of, label] : parts)
            if (const auto found = element_sets.find(of);
                found != element_sets.end() && sets_of_cells.count(of) == 0 &&
                std::includes(in_sets_of_cells.begin(), in_sets_of_cells.end(), found->second.begin(),
                              found->second.end()))
              only_of_surfaces.insert(of);
        std::map<long long, std::vector<unsigned int>> groups_of;
        for (const auto &[set_name, members] : element_sets)
        {
          if (only_of_surfaces.count(set_name) > 0)
            continue;
          // a set of cells; or of shells
          std::set<unsigned int> dims;
          for (const long long tag : members)
            if (elements.count(tag))
              dims.insert(is_solid(tag) ? 3 : 2);
          if (dims.size() != 1)
            continue;
          mesh.names[{*dims.begin(), ++n_groups}] = as_utf8(set_name);
          for (const long long tag : members)
            if (elements.count(tag))
              groups_of[tag].push_back(n_groups);
        }
        for (const auto &[tag, element] : elements)
        {
          const auto own = groups_of.find(tag);
          add_block(element.type, own == groups_of.end() ? std::vector<unsigned int>() : own->second,
                    element.nodes);
        }
        for (const auto &[surface, parts] : surfaces)
        {
          mesh.names[{2, ++n_groups}] = as_utf8(surface);
          for (const auto &[of, label] : parts)
          {
            std::set<long long> members;
            if (is_number(of))
              members.insert(integer(of));
            else if (element_sets.count(of))
              members = element_sets.at(of);
            else
              throw InputError("The mesh file " + name + " makes the surface " + as_utf8(surface) +
                               " of the set " + as_utf8(of) + ", which it does not have.");
            for (const long long tag : members)
              if (is_solid(tag))
                add_face(elements.at(tag), label, n_groups, surface);
          }
        }
        add_node_sets(n_groups);
        for (auto &[key, nodes] : blocks)
          mesh.elements.push_back({key.first, key.second, std::move(nodes)});
      }

      void add_face(const Element &element, const std::string &label, const unsigned int group,
                    const std::string &surface)
      {
        const auto &faces = numbered_faces(element_type(element.type)->n_corners);
        const std::size_t f = label.size() == 2 && label[0] == 'S' ? label[1] - '1' : faces.size();
        if (f >= faces.size())
          throw InputError("The mesh file " + name + " gives the surface " + as_utf8(surface) + " a face \"" +
                           as_utf8(label) + "\", which " + element_type(element.type)->name +
                           " do not have.");
        std::vector<unsigned int> corners;
        for (const unsigned int c : faces[f])
          corners.push_back(element.nodes[c]);
        add_block(corners.size() == 3 ? 2 : 3, {group}, corners);
      }

      /// Boundary faces whose corners are all in a set of nodes.
      void add_node_sets(unsigned int n_groups)
      {
        if (node_sets.empty())
          return;
        std::map<std::vector<unsigned int>, std::pair<unsigned int, std::vector<unsigned int>>> faces;
        for (const auto &[tag, element] : elements)
          if (element_type(element.type)->dim == 3)
            for (const auto &list : numbered_faces(element_type(element.type)->n_corners))
            {
              std::vector<unsigned int> corners, sorted;
              for (const unsigned int c : list)
                corners.push_back(element.nodes[c]);
              sorted = corners;
              std::sort(sorted.begin(), sorted.end());
              auto &face = faces[sorted];
              ++face.first;
              face.second = corners;
            }
        for (const auto &[set_name, members] : node_sets)
        {
          std::vector<char> inside(mesh.nodes.size(), 0);
          for (const long long tag : members)
            if (node_of.count(tag))
              inside[node_of.at(tag)] = 1;
          // a surface of the same name is the better one
          if (surfaces.count(set_name))
            continue;
          mesh.names[{2, ++n_groups}] = as_utf8(set_name);
          for (const auto &[sorted, face] : faces)
            if (face.first == 1 && std::all_of(sorted.begin(), sorted.end(),
                                               [&](const unsigned int node) { return inside[node]; }))
              add_block(face.second.size() == 3 ? 2 : 3, {n_groups}, face.second);
        }
      }

      const std::string name;
      std::ifstream stream;
      unsigned int number = 0, n_parts = 0;
      Card card = Card::other;
      std::string set, kind;
      bool generate = false;
      const InpType *current = nullptr;
      std::vector<long long> open_element;
      std::map<long long, unsigned int> node_of;
      std::map<long long, Element> elements;
      std::map<std::string, std::string> spellings;
      /// numbers of elements that carry nothing here, by type
      std::map<std::string, unsigned int> others;
      std::map<std::string, std::set<long long>> node_sets, element_sets;
      std::map<std::string, std::vector<std::pair<std::string, std::string>>> surfaces;
      /// that elements are given in or have a section by; others may be the faces of surfaces alone, which are no groups of cells
      std::set<std::string> sets_of_cells;
      std::map<std::pair<unsigned int, std::vector<unsigned int>>, std::vector<unsigned int>> blocks;
      FileMesh mesh;
    };
  } // namespace

  FileMesh read_inp(const std::string &file)
  {
    return InpReader(file).read();
  }
} // namespace vibrocontact

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/scene/file_boundaries.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  std::vector<std::string> group_names_of(const std::vector<NamedGroup> &groups)
  {
    std::vector<std::string> names;
    for (const NamedGroup &one : groups)
      names.push_back(one.group);
    return names;
  }

  void require_groups(const std::vector<NamedGroup> &groups, const FileCells &cells, const std::string &name,
                      const std::string &file)
  {
    const auto counts = cells.face_counts();
    for (const NamedGroup &one : groups)
    {
      const auto found = counts.find(one.group);
      if (found != counts.end() && found->second > 0)
        continue;
      std::string list;
      for (const auto &[present, n] : counts)
        list += (list.empty() ? "" : ", ") + present + " (" + std::to_string(n) + " faces)";
      throw InputError("The mesh file " + file + " has no faces in a group named '" + one.group +
                       "', asked for by " + name + "/Mesh/" + one.entry + "; " +
                       (list.empty() ? "it has no named group of faces: name one (gmsh: Physical Surface)."
                        : counts.size() == 1 ? "all of its faces in groups are in one: " + list +
                                                   "; name more (gmsh: Physical Surface) and save it as "
                                                   ".msh, .unv or .inp, which keep names."
                                             : "name one of those it has: " + list + "."));
    }
  }

  std::vector<types::boundary_id> boundary_ids(const std::vector<NamedGroup> &groups, const FileCells &cells,
                                               BodyMesh<3> &mesh, const std::string &file)
  {
    std::set<std::string> wanted;
    for (const NamedGroup &one : groups)
      wanted.insert(one.group);
    mesh.boundaries["surface"] = 0;
    for (const auto &[tag, group] : cells.names)
      if (group != "surface")
        mesh.boundaries[group] = tag;
    const auto counts = cells.face_counts();
    std::vector<types::boundary_id> ids;
    std::set<std::string> dropped;
    for (const FileCells::Face &face : cells.faces)
    {
      const auto rank = [&](const unsigned int group)
      {
        const std::string &name = cells.names.at(group);
        return std::make_pair(wanted.count(name) == 0, counts.at(name));
      };
      std::vector<unsigned int> own = face.groups;
      std::stable_sort(own.begin(), own.end(),
                       [&](const unsigned int a, const unsigned int b) { return rank(a) < rank(b); });
      if (own.size() > 1 && wanted.count(cells.names.at(own[1])))
        throw InputError(
            "The mesh file " + file + " has faces that belong to \"" + cells.names.at(own[0]) +
            "\" and to \"" + cells.names.at(own[1]) + "\", both of which " + mesh.name +
            "/Mesh names: a face is held, in contact, glued or on springs; take it out of one of "
            "them.");
      const std::string &name = cells.names.at(own.front());
      ids.push_back(name == "surface" ? 0 : own.front());
      for (std::size_t k = 1; k < own.size(); ++k)
        dropped.insert(cells.names.at(own[k]));
    }
    std::string list;
    for (const std::string &group : dropped)
    {
      list += (list.empty() ? "" : ", ") + group;
      mesh.boundaries.erase(group);
    }
    if (!list.empty())
      run_log().line("The mesh file " + file +
                     " has faces of several groups; no boundaries are therefore: " + list);
    return ids;
  }

  void name_faces(Triangulation<3> &triangulation, const FileCells &cells,
                  const std::vector<types::boundary_id> &ids, const std::string &file)
  {
    const auto key = [](std::vector<unsigned int> vertices)
    {
      std::sort(vertices.begin(), vertices.end());
      return vertices;
    };
    std::map<std::vector<unsigned int>, unsigned int> number;
    for (unsigned int k = 0; k < cells.faces.size(); ++k)
      number[key(cells.faces[k].corners)] = k;
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          std::vector<unsigned int> vertices;
          for (const unsigned int v : cell->face(f)->vertex_indices())
            vertices.push_back(cell->face(f)->vertex_index(v));
          const auto found = number.find(key(vertices));
          if (found == number.end())
            continue;
          cell->face(f)->set_boundary_id(ids[found->second]);
          number.erase(found);
        }
    if (number.empty())
      return;
    const FileCells::Face &first = cells.faces[number.begin()->second];
    std::ostringstream text;
    text << "The mesh file " << file << " has " << number.size() << " faces of named groups, the first of \""
         << cells.names.at(first.groups.front()) << "\" at (" << cells.vertices[first.corners.front()]
         << ") m, that are no faces of the boundary of its cells: name boundary surfaces only.";
    throw InputError(text.str());
  }
} // namespace vibrocontact

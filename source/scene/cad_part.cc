#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/checksum.h>
#include <vibrocontact/base/child_process.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/local_file.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/scene/cad_part.h>
#include <vibrocontact/scene/gmsh_library.h>
#include <vibrocontact/scene/step_names.h>

#include <deal.II/base/utilities.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// A CAD format by the ending of its files' names.
    struct CadFormat
    {
      std::vector<std::string> endings;
      /// what its files begin with, one of them; and end with, empty: anything
      std::vector<std::string> beginnings;
      std::string end;
      /// what a file has in it that says the unit of length; empty: the format has none
      std::string unit;
    };

    const CadFormat *cad_format_of(const std::string &file)
    {
      static const std::vector<CadFormat> cad_formats = {
          {{".step", ".stp"}, {"ISO-10303-21;"}, "END-ISO-10303-21;", "LENGTH_UNIT"},
          {{".brep"}, {"DBRep_DrawableShape", "CASCADE Topology"}, "", ""}};
      for (const CadFormat &format : cad_formats)
        for (const std::string &one : format.endings)
          if (has_extension(file, one))
            return &format;
      return nullptr;
    }

    std::string content_of(const std::string &file)
    {
      std::ifstream stream(file, std::ios::binary);
      if (!stream || std::filesystem::is_directory(file))
        throw InputError("Cannot read the CAD file " + file + "; give the path of an existing file.");
      return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }

    void check_content(const std::string &content, const CadFormat &format, const std::string &file)
    {
      const std::size_t start = content.find_first_not_of(" \t\r\n");
      bool begins = false;
      for (const std::string &beginning : format.beginnings)
        begins = begins ||
                 (start != std::string::npos && content.compare(start, beginning.size(), beginning) == 0);
      if (!begins)
        throw InputError("The CAD file " + file + " is no file of its format: it does not begin with \"" +
                         format.beginnings.front() + "\"; save it again with the program that made it.");
      const std::size_t last = content.find_last_not_of(" \t\r\n") + 1;
      if (!format.end.empty() &&
          (last < format.end.size() ||
           content.compare(last - format.end.size(), format.end.size(), format.end) != 0))
        throw InputError("The CAD file " + file + " is cut off: it does not end with \"" + format.end +
                         "\"; save or copy it again.");
      if (!format.unit.empty() && content.find(format.unit) == std::string::npos)
        throw InputError("The CAD file " + file + " says no unit of length (" + format.unit +
                         "): save it again with the program that made it.");
    }

    /// The file in gmsh, in a process of its own. @returns its solids
    gmsh::vectorpair open_in_gmsh(const std::string &file)
    {
      start_gmsh();
      gmsh::option::setNumber("General.AbortOnError", 0);
      if (has_own_unit(file))
        gmsh::option::setString("Geometry.OCCTargetUnit", "M");
      gmsh::vectorpair shapes, solids;
      gmsh::model::occ::importShapes(file, shapes);
      gmsh::model::occ::synchronize();
      gmsh::model::getEntities(solids, 3);
      return solids;
    }

    Point<3> point_on(const int face, const double u, const double v)
    {
      std::vector<double> p;
      gmsh::model::getValue(2, face, {u, v}, p);
      return {p.at(0), p.at(1), p.at(2)};
    }

    /// What surface a face lies on: of planes the normal, of cylinders axis and radius, from three points around it.
    void find_surface(CadFace &face)
    {
      gmsh::model::getType(2, face.number, face.surface);
      if (!face.is_plane() && !face.is_cylinder())
        return;
      std::vector<double> low, high;
      gmsh::model::getParametrizationBounds(2, face.number, low, high);
      const double du = (high.at(0) - low.at(0)) / 3, dv = high.at(1) - low.at(1);
      const Point<3> a = point_on(face.number, low[0], low[1]),
                     b = point_on(face.number, low[0] + du, low[1]),
                     c = face.is_plane() ? point_on(face.number, low[0], low[1] + dv)
                                         : point_on(face.number, low[0] + 2 * du, low[1]);
      const Tensor<1, 3> u = b - a, v = c - a, normal = cross_product_3d(u, v);
      if (!(normal.norm() > 0))
        return;
      face.direction = normal / normal.norm();
      face.place = a;
      if (face.is_plane())
        return;
      const Tensor<1, 3> to_axis =
          cross_product_3d(u.norm_square() * v - v.norm_square() * u, normal) / (-2 * normal.norm_square());
      face.place = a - to_axis;
      face.radius = to_axis.norm();
    }

    /// The only one of these that is as a name says; of several, or none, null.
    template <typename Shapes, typename IsIt>
    auto only_one(Shapes &shapes, const IsIt &is_it) -> decltype(&shapes.front())
    {
      const auto first = std::find_if(shapes.begin(), shapes.end(), is_it);
      return first == shapes.end() || std::find_if(first + 1, shapes.end(), is_it) != shapes.end() ? nullptr
                                                                                                   : &*first;
    }

    bool bounds(const CadFace &face, const CadSolid &solid)
    {
      return std::count(solid.faces.begin(), solid.faces.end(), int(face.number)) > 0;
    }

    void take_names(CadPart &part, const std::vector<StepName> &names)
    {
      const double near = 1e-6 * part.size();
      const auto same_size = [](const double a, const double b) { return std::abs(a - b) < 1e-6 * b; };
      // what is not certain has no name: to choose it is refused then
      for (const StepName &one : names)
      {
        if (one.is_solid)
        {
          // lists of groups and sections could not hold it
          if (one.name.find_first_of(",/") != std::string::npos)
            continue;
          if (CadSolid *const match = only_one(
                  part.solids, [&](const CadSolid &solid)
                  { return same_size(solid.volume, one.size) && solid.centre.distance(one.centre) < near; }))
            match->name = as_utf8(one.name);
          continue;
        }
        const auto bounds_it = [&](const CadFace &face)
        {
          return std::any_of(part.solids.begin(), part.solids.end(),
                             [&](const CadSolid &solid) {
                               return bounds(face, solid) &&
                                      solid.centre.distance(one.centre_of_solid) < near;
                             });
        };
        if (CadFace *const match = only_one(part.faces,
                                            [&](const CadFace &face) {
                                              return same_size(face.area, one.size) &&
                                                     face.centre.distance(one.centre) < near &&
                                                     bounds_it(face);
                                            }))
          match->name = as_utf8(one.name);
      }
    }

    /// The names of the solids' groups, and of each face those of its solids.
    void name_solids(CadPart &part)
    {
      if (part.solids.size() == 1)
        part.solids.front().name = "solid";
      std::set<std::string> taken;
      for (const CadSolid &solid : part.solids)
        taken.insert(solid.name);
      unsigned int n = 0;
      for (CadSolid &solid : part.solids)
      {
        ++n;
        if (solid.name.empty())
          while (!taken.insert(solid.name = "solid" + std::to_string(n)).second)
            ++n;
        for (CadFace &face : part.faces)
          if (bounds(face, solid))
            face.solids.push_back(solid.name);
      }
    }

    struct Described
    {
      CadPart part;
      unsigned int n_surfaces = 0;
      double smallest_volume = std::numeric_limits<double>::max();

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &part &n_surfaces &smallest_volume;
      }
    };

    Described describe(const std::string &file)
    {
      std::vector<StepName> names;
      if (has_own_unit(file))
        names = step_names(file);
      Described result;
      const gmsh::vectorpair solids = open_in_gmsh(file);
      gmsh::vectorpair faces;
      gmsh::model::getEntities(faces, 2);
      result.n_surfaces = faces.size();
      for (const auto &[dim, number] : solids)
      {
        CadSolid solid;
        solid.number = number;
        gmsh::model::occ::getMass(3, number, solid.volume);
        gmsh::model::occ::getCenterOfMass(3, number, solid.centre[0], solid.centre[1], solid.centre[2]);
        gmsh::vectorpair own;
        gmsh::model::getBoundary({{3, number}}, own, false, false);
        for (const auto &face : own)
          solid.faces.push_back(std::abs(face.second));
        result.smallest_volume = std::min(result.smallest_volume, solid.volume);
        result.part.volume += solid.volume;
        result.part.solids.push_back(solid);
      }
      for (const auto &[dim, number] : faces)
      {
        CadFace face;
        face.number = number;
        gmsh::model::occ::getMass(2, number, face.area);
        gmsh::model::occ::getCenterOfMass(2, number, face.centre[0], face.centre[1], face.centre[2]);
        gmsh::model::getBoundingBox(2, number, face.low[0], face.low[1], face.low[2], face.high[0],
                                    face.high[1], face.high[2]);
        // OpenCASCADE's boxes are so much wider on each side
        for (unsigned int d = 0; d < 3; ++d)
        {
          face.low[d] += 1e-7;
          face.high[d] -= 1e-7;
        }
        find_surface(face);
        result.part.faces.push_back(face);
      }
      take_names(result.part, names);
      name_solids(result.part);
      return result;
    }

    /// What a mesh depends on, as the name of its file.
    std::string mesh_name(const std::string &file, const CadPart &part, const CadSizes &sizes,
                          const std::map<std::string, std::vector<int>> &groups,
                          const std::vector<int> &fine_faces)
    {
      std::ostringstream key;
      key.precision(17);
      key << "mesh of CAD 1, gmsh " << GMSH_API_VERSION << "\n"
          << sizes.cell_size << " " << sizes.fine_size << " " << sizes.growth << " "
          << sizes.cells_around_circle << " " << sizes.order << "\n";
      for (const auto &[group, faces] : groups)
      {
        key << group << ":";
        for (const int face : faces)
          key << " " << face;
        key << "\n";
      }
      for (const int face : fine_faces)
        key << face << " ";
      if (part.solids.size() > 1)
        for (const CadSolid &solid : part.solids)
          key << "\n" << solid.name << ": " << solid.number;
      key << "\n" << content_of(file);
      return std::filesystem::path(file).stem().string() + "-mesh-" + digits_of_key(key.str()) + ".msh";
    }

    /// In a process of its own. @returns number of tetrahedra
    std::string write_mesh(const std::string &file, const CadPart &part, const CadSizes &sizes,
                           const std::map<std::string, std::vector<int>> &groups,
                           const std::vector<int> &fine_faces, const std::string &to)
    {
      const auto set = [](const std::string &option, const double value)
      { gmsh::option::setNumber(option, value); };
      open_in_gmsh(file);
      gmsh::logger::start();
      int tag = 0;
      for (const auto &[group, faces] : groups)
      {
        gmsh::model::addPhysicalGroup(2, faces, ++tag);
        gmsh::model::setPhysicalName(2, tag, group);
      }
      std::map<std::string, std::vector<int>> solids;
      for (const CadSolid &solid : part.solids)
        solids[solid.name].push_back(solid.number);
      for (const auto &[name, members] : solids)
      {
        gmsh::model::addPhysicalGroup(3, members, ++tag);
        gmsh::model::setPhysicalName(3, tag, name);
      }
      set("Mesh.MeshSizeMax", sizes.cell_size);
      set("Mesh.MeshSizeFromPoints", 0);
      set("Mesh.MeshSizeExtendFromBoundary", 0);
      set("Mesh.MeshSizeFromCurvature", sizes.cells_around_circle);
      set("Mesh.ElementOrder", sizes.order);
      set("Mesh.HighOrderOptimize", sizes.order > 1 ? 1 : 0);
      set("Mesh.Binary", 1);
      set("Mesh.MshFileVersion", 4.1);
      if (sizes.fine_size > 0 && !fine_faces.empty())
      {
        using namespace gmsh::model::mesh;
        const int distance = field::add("Distance"), size = field::add("Threshold");
        field::setNumbers(distance, "SurfacesList", {fine_faces.begin(), fine_faces.end()});
        field::setNumber(distance, "NumPointsPerCurve", 100);
        field::setNumber(size, "InField", distance);
        field::setNumber(size, "SizeMin", sizes.fine_size);
        field::setNumber(size, "SizeMax", sizes.cell_size);
        field::setNumber(size, "DistMin", 0);
        field::setNumber(size, "DistMax", sizes.growth);
        field::setAsBackgroundMesh(size);
      }
      gmsh::model::mesh::generate(3);
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, 3);
      std::size_t n = 0;
      for (const auto &list : elements)
        n += list.size();
      std::vector<std::string> log;
      gmsh::logger::get(log);
      for (const std::string &line : log)
        if (line.rfind("Error: ", 0) == 0)
          throw InputError(line.substr(7));
      if (n > 0)
        gmsh::write(to);
      return std::to_string(n);
    }
  } // namespace

  bool is_cad_file(const std::string &file)
  {
    return cad_format_of(file) != nullptr;
  }

  bool has_own_unit(const std::string &file)
  {
    const CadFormat *const format = cad_format_of(file);
    return format && !format->unit.empty();
  }

  CadPart read_cad_part(const std::string &file)
  {
    const CadFormat *const format = cad_format_of(file);
    AssertThrow(format, ExcMessage(file + " is no CAD file."));
    const std::string content = content_of(file);
    check_content(content, *format, file);
    static std::map<std::pair<std::string, std::size_t>, CadPart> known;
    const auto key = std::make_pair(file, std::hash<std::string>()(content));
    const auto found = known.find(key);
    if (found != known.end())
      return found->second;
    const ChildResult result = run_in_child(
        [&]
        {
          const std::vector<char> packed = Utilities::pack(describe(file), false);
          return std::string(packed.begin(), packed.end());
        },
        120 + 1e-4 * content.size(), 4e9 + 400. * content.size());
    if (!result.error.empty())
      throw InputError("gmsh " +
                       (result.crashed
                            ? "breaks off (" + result.error + ") while it reads the CAD file " + file
                            : "cannot read the CAD file " + file + ": " + as_utf8(result.error)) +
                       "; it is damaged, save it again with the program that made it.");
    Described described =
        Utilities::unpack<Described>(std::vector<char>(result.output.begin(), result.output.end()), false);
    if (described.part.solids.empty())
      throw InputError("The CAD file " + file + " has no solid, only " +
                       std::to_string(described.n_surfaces) +
                       " surfaces: close them to a solid in the program that made it.");
    if (!(described.smallest_volume > 0))
      throw InputError(
          "The CAD file " + file +
          " has a solid without volume: it is damaged, save it again with the program that made it.");
    return known[key] = described.part;
  }

  FileMesh mesh_cad_part(const std::string &file, const CadSizes &sizes,
                         const std::map<std::string, std::vector<int>> &groups,
                         const std::vector<int> &fine_faces, const std::string &copy,
                         const std::string &folder, const bool keep)
  {
    namespace fs = std::filesystem;
    const CadPart part = read_cad_part(file);
    const std::string own_name = mesh_name(file, part, sizes, groups, fine_faces);
    const bool is_known = !folder.empty() && fs::exists(folder + "/" + own_name);
    const bool kept = is_known || (keep && !folder.empty());
    const std::string name = (kept ? folder : fs::temp_directory_path().string()) + "/" +
                             (kept ? own_name : unique_part(own_name) + ".msh");
    if (is_known)
      run_log().line("The mesh of " + file + " is taken from " + name + ".");
    else
    {
      const std::string unfinished = unique_part(name) + ".msh";
      if (kept)
        fs::create_directories(folder);
      const ChildResult result = run_in_child(
          [&] { return write_mesh(file, part, sizes, groups, fine_faces, unfinished); }, 7200, 16e9);
      if (!result.error.empty() || result.output == "0")
      {
        std::error_code none;
        fs::remove(unfinished, none);
        throw InputError(
            "gmsh cannot mesh the CAD file " + file + " (" +
            (result.error.empty() ? "no tetrahedra" : as_utf8(result.error)) +
            "): give other sizes in the section CAD, or mend its faces in the program that made it.");
      }
      if (!fs::exists(unfinished))
        throw OutputError("The mesh of " + file + " could not be written to " + unfinished +
                          ": is the disk full?");
      fs::rename(unfinished, name);
      run_log().line("The CAD file " + file + " is meshed: " + result.output + " tetrahedra" +
                     (kept ? ", kept in " + name + "." : "."));
    }
    if (!copy.empty())
      copy_file(name, copy);
    const FileMesh mesh = read_file_mesh(name);
    if (!kept)
      fs::remove(name);
    return mesh;
  }
} // namespace vibrocontact
